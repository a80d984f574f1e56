#include "dem/specimen/psd.h"
#include "dem/error.h"
#include "dem/io/psd_file.h"
#include "tests/support/catch.h"
#include "tests/support/repository.h"

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace mergel::dem;
using mergel::match::Contains;

namespace {

const UniformSizes paper{0.066e-3, 0.1337e-3};

const std::filesystem::path shipped =
    mergel::test::repository() / "meshes/psd/maastricht.csv";

std::vector<Grading> all_curves()
{
  return {Grading(paper), Grading(PowerSizes{0.02e-3, 0.2e-3, 0.5}),
          Grading(PowerSizes{0.05e-3, 0.2e-3, 3.0}),
          Grading(LogNormalSizes{0.05e-3, 0.3e-3, 0.12e-3, 0.4}),
          Grading(SieveSizes{{0.05e-3, 0.1e-3, 0.15e-3, 0.2e-3}, {0.0, 0.3, 0.3, 1.0}})};
}

double no_other_unit(const std::string& unit, const std::string&)
{
  throw mergel::InputError("[" + unit + "]");
}

/// Error message of read_sieve_curve for this text; empty if it is accepted.
std::string refusal(const std::string& text)
{
  const auto file = std::filesystem::temp_directory_path() / "mergel_dem_psd.csv";
  std::ofstream(file) << text;
  std::string said;
  try {
    read_sieve_curve(file, no_other_unit);
  } catch (const mergel::InputError& e) {
    said = e.what();
  }
  std::filesystem::remove(file);
  return said;
}

} // namespace

TEST_CASE("Share by mass is share by number weighted with the cube of the diameter",
          "[unit][dem]")
{
  for (const Grading& g : all_curves()) {
    constexpr int n = 20000;
    const double d = g.diameter(0.6);
    double below = 0.0, whole = 0.0;
    for (int k = 0; k < n; ++k) {
      const double x = std::pow(g.diameter((k + 0.5) / n), 3);
      whole += x;
      if ((k + 0.5) / n < 0.6) below += x;
    }
    // Midpoint rule: measured 2e-7 to 5e-5, the largest for the steep power law.
    CHECK(g.passing(d) == Approx(below / whole).margin(1e-4));
    CHECK(g.mean_cube() == Approx(whole / n).epsilon(2e-3));
  }
}

TEST_CASE("diameter() inverts the share by number, sieve() the share by mass",
          "[unit][dem]")
{
  for (const Grading& g : all_curves()) {
    for (const double u : {0.01, 0.2, 0.5, 0.9, 0.99}) {
      CHECK(g.number_below(g.diameter(u)) == Approx(u).margin(1e-9));
      CHECK(g.passing(g.sieve(u)) == Approx(u).margin(1e-9));
    }
    CHECK(g.diameter(0.0) == Approx(g.smallest()).epsilon(1e-9));
    CHECK(g.diameter(1.0) == Approx(g.largest()).epsilon(1e-9));
    CHECK(g.passing(0.5 * g.smallest()) == 0.0);
    CHECK(g.passing(2.0 * g.largest()) == 1.0);
  }
}

TEST_CASE("A grading uniform by number has the paper's mean volume", "[unit][dem]")
{
  const Grading g(paper);
  // meshes/psd/README.md, maastricht.csv
  CHECK(std::cbrt(g.mean_cube()) == Approx(0.1035e-3).epsilon(5e-4));
  const double g_a = 0.15 * 0.066e-3;
  double sum = 0.0;
  for (int k = 0; k < 1000; ++k) sum += std::pow(g.diameter((k + 0.5) / 1000) + g_a, 3);
  CHECK(g.mean_cube(g_a) == Approx(sum / 1000).epsilon(1e-6));
}

TEST_CASE("Fuller's curve passes as the root of the diameter", "[unit][dem]")
{
  const Grading g(PowerSizes{1e-9, 1.0, 0.5}); // the lower bound is near zero
  CHECK(g.passing(0.25) == Approx(0.5).epsilon(1e-4));
  CHECK(g.passing(0.01) == Approx(0.1).epsilon(1e-3));
}

TEST_CASE("A log-normal curve far from its bounds has its median by mass", "[unit][dem]")
{
  const Grading g(LogNormalSizes{1e-6, 1e-2, 1e-4, 0.3});
  CHECK(g.sieve(0.5) == Approx(1e-4).epsilon(1e-9));
  // Hatch and Choate (1929): the median by number is exp(-3 spread^2) of it.
  CHECK(g.diameter(0.5) == Approx(1e-4 * std::exp(-0.27)).epsilon(1e-9));
}

TEST_CASE("maastricht.csv is the curve uniform by number within 0.001", "[unit][dem]")
{
  const Grading table(read_sieve_curve(shipped, no_other_unit)), wanted(paper);
  CHECK(table.smallest() == Approx(0.066e-3).epsilon(1e-12));
  CHECK(table.largest() == Approx(0.1337e-3).epsilon(1e-12));
  for (int k = 1; k < 100; ++k) {
    const double d = table.smallest() + 0.01 * k * (table.largest() - table.smallest());
    CHECK(table.passing(d) == Approx(wanted.passing(d)).margin(0.001)); // measured 0.0009
  }
  CHECK(std::cbrt(table.mean_cube()) == Approx(0.1035e-3).epsilon(1e-3));
}

TEST_CASE("An invalid sieve curve is refused with its line", "[unit][dem]")
{
  const std::string head = "diameter [mm],passing [%]\n";
  CHECK(refusal(head + "0.1,0\n0.2,40\n0.3,100\n").empty());
  CHECK_THAT(refusal(head + "0.1,0\n0.2,40\n0.15,100\n"),
             Contains(":4: diameter = 0.15 mm: must be above the line before, 0.2 mm"));
  CHECK_THAT(refusal(head + "0.1,0\n0.2,40\n0.25,30\n0.3,100\n"),
             Contains(":4: passing = 30 %: must not be below the line before, 40 %"));
  CHECK_THAT(refusal(head + "0.1,5\n0.2,100\n"), Contains(":2: passing = 5 %: must be 0"));
  CHECK_THAT(refusal(head + "0.1,0\n0.2,90\n"),
             Contains(":3: passing = 90 %: must be 100"));
  CHECK_THAT(refusal(head + "-0.1,0\n0.2,100\n"), Contains(":2: diameter = -0.1 mm"));
  CHECK_THAT(refusal(head + "0.1,nan\n0.2,100\n"), Contains(":2: passing = nan %"));
  CHECK_THAT(refusal("diameter [m],passing [%]\n1,0\n2,100\n"),
             Contains("column 'diameter': [m]"));
}

TEST_CASE("Grading parameters out of range are refused", "[unit][dem]")
{
  using mergel::InputError;
  CHECK_THROWS_AS(Grading(UniformSizes{2.0, 1.0}), InputError);
  CHECK_THROWS_AS(Grading(UniformSizes{0.0, 1.0}), InputError);
  CHECK_THROWS_AS(Grading(PowerSizes{1.0, 2.0, 0.0}), InputError);
  CHECK_THROWS_AS(Grading(LogNormalSizes{1.0, 2.0, 1.5, 0.0}), InputError);
  CHECK_THROWS_AS(Grading(LogNormalSizes{1.0, 2.0, 1000.0, 0.1}), InputError);
  CHECK_THROWS_AS(Grading(SieveSizes{{1.0, 2.0}, {0.0, 0.9}}), InputError);
}
