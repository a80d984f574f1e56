#include "tests/support/catch.h"

#include "apps/view/points.h"

#include "dem/error.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;

namespace {

/// The points of a file with these contents.
Points points(const std::string& contents)
{
  const auto file = std::filesystem::temp_directory_path() /
                    ("mergel-points-" + std::to_string(::getpid()) + ".csv");
  std::ofstream(file) << contents;
  struct Removed {
    std::filesystem::path file;
    ~Removed() { std::filesystem::remove(file); }
  } removed{file};
  return read_points(file, Mark::square);
}

PlotQuantity axis(const std::string& name, const std::string& unit, const std::string& base)
{
  PlotQuantity q = quantity_of(name);
  q.unit = unit;
  q.base = base;
  return q;
}
const PlotQuantity p = axis("p", "MPa", "Pa"), q = axis("q", "MPa", "Pa"),
                   e = axis("void ratio", "-", "-");

} // namespace

TEST_CASE("Points are converted to the units of the axes, in any order of columns",
          "[unit][view]")
{
  const auto shown = on_axes(points("# yield\nq [kPa],p\n500,2\n1500,3\n"), p, q);
  REQUIRE(shown);
  CHECK(shown->x == std::vector<double>{2.0, 3.0}); // without a unit: that of the axis
  CHECK(shown->y[0] == Approx(0.5).epsilon(1e-15)); // one product rounds
  CHECK(shown->y[1] == Approx(1.5).epsilon(1e-15));
  CHECK(shown->mark == Mark::square);
}

TEST_CASE("Points are named by their remark, else by their file", "[unit][view]")
{
  CHECK(points("# yield, by eye\np,q\n1,2\n").label == "yield, by eye");
  CHECK_THAT(points("p,q\n1,2").label, mergel::match::StartsWith("mergel-points-"));
}

TEST_CASE("Points are drawn on the panel of their names only", "[unit][view]")
{
  const Points yield = points("p [MPa],q [MPa]\n1,2\n");
  CHECK_FALSE(on_axes(yield, p, e));
  CHECK_FALSE(on_axes(yield, e, q));
}

TEST_CASE("Points without names, with more columns or of another unit are refused",
          "[unit][view]")
{
  CHECK_THROWS_WITH(points("1,2\n3,4\n"), Contains("with their names above"));
  CHECK_THROWS_WITH(points("p,q,e\n3,4,5\n"), Contains("must have two columns"));
  CHECK_THROWS_WITH(on_axes(points("p [mm],q\n1,2\n"), p, q), Contains("'p': [mm]"));
}
