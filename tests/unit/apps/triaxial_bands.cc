#include "tests/support/catch.h"

#include "apps/triaxial/band_output.h"
#include "apps/triaxial/band_summary.h"

#include <algorithm>
#include <cmath>

using namespace mergel;
using namespace mergel::apps;
using coupling::EarlierPositions;
using dem::Vec3;

namespace {

constexpr double degree = dem::pi / 180.0;

std::vector<Vec3> at(double x)
{
  return {Vec3(x, 0.0, 0.0)};
}

/// A record in stage 2 under a cell pressure of 1 MPa; the volume changes by the rate r.
TriaxialPoint point(double axial_strain, double q, double r, std::size_t stage = 1)
{
  TriaxialPoint p;
  p.analysed.stage = stage;
  p.whole.stress = Vec3(1e6, 1e6, 1e6 + q);
  const double V = 1.0 - r * axial_strain;
  const double lateral = 1.0 - std::sqrt(V / (1.0 - axial_strain));
  p.whole.strain = Vec3(lateral, lateral, axial_strain);
  return p;
}

/// q rises to 3 MPa at 1 % and falls to 2 MPa at 3 %; the specimen compacts before and loosens
/// after.
std::vector<TriaxialPoint> test_with_a_peak()
{
  std::vector<TriaxialPoint> points;
  for (int k = 0; k <= 60; ++k) {
    const double e = 5e-4 * k, way = std::abs(e - 0.01);
    points.push_back(point(e, e < 0.01 ? 3e6 - 2e8 * way : 3e6 - 5e7 * way, -0.4));
  }
  return points;
}

} // namespace

TEST_CASE("An increment reaches back by half to one and a half of what is asked for",
          "[unit][apps]")
{
  EarlierPositions earlier(0.01, 0.0, at(0.0));
  CHECK_FALSE(earlier.is_due(0.009));
  CHECK(earlier.increment(0.004) == 0.004); // nothing earlier in the stage
  CHECK(earlier.is_due(0.0101));
  earlier.add(0.0101, at(1.0));
  CHECK(earlier.x(0.0102) == at(0.0));
  CHECK(earlier.increment(0.0150) == Approx(0.0150));
  CHECK(earlier.x(0.0152) == at(1.0));
  CHECK(earlier.increment(0.0152) == Approx(0.0051));
  earlier.add(0.0202, at(2.0));
  CHECK(earlier.x(0.021) == at(1.0));
  CHECK(earlier.increment(0.021) == Approx(0.0109));

  earlier.begin_stage(0.021, at(3.0)); // unloads
  CHECK(earlier.x(0.016) == at(3.0));
  CHECK(earlier.increment(0.016) == Approx(0.005));
  CHECK_FALSE(earlier.is_due(0.016));
  CHECK(earlier.is_due(0.0105));
}

TEST_CASE("Friction and dilation angle are those of the peak and of the end of the stage",
          "[unit][apps]")
{
  const auto points = test_with_a_peak();
  const double psi = std::asin(0.4 / 2.4); // r = -0.4
  const auto peak = angles_at_peak(points, 1);
  REQUIRE(peak);
  CHECK(peak->phi == Approx(std::asin(3.0 / 5.0))); // 1 and 4 MPa
  CHECK(peak->psi == Approx(psi));
  const auto end = angles_at_end(points, 1, 0.01);
  REQUIRE(end);
  CHECK(end->phi == Approx(std::asin(2.0 / 4.0))); // 1 and 3 MPa
  CHECK(end->psi == Approx(psi));

  // Ended before the peak, as by an unloading.
  CHECK_FALSE(angles_at_peak({points.begin(), points.begin() + 15}, 1));
  CHECK(angles_at_end({points.begin(), points.begin() + 15}, 1, 0.01));
  CHECK_FALSE(angles_at_peak(points, 0));                                 // another stage
  CHECK_FALSE(angles_at_end({points[0], points[1], points[2]}, 1, 4e-4)); // two with q > 0
  CHECK_FALSE(angles_at_peak(
      {point(0.0, -1e5, 0.0), point(1e-3, -2e5, 0.0), point(2e-3, -3e5, 0.0)},
      1)); // extension
}

TEST_CASE("A line of localisation.csv has a number for each of its headings",
          "[unit][apps]")
{
  coupling::BandRecord r;
  r.axial_strain = 0.02;
  r.shear.band = {Vec3(0.0, std::sin(60 * degree), std::cos(60 * degree)), 1e-3, 5e-3, 0.7,
                  0.2};
  const auto headings = band_headings();
  const auto line = band_line(r, 5e-4, {3, 2, 0, "unload-reload to q = 0 MPa, reloading"});
  REQUIRE(line.size() == headings.size());
  const auto value = [&](const char* name) {
    const auto it = std::find(headings.begin(), headings.end(), name);
    REQUIRE(it != headings.end());
    return line[static_cast<std::size_t>(it - headings.begin())];
  };
  CHECK(value("stage [-]") == 3.0);
  CHECK(value("part [-]") == 2.0);
  CHECK(value("shear strain: angle [degree]") == Approx(60.0));
  CHECK(value("shear strain: dip direction [degree]") == Approx(90.0));
  CHECK(value("shear strain: thickness/d50 [-]") == Approx(8.0));
  CHECK(value("shear strain: share of the tenth [-]") == 0.7);
  CHECK(value("shear strain: even share [-]") == 0.2);
  CHECK(value("increment of compaction: share of the tenth [-]") == 0.0);
}
