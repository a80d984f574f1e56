#include "tests/support/catch.h"

#include "apps/view/element.h"

#include "dem/error.h"

#include <string>
#include <vector>

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;

namespace {

/// Edge and volume of a cell along three stages; strains as `mergel element` writes them.
/// The second stage approaches its stress for two records before its strain counts.
struct State {
  double stage, z, z_of_stage, V, V_of_stage;
};
const std::vector<State> states{{1, 1.00, 1.00, 1.00, 1.00}, {1, 0.98, 1.00, 0.95, 1.00},
                                {2, 0.98, 0.98, 0.95, 0.95}, {2, 0.97, 0.98, 0.94, 0.95},
                                {2, 0.96, 0.96, 0.93, 0.93}, {2, 0.90, 0.96, 0.92, 0.93},
                                {3, 0.90, 0.90, 0.92, 0.92}, {3, 0.87, 0.90, 0.91, 0.92}};

dem::Table history(double q = 1e6)
{
  dem::Table t;
  t.file = "history.csv";
  t.columns = {{"stage", "-", {}},
               {"axial strain", "-", {}},
               {"volumetric strain", "-", {}},
               {"axial strain of the stage", "-", {}},
               {"volumetric strain of the stage", "-", {}},
               {"p", "Pa", {}},
               {"q", "Pa", {}},
               {"void ratio", "-", {}}};
  for (const State& s : states) {
    const std::vector<double> row{s.stage,
                                  1.0 - s.z,
                                  1.0 - s.V,
                                  1.0 - s.z / s.z_of_stage,
                                  1.0 - s.V / s.V_of_stage,
                                  2e6,
                                  -q,
                                  2.0 * s.V - 1.0};
    for (std::size_t c = 0; c < row.size(); ++c) t.columns[c].values.push_back(row[c]);
    t.lines.push_back(++t.n_rows + 1);
  }
  return t;
}

std::vector<Run> run(double q)
{
  return {{{0, "a"}, history(q)}};
}

} // namespace

TEST_CASE("From stage 2 on strains count from the start of that stage", "[unit][view]")
{
  const dem::Table cut = from_stages(history(), stages_of("2"));
  CHECK(cut.lines == std::vector<std::size_t>{6, 7, 8, 9}); // without its approach
  const auto& axial = cut.column("axial strain", "-");
  const auto& volumetric = cut.column("volumetric strain", "-");
  const std::vector<State> drawn(states.begin() + 4, states.end());
  REQUIRE(cut.n_rows == drawn.size());
  for (std::size_t k = 0; k < drawn.size(); ++k) { // the next stage continues from there
    CHECK(axial[k] == Approx(1.0 - drawn[k].z / 0.96).margin(1e-14));
    CHECK(volumetric[k] == Approx(1.0 - drawn[k].V / 0.93).margin(1e-14));
  }
  CHECK(cut.column("axial strain of the stage", "-")[2] == 0.0);
}

TEST_CASE("The first and the last stage can be chosen, and all are the history itself",
          "[unit][view]")
{
  CHECK(from_stages(history(), stages_of("1-1")).n_rows == 2);
  CHECK(from_stages(history(), stages_of("1-2")).n_rows == 6);
  CHECK(from_stages(history(), Stages{}).n_rows == states.size());
  CHECK_THROWS_WITH(from_stages(history(), stages_of("4")),
                    Contains("no record of stage 4; the last is 3"));
  for (const char* text : {"0", "-1", "2-", "3-2", "2x", "two", ""})
    CHECK_THROWS_WITH(stages_of(text), Contains("must be the number of a stage"));
}

TEST_CASE("Parts of an unload-reload can be chosen", "[unit][view]")
{
  // Stage 2 is a loop: its unloading, its reloading.
  dem::Table t = history();
  t.columns.push_back({"part", "-", {0, 0, 1, 1, 2, 2, 0, 0}});
  for (const std::size_t c : {3u, 4u}) t.columns[c].values = t.columns[c - 2].values;
  const auto lines = [&](const char* text) {
    return from_stages(t, stages_of(text)).lines;
  };
  using Lines = std::vector<std::size_t>;
  CHECK(lines("2a") == Lines{4, 5, 6, 7, 8, 9});
  CHECK(lines("2b") == Lines{6, 7, 8, 9});
  CHECK(lines("2a-2a") == Lines{4, 5});
  CHECK(lines("2b-2") == Lines{6, 7});
  CHECK(lines("1-2a") == Lines{2, 3, 4, 5});
  CHECK(lines("2-2") == Lines{4, 5, 6, 7});
  CHECK_THROWS_WITH(lines("3a"), Contains("no record of stage 3a, but of stage 3:"));
  CHECK_THROWS_WITH(lines("1-3b"), Contains("no record of stage 3b"));
  // Two cycles: the parts alternate.
  t.columns.back().values = {0, 0, 1, 2, 1, 2, 0, 0};
  CHECK(lines("2a") == Lines{4, 5, 6, 7, 8, 9});
  CHECK(lines("2b") == Lines{5, 6, 7, 8, 9});
  CHECK(lines("2a-2a") == Lines{4, 5, 6});
  CHECK(lines("2b-2b") == Lines{5, 6, 7});
  CHECK(lines("1-2a") == Lines{2, 3, 4, 5, 6});
  CHECK_THROWS_WITH(lines("2b of cycle 2"), Contains("no record of stage 2b of cycle 2"));
  t.columns.push_back({"cycle", "-", {0, 0, 1, 1, 2, 2, 0, 0}});
  CHECK(lines("2b of cycle 2") == Lines{7, 8, 9});
  CHECK(lines("2 of cycle 2-2") == Lines{6, 7});
  CHECK(lines("2b of cycle 1-2a of cycle 2") == Lines{5, 6});
  CHECK(lines("2b-2a of cycle 2") == Lines{5, 6});
  CHECK(lines("1-2a of cycle 1") == Lines{2, 3, 4});
  CHECK_THROWS_WITH(lines("2a-2a of cycle 3"),
                    Contains("no record of stage 2a of cycle 3"));
  for (const char* text : {"2a of cycle 0", "2a of cycle", "2a of cycle 2-2a of cycle 1",
                           "2b of cycle 1-2a of cycle 1"})
    CHECK_THROWS_WITH(stages_of(text), Contains("must be the number of a stage"));
  for (const char* text : {"2c", "a", "2b-2a", "2ab", "2-a"})
    CHECK_THROWS_WITH(stages_of(text), Contains("must be the number of a stage"));
  const auto plots = element_plots({{{0, "a"}, t}}, stages_of("2b"));
  CHECK(plots[0].x.title() == "axial strain from stage 2b on (%)");
}

TEST_CASE("A run is isotropic where |q| is below 1 % of p", "[unit][view]")
{
  CHECK(is_isotropic(run(1.9e4)));
  CHECK_FALSE(is_isotropic(run(2.1e4)));
  CHECK_FALSE(is_isotropic(run(-2.1e4)));
}

TEST_CASE("Only an element test has stage, p, q and void ratio", "[unit][view]")
{
  CHECK(is_element_history(history()));
  dem::Table pile = history();
  pile.columns.pop_back();
  CHECK_FALSE(is_element_history(pile));
}

TEST_CASE("Without strains of each stage, those of the middle third count from its start",
          "[unit][view]")
{
  dem::Table t = history();
  t.columns[2].name = "volumetric strain of the middle third";
  t.columns[4] = {"cell pressure", "Pa", t.columns[5].values};
  REQUIRE(is_triaxial_history(t));
  CHECK_FALSE(is_element_history(t));
  const dem::Table cut = from_stages(t, stages_of("2"));
  CHECK(cut.lines == std::vector<std::size_t>{6, 7, 8, 9});
  const auto& volumetric = cut.column("volumetric strain of the middle third", "-");
  for (std::size_t k = 0; k < 4; ++k)
    CHECK(volumetric[k] == Approx(1.0 - states[k + 4].V / 0.93).margin(1e-14));
  // A stage that resumes counts from the stage resumed, which drew nothing itself.
  for (std::size_t k = 6; k < 8; ++k) t.columns[3].values[k] = 1.0 - states[k].z / 0.96;
  const auto resumed = from_stages(t, stages_of("3"));
  CHECK(resumed.column("volumetric strain of the middle third", "-")[0] ==
        Approx(1.0 - 0.92 / 0.93));
  const auto plots = element_plots({{{0, "a"}, t}}, stages_of("2"));
  CHECK(plots[1].y.title() == "volumetric strain from stage 2 on (%)");
}

TEST_CASE("Titles name the stage from which a strain counts", "[unit][view]")
{
  const auto plots = element_plots(run(1e6), stages_of("2"));
  REQUIRE(plots.size() == 4);
  CHECK(plots[0].x.title() == "axial strain from stage 2 on (%)");
  CHECK(plots[0].y.title() == "q (MPa)");
  CHECK(element_plots(run(1e6), {})[0].x.title() == "axial strain (%)");
  CHECK(isotropic_plots(run(0.0), {})[1].x_reach == Reach::decades);
}
