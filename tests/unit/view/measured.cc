#include "apps/view/laboratory/measured.h"

#include "apps/view/laboratory/mean_runs.h"
#include "apps/view/resolution.h"
#include "dem/error.h"
#include "tests/support/catch.h"
#include "tests/support/temporary_folder.h"

#include <cmath>
#include <fstream>
#include <limits>

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;

namespace {

Measured measured(const std::string& contents)
{
  const TemporaryFolder folder;
  const auto file = folder.path / "lab.csv";
  std::ofstream(file) << contents;
  return read_measured(file);
}

std::vector<Run> runs_with(const std::vector<dem::TableColumn>& columns)
{
  dem::Table history;
  history.file = "run/history.csv";
  history.columns = columns;
  history.n_rows = columns.front().values.size();
  history.lines.resize(history.n_rows);
  return {{{0, "run"}, history, std::nullopt}};
}

const std::vector<Run> element = runs_with({{"axial strain", "-", {0.0, 0.1}},
                                            {"volumetric strain", "-", {0.0, -0.1}},
                                            {"p", "Pa", {1e6, 2e6}},
                                            {"q", "Pa", {0.0, 3e6}},
                                            {"void ratio", "-", {1.1, 1.2}}});
const std::vector<Run> pile = runs_with({{"depth", "m", {0.0, 5e-3}},
                                         {"depth/D_p", "-", {0.0, 3.6}},
                                         {"q_c", "Pa", {0.0, 9e6}}});

} // namespace

TEST_CASE("Each column of a measured file is in a panel, in the unit of the panel",
          "[unit][view]")
{
  // The axial strain is the abscissa, wherever it stands.
  const Measured m = measured("q [kPa],axial strain [%],e\n100,0.5,1.1\n4000,2,1.15\n");
  CHECK(m.label == "lab.csv");
  const auto panels = panels_of({m}, element);
  REQUIRE(panels.size() == 2);
  CHECK(panels[0].x.name == "axial strain");
  CHECK(panels[0].y.name == "q");
  CHECK(panels[1].y.name == "void ratio");
  const PlotCurve q = curve_in(panels[0], m, element);
  CHECK(q.x[0] == Approx(0.5)); // axes in % and MPa
  CHECK(q.y[1] == Approx(4.0));
  CHECK(curve_in(panels[1], m, element).y == std::vector<double>{1.1, 1.15});
}

TEST_CASE("Files with the same pair share a panel; another pair is none of its curves",
          "[unit][view]")
{
  const Measured a = measured("axial strain [-],q [MPa]\n0.1,1\n"),
                 b = measured("axial strain [%],q [Pa]\n10,1e6\n"),
                 c = measured("p [MPa],q [MPa]\n1,1\n");
  const auto panels = panels_of({a, b, c}, element);
  REQUIRE(panels.size() == 2);
  CHECK(curve_in(panels[0], a, element).y[0] ==
        Approx(curve_in(panels[0], b, element).y[0]));
  CHECK(curve_in(panels[0], a, element).x[0] ==
        Approx(curve_in(panels[0], b, element).x[0]));
  CHECK(curve_in(panels[0], c, element).x.empty());
  CHECK(curve_in(panels[1], c, element).x.size() == 1);
}

TEST_CASE("The depth of a pile grows downwards", "[unit][view]")
{
  const Measured m = measured("depth [mm],q_c [MPa]\n1,2\n4,8\n");
  const auto panels = panels_of({m}, pile);
  REQUIRE(panels.size() == 1);
  CHECK(panels[0].y.name == "depth");
  CHECK(panels[0].y_reach == Reach::downwards);
  const PlotCurve curve = curve_in(panels[0], m, pile);
  CHECK(curve.y[1] == Approx(4.0)); // mm, as the axis
  CHECK(curve.x[1] == Approx(8.0));
  const Axis axis = fitting_axis({"depth", Reach::downwards}, curve.y);
  CHECK(axis.from == 4.0);
  CHECK(axis.to == 0.0);
}

TEST_CASE("A ratio of two columns and the strain of the middle third can be measured",
          "[unit][view]")
{
  const auto cell =
      runs_with({{"axial strain", "-", {0.0, 0.1}},
                 {"p", "Pa", {1e6, 2e6}},
                 {"q", "Pa", {0.0, 3e6}},
                 {"volumetric strain of the middle third", "-", {0.0, 0.01}}});
  const auto panels = panels_of(
      {measured("axial strain [%],volumetric strain [%],q/p\n1,0.2,1.4\n")}, cell);
  REQUIRE(panels.size() == 2);
  CHECK(panels[0].y.name == "volumetric strain of the middle third");
  CHECK(panels[1].y.name == "q/p");
}

TEST_CASE("A heading that no run has, or whose unit is missing or wrong, is refused",
          "[unit][view]")
{
  const auto refusal = [](const std::string& contents) -> std::string {
    try {
      panels_of({measured(contents)}, element);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(refusal("axial strian [%],q [MPa]\n1,2\n"),
             Contains("'axial strian' is no column of run/history.csv; did you mean 'axial "
                      "strain'? There are 'axial strain', 'volumetric strain', 'p', 'q'"));
  CHECK_THAT(refusal("axial strain [%],q\n1,2\n"),
             Contains("'q' has no unit. Write it into the heading, such as \"q [Pa]\""));
  CHECK_THAT(refusal("axial strain,q [MPa]\n1,2\n"),
             Contains("'axial strain' has no unit"));
  CHECK_THAT(refusal("axial strain [%],q [mm]\n1,2\n"), Contains("wrong dimension"));
  CHECK_THAT(refusal("axial strain [mm],q [MPa]\n1,2\n"), Contains("'axial strain': [mm]"));
  CHECK_THROWS_WITH(measured("q [MPa]\n1\n"), Contains("has one column"));
  CHECK_THROWS_WITH(measured("axial strain [%],q [MPa]\n"), Contains("holds no record"));
}

TEST_CASE("Values that a measured curve lacks are told", "[unit][view]")
{
  const auto lines = gaps_in(measured("axial strain [%],q [MPa]\n1,2\n2,\n3,nan\n"));
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines[0], Contains("2 of 3 values of 'q' are missing"));
  CHECK(gaps_in(measured("axial strain [%],q [MPa]\n1,2\n")).empty());
}

TEST_CASE("The mean of runs is taken at equal strain, as far as all of them reach",
          "[unit][view]")
{
  const auto run = [](double slope, double end) {
    std::vector<dem::TableColumn> columns{{"axial strain", "-", {}}, {"q", "Pa", {}}};
    for (const double strain : {0.0, 0.5 * end, 0.4 * end, end}) { // a loop in it
      columns[0].values.push_back(strain);
      columns[1].values.push_back(slope * strain);
    }
    return runs_with(columns).front();
  };
  const Run mean = mean_of({run(1e8, 0.02), run(3e8, 0.03)}, {4, "two"});
  CHECK(mean.name.label == "two");
  CHECK(mean.history.columns[0].values == std::vector<double>{0.0, 0.01, 0.02});
  CHECK(mean.history.columns[1].values[1] == Approx(2e6)); // 1 and 3 MPa
  CHECK(mean.history.columns[1].values[2] == Approx(4e6));
  REQUIRE(mean.error);
  CHECK(mean.error->columns[1].values[1] == Approx(1e6)); // half the difference of two
  CHECK(mean.history.n_rows == 3);
}

TEST_CASE("A picture states its resolution in a chunk with the right checksum",
          "[unit][view]")
{
  const std::string head(33, 'h');
  const std::string png = with_resolution(head + "rest", 300.0);
  // 300 dpi are 11811 pixels a metre; the checksum is that of zlib's crc32.
  const std::string chunk("\0\0\0\x09pHYs\0\0\x2e\x23\0\0\x2e\x23\x01\x78\xa5\x3f\x76", 21);
  CHECK(png == head + chunk + "rest");
}
