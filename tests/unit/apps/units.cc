#include "tests/support/catch.h"

#include "apps/case/units.h"

#include "dem/error.h"

#include <bit>
#include <cstdint>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;

TEST_CASE("A value with a decimal unit is the literal, bit for bit", "[unit][apps]")
{
  CHECK(to_si("1.4 mm", "m") == 1.4e-3);
  CHECK(to_si("8.4mm", "m") == 8.4e-3); // as a product it is 0.0084000000000000012
  CHECK(to_si("0.63 GPa", "Pa") == 0.63e9);
  CHECK(to_si(" +1.35  m/s ", "m/s") == 1.35);
  CHECK(to_si("2.556 g/cm3", "kg/m3") == 2556.0);
  CHECK(to_si("1e1 mrad", "rad") == 1e-2);
  CHECK(to_si("0.3", "1") == 0.3);
  CHECK(to_si("-.5", "1") == -0.5);
  CHECK(to_si("103.5 µm", "m") == 103.5e-6);
  CHECK(to_si("3 N/m2", "Pa") == 3.0);
  CHECK(to_si("5 1/s", "s-1") == 5.0);
}

TEST_CASE("Angles and rotation rates convert by their factor", "[unit][apps]")
{
  // udunits holds pi/180 to 2e-16 relative
  CHECK(to_si("60 degree", "rad") == Approx(std::numbers::pi / 3.0).epsilon(1e-15));
  CHECK(to_si("1 rpm", "rad/s") == Approx(std::numbers::pi / 30.0).epsilon(1e-15));
  CHECK(to_si("1 rad", "rad") == 1.0);
}

TEST_CASE("What is not a number with the right unit is refused, with the reason",
          "[unit][apps]")
{
  const auto message = [](const std::string& text, const std::string& unit) -> std::string {
    try {
      to_si(text, unit);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::string expects_m =
      "; expected a number with a unit such as m, for example 1.4 mm";

  CHECK(message("", "m") == "no value is given" + expects_m);
  CHECK(message("1.4", "m") == "has no unit" + expects_m);
  CHECK(message("1.4 MPa", "m") == "unit \"MPa\" has the wrong dimension" + expects_m);
  CHECK(message("1.4 furlong per", "m") ==
        "unit \"furlong per\" is unknown (capitals count)" + expects_m);
  CHECK(message("1.4 2 mm", "m") == "\"2 mm\" is no unit" + expects_m);
  CHECK(message("wide", "m") == "is not a number" + expects_m);
  CHECK(message("nan m", "m") == "is not a finite number" + expects_m);
  CHECK(message("-inf m", "m") == "is not a finite number" + expects_m);
  CHECK(message("1e999 m", "m") == "is beyond double precision" + expects_m);
  CHECK(message("1e307 km", "m") == "is beyond double precision in m" + expects_m);
  CHECK_THAT(message("1,4 mm", "m"), Contains("decimal comma"));
  CHECK_THAT(message("3 mm @ 5", "m"), Contains("wrong dimension"));
  CHECK_THAT(message("3 degC", "K"), Contains("wrong dimension"));
  CHECK_THAT(message("3 lg(re mm)", "m"), Contains("wrong dimension"));

  // udunits takes rad, percent, steradian and 1 for the same unit, and "" for 1
  CHECK_THAT(message("60", "rad"), Contains("has no unit") && Contains("60 degree"));
  CHECK_THAT(message("60 percent", "rad"), Contains("wrong dimension"));
  CHECK_THAT(message("60 sr", "rad"), Contains("wrong dimension"));
  CHECK_THAT(message("60 1", "rad"), Contains("is no unit"));
  CHECK_THAT(message("60 Hz", "rad/s"), Contains("wrong dimension"));
  CHECK(message("0.3 rad", "1") ==
        "\"rad\" after the number; expected a plain number, for example 0.3");
  CHECK_THAT(message("52 percent", "1"), Contains("expected a plain number"));
  CHECK(to_si("52 %", "1") == 0.52);
}

TEST_CASE("with_unit() writes the fewest digits and the unit asked for", "[unit][apps]")
{
  CHECK(with_unit(1.4e-3, "m", "mm") == "1.4 mm");
  CHECK(with_unit(0.63e9, "Pa", "GPa") == "0.63 GPa");
  CHECK(with_unit(0.63e9, "Pa") == "6.3e8 Pa");
  CHECK(with_unit(195000.0, "1") == "195000");
  CHECK(with_unit(-0.14, "1") == "-0.14");
  CHECK(with_unit(0.1 + 0.2, "m") == "0.30000000000000004 m");
  CHECK(with_unit(-0.0, "m") == "-0 m");
  CHECK(with_unit(to_si("60 degree", "rad"), "rad", "degree") == "60 degree");
  CHECK_THROWS_AS(with_unit(1.0, "m", "MPa"), std::logic_error);
}

TEST_CASE("with_unit() and to_si() give any double back bit for bit", "[unit][apps]")
{
  std::mt19937_64 random(1);
  int n_tried = 0, n_in_si = 0;
  for (int i = 0; i < 20000; ++i) {
    // every bit pattern between 1e-30 and 1e30, either sign
    const auto bits = random();
    const auto value = std::bit_cast<double>(bits);
    if (!(std::abs(value) > 1e-30 && std::abs(value) < 1e30)) continue;
    ++n_tried;
    for (const auto& [si, shown] :
         {std::pair("m", "m"), std::pair("m", "mm"), std::pair("Pa", "GPa"),
          std::pair("kg/m3", "g/cm3"), std::pair("rad", "degree"), std::pair("1", "1")}) {
      const std::string text = with_unit(value, si, shown);
      if (std::bit_cast<std::uint64_t>(to_si(text, si)) != bits)
        FAIL(text << " is not " << value);
      n_in_si += std::string(shown) == "degree" && text.ends_with(" rad");
    }
  }
  CHECK(n_tried > 1500);
  CHECK(n_in_si < n_tried); // radians only where no decimal in degrees is exact
}
