#include "tests/support/catch.h"
#include "tests/support/polyhedra.h"

#include "dem/error.h"
#include "dem/io/readable.h"
#include "dem/io/stl_file.h"

#include <cstring>
#include <limits>
#include <random>

using namespace mergel::dem;
using namespace mergel::dem::test;
using mergel::match::Contains;

namespace {

const ClosedSurface pile = cone_ended_surface(0.7, 1.2, 5.3, 12);

std::string refusal(const std::string& bytes)
{
  try {
    stl_from(bytes, "pile.stl");
  } catch (const mergel::InputError& e) {
    return e.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& what, const std::string& by)
{
  const auto at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

/// The first file position behind a fraction of the bytes.
std::string cut(const std::string& bytes, double fraction)
{
  return bytes.substr(
      0, static_cast<std::size_t>(fraction * static_cast<double>(bytes.size())));
}

} // namespace

TEST_CASE("an ASCII and a binary file of a surface hold the same triangles", "[unit][dem]")
{
  const auto binary = stl_from(binary_stl(pile), "pile.stl");
  REQUIRE(binary.size() == pile.triangles.size());
  for (std::size_t t = 0; t < binary.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& x = pile.x[uz(pile.triangles[t][k])];
      CHECK((binary[t][k] - x).norm() < 6e-8 * 6.0); // 24 bits
    }
  const ClosedSurface joined = join_corners(binary);
  CHECK(joined.x.size() == pile.x.size());
  require_closed(joined);

  // Where a file has the digits of the binary numbers, it gives the same bits.
  ClosedSurface exact = joined;
  CHECK(stl_from(ascii_stl(exact), "pile.stl") == binary);
  CHECK(stl_from(replaced(ascii_stl(exact), "vertex", "VERTEX"), "pile.stl") == binary);
  std::string windows;
  for (const char c : ascii_stl(exact)) windows += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(stl_from("\n  " + windows, "pile.stl") == binary);
  CHECK(stl_from(ascii_stl(exact) + ascii_stl(exact), "pile.stl").size() ==
        2 * binary.size());
}

TEST_CASE("a number of a binary file is the shortest decimal number for it", "[unit][dem]")
{
  const auto triangles = stl_from(
      binary_stl({{{0.1, 0, 0}, {1, 0, 0}, {0, 2.3e-7, 1e9}}, {{0, 1, 2}}}), "pile.stl");
  CHECK(triangles[0][0].x() == 0.1);
  CHECK(triangles[0][2] == Vec3(0.0, 2.3e-7, 1e9));
}

TEST_CASE("a damaged STL file is refused, with its line where it has lines", "[unit][dem]")
{
  const std::string ascii = ascii_stl(pile), binary = binary_stl(pile);
  const auto with = [&](const std::string& what, const std::string& by) {
    return refusal(replaced(ascii, what, by));
  };
  CHECK(refusal("") ==
        "pile.stl: is no STL file. Export it again, as ASCII or binary STL.");
  CHECK_THAT(refusal("solid"), Contains("pile.stl: ends without \"endsolid\""));
  CHECK_THAT(refusal("solid a\nendsolid a\n"), Contains("pile.stl: has no triangles"));
  CHECK_THAT(refusal("ISO-10303-21;\nHEADER;\n"), Contains("is no STL file"));
  CHECK_THAT(
      with("facet", "facets"),
      Contains("pile.stl:2: \"facets\" where \"facet\" or \"endsolid\" is expected"));
  CHECK_THAT(with("normal", "norm"),
             Contains("pile.stl:2: \"norm\" where \"normal\" is expected"));
  CHECK_THAT(with("outer", "inner"),
             Contains("pile.stl:3: \"inner\" where \"outer\" is expected"));
  CHECK_THAT(with("vertex", "vertex x"), Contains("pile.stl:4: \"x\" is no coordinate"));
  CHECK_THAT(with("vertex", "vertex nan"),
             Contains("pile.stl:4: \"nan\" is no coordinate"));
  CHECK_THAT(with("vertex", "vertex 1e999"),
             Contains("pile.stl:4: \"1e999\" is no coordinate"));
  CHECK_THAT(with("vertex", "vertex 1,5"),
             Contains("pile.stl:4: \"1,5\" is no coordinate"));
  CHECK_THAT(with("vertex", "endloop"),
             Contains("pile.stl:4: \"endloop\" where \"vertex\" is expected"));
  CHECK_THAT(with("endsolid pile", "end"),
             Contains("\"end\" where \"facet\" or \"endsolid\" is expected"));
  CHECK_THAT(refusal(ascii + "rubbish"),
             Contains("\"rubbish\" where \"solid\" or the end is expected"));

  CHECK_THAT(refusal(binary.substr(0, 84)), Contains("pile.stl"));
  std::string none = binary.substr(0, 84);
  for (std::size_t k = 80; k < 84; ++k) none[k] = '\0';
  CHECK_THAT(refusal(none), Contains("has no triangles"));
  std::string infinite = binary;
  const float huge = std::numeric_limits<float>::infinity();
  std::memcpy(infinite.data() + 84 + 50 + 12, &huge, sizeof huge);
  CHECK_THAT(refusal(infinite), Contains("triangle 2: a coordinate is not a number"));
  std::string unnamed = binary;
  unnamed.replace(0, 5, "other");
  CHECK(refusal(unnamed).empty());
  CHECK_THAT(refusal(unnamed + "x"),
             Contains("as a binary one it counts 48 triangles of 50 bytes"));

  // Cut off anywhere, either is refused.
  for (double fraction = 0.0; fraction < 0.995; fraction += 0.01) {
    CAPTURE(fraction);
    CHECK(refusal(cut(ascii, fraction)) != "");
    CHECK(refusal(cut(unnamed, fraction)) != "");
    CHECK(refusal(cut(binary, fraction)) != "");
  }
}

TEST_CASE("bytes of an STL file that are changed at random give triangles or one message",
          "[unit][dem]")
{
  std::mt19937_64 random(11);
  for (const std::string& good : {ascii_stl(pile), binary_stl(pile)})
    for (int round = 0; round < 300; ++round) {
      std::string bytes = good;
      for (int k = 0; k < 3; ++k)
        bytes[random() % bytes.size()] = static_cast<char>(random());
      try {
        const auto triangles = stl_from(bytes, "pile.stl");
        make_polyhedron(join_corners(triangles));
      } catch (const mergel::InputError& e) {
        CHECK(std::string(e.what()).size() > 10);
      }
    }
}

TEST_CASE("an STL file that is not there is named with the reason", "[unit][dem]")
{
  CHECK_THROWS_WITH(require_readable("/none/pile.stl"),
                    Contains("/none/pile.stl: cannot be read"));
}
