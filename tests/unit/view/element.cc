#include "apps/view/element.h"

#include "dem/error.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace mergel;
using namespace mergel::apps;
using Catch::Matchers::Contains;

namespace {

/// Edge and volume of a cell along three legs; strains as `mergel element` writes them. The
/// second leg goes to its stress for two records before its strain counts.
struct State {
  double leg, z, z_of_leg, V, V_of_leg;
};
const std::vector<State> states{{1, 1.00, 1.00, 1.00, 1.00}, {1, 0.98, 1.00, 0.95, 1.00},
                                {2, 0.98, 0.98, 0.95, 0.95}, {2, 0.97, 0.98, 0.94, 0.95},
                                {2, 0.96, 0.96, 0.93, 0.93}, {2, 0.90, 0.96, 0.92, 0.93},
                                {3, 0.90, 0.90, 0.92, 0.92}, {3, 0.87, 0.90, 0.91, 0.92}};

dem::Table history(double q = 1e6)
{
  dem::Table t;
  t.file = "history.csv";
  t.columns = {{"leg", "-", {}},
               {"axial strain", "-", {}},
               {"volumetric strain", "-", {}},
               {"axial strain of the leg", "-", {}},
               {"volumetric strain of the leg", "-", {}},
               {"p", "Pa", {}},
               {"q", "Pa", {}},
               {"void ratio", "-", {}}};
  for (const State& s : states) {
    const std::vector<double> row{
        s.leg, 1.0 - s.z, 1.0 - s.V,      1.0 - s.z / s.z_of_leg, 1.0 - s.V / s.V_of_leg,
        2e6,   -q,        2.0 * s.V - 1.0};
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

TEST_CASE("From leg 2 on strains count from where that leg counts them", "[unit][view]")
{
  const dem::Table cut = from_legs(history(), legs_of("2"));
  CHECK(cut.lines == std::vector<std::size_t>{6, 7, 8, 9}); // not its way to the stress
  const auto& axial = cut.column("axial strain", "-");
  const auto& volumetric = cut.column("volumetric strain", "-");
  const std::vector<State> drawn(states.begin() + 4, states.end());
  REQUIRE(cut.n_rows == drawn.size());
  for (std::size_t k = 0; k < drawn.size(); ++k) { // the next leg goes on from there
    CHECK(axial[k] == Approx(1.0 - drawn[k].z / 0.96).margin(1e-14));
    CHECK(volumetric[k] == Approx(1.0 - drawn[k].V / 0.93).margin(1e-14));
  }
  CHECK(cut.column("axial strain of the leg", "-")[2] == 0.0);
}

TEST_CASE("Legs may be cut at both ends, and all are the history itself", "[unit][view]")
{
  CHECK(from_legs(history(), legs_of("1-1")).n_rows == 2);
  CHECK(from_legs(history(), legs_of("1-2")).n_rows == 6);
  CHECK(from_legs(history(), Legs{}).n_rows == states.size());
  CHECK_THROWS_WITH(from_legs(history(), legs_of("4")),
                    Contains("no record of leg 4; the last is 3"));
  for (const char* text : {"0", "-1", "2-", "3-2", "2x", "two", ""})
    CHECK_THROWS_WITH(legs_of(text), Contains("must be the number of a leg"));
}

TEST_CASE("A run is isotropic below a q of 1 % of p, of either sign", "[unit][view]")
{
  CHECK(is_isotropic(run(1.9e4)));
  CHECK_FALSE(is_isotropic(run(2.1e4)));
  CHECK_FALSE(is_isotropic(run(-2.1e4)));
}

TEST_CASE("Only an element test has leg, p, q and void ratio", "[unit][view]")
{
  CHECK(is_element_history(history()));
  dem::Table pile = history();
  pile.columns.pop_back();
  CHECK_FALSE(is_element_history(pile));
}

TEST_CASE("Titles say from which leg a strain counts", "[unit][view]")
{
  const auto plots = element_plots(run(1e6), legs_of("2"));
  REQUIRE(plots.size() == 4);
  CHECK(plots[0].x.title() == "axial strain from leg 2 on (%)");
  CHECK(plots[0].y.title() == "q (MPa)");
  CHECK(element_plots(run(1e6), {})[0].x.title() == "axial strain (%)");
  CHECK(isotropic_plots(run(0.0), {})[1].x_reach == Reach::decades);
}
