#include "tests/support/catch.h"

#include "apps/view/quantity.h"

#include "dem/error.h"

#include <cmath>
#include <string>

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;

namespace {

dem::Table history()
{
  dem::Table t;
  t.file = "history.csv";
  t.columns = {{"axial strain", "-", {0.0, 0.01, 0.02}},
               {"p", "Pa", {1.0, 1e6, 2e6}},
               {"q", "Pa", {5e5, 3e6, 2e6}},
               {"boundary work", "J", {0.0, 0.01, 0.03}},
               {"depth/D_p", "-", {0.0, 1.0, 2.0}}};
  t.n_rows = 3;
  return t;
}

PlotQuantity settled(const std::string& text)
{
  const dem::Table t = history();
  PlotQuantity q = quantity_of(text);
  settle(q, {&t});
  return q;
}

std::string refusal(const std::string& text)
{
  try {
    settled(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

} // namespace

TEST_CASE("Stresses are drawn in MPa, strains in per cent, energies with a prefix",
          "[unit][view]")
{
  CHECK(settled("q").title() == "q (MPa)");
  CHECK(settled("axial strain").title() == "axial strain (%)");
  CHECK(settled("boundary work").title() == "boundary work (mJ)");
  CHECK(settled("depth/D_p").title() == "depth/D_p");
  CHECK(values_of(history(), settled("q")) == std::vector<double>{0.5, 3.0, 2.0});
  CHECK(values_of(history(), settled("axial strain")) ==
        std::vector<double>{0.0, 1.0, 2.0});
}

TEST_CASE("A unit that is given is the one that is drawn", "[unit][view]")
{
  CHECK(settled("q [Pa]").title() == "q (Pa)");
  CHECK(values_of(history(), settled("q [kPa]")) == std::vector<double>{500, 3000, 2000});
  CHECK(settled("axial strain [-]").title() == "axial strain");
  CHECK(values_of(history(), settled("log p [MPa]"))[1] == 1.0);
  CHECK(settled("log p").is_logarithmic);
}

TEST_CASE("A/B is the ratio of two columns, and NaN where B is near zero", "[unit][view]")
{
  const PlotQuantity eta = settled("q/p");
  CHECK(eta.unit == "-");
  const std::vector<double> values = values_of(history(), eta);
  CHECK(std::isnan(values[0])); // p = 1 Pa is 5e-7 of the largest
  CHECK(values[1] == 3.0);
  CHECK(values[2] == 1.0);
  CHECK(settled("depth/D_p").base == "-"); // a column of that name is no ratio
  CHECK(settled("q/axial strain").title() == "q/axial strain (MPa)");
  CHECK(settled("boundary work / p").base == "J/Pa");
}

TEST_CASE("Columns and units that do not fit are refused by name", "[unit][view]")
{
  CHECK_THAT(refusal("qq"), Contains("no column 'qq'") && Contains("'axial strain', 'p'"));
  CHECK_THAT(refusal("q [mm]"),
             Contains("[mm] for a column in [Pa]") && Contains("dimension"));
  CHECK_THAT(refusal("axial strain [MPa]"), Contains("pure number"));
  CHECK_THAT(refusal("q/r"), Contains("no column 'q/r'"));
  CHECK_THROWS_WITH(curve_of("q"), Contains("with a colon between"));
  CHECK_THROWS_WITH(curve_of("q:"), Contains("with a colon between"));
  CHECK_THROWS_WITH(curve_of("a:b:c"), Contains("with a colon between"));
  CHECK(curve_of("axial strain [%]: q [MPa]")[1].name == "q");
}
