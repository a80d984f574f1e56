#include "apps/case/units.h"

#include "apps/case/words.h"
#include "dem/error.h"

#include <udunits2.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace mergel::apps {

namespace {

using Unit = std::unique_ptr<ut_unit, void (*)(ut_unit*)>;
using Converter = std::unique_ptr<cv_converter, void (*)(cv_converter*)>;

/// The units database, read at its first use and kept until the program ends.
ut_system& unit_system()
{
  static const std::unique_ptr<ut_system, void (*)(ut_system*)> system = [] {
    ut_set_error_message_handler(ut_ignore); // the functions below write their own messages
    return std::unique_ptr<ut_system, void (*)(ut_system*)>(ut_read_xml(nullptr),
                                                            ut_free_system);
  }();
  if (!system)
    throw NumericalError("the database of units cannot be read. Install libudunits2-0, or "
                         "set UDUNITS2_XML_PATH to the path of udunits2.xml");
  return *system;
}

Unit parse_unit(const std::string& name)
{
  return {ut_parse(&unit_system(), name.c_str(), UT_UTF8), ut_free};
}

/// Whether `a` and `b` have the same dimension. udunits treats rad, percent and 1 as
/// convertible, so this function requires that their quotient is a number without unit.
bool same_dimension(const ut_unit* a, const ut_unit* b)
{
  const Unit quotient(ut_divide(a, b), ut_free);
  if (!quotient) return false;
  std::array<char, 256> buffer{};
  const int length =
      ut_format(quotient.get(), buffer.data(), buffer.size(), UT_ASCII | UT_DEFINITION);
  if (length <= 0 || static_cast<std::size_t>(length) >= buffer.size()) return false;

  std::string_view definition(buffer.data(), static_cast<std::size_t>(length));
  if (definition.ends_with(" 1")) definition.remove_suffix(2); // "0.01745 1"
  return definition.find_first_not_of("0123456789.e+-") == std::string_view::npos;
}

/// Conversion from one unit to another: a factor, and its power of ten if it is one.
struct Scale {
  double factor = 1.0;
  std::optional<int> power = 0; ///< factor = 10^power
};

/// Nothing if the units differ by more than a factor (degC, logarithms) or in dimension.
std::optional<Scale> scale(ut_unit* from, ut_unit* to)
{
  if (!same_dimension(from, to)) return std::nullopt;
  const Converter converter(ut_get_converter(from, to), cv_free);
  if (!converter || cv_convert_double(converter.get(), 0.0) != 0.0) return std::nullopt;

  Scale s{cv_convert_double(converter.get(), 1.0), std::nullopt};
  if (!(s.factor > 0.0) || !std::isfinite(s.factor)) return std::nullopt;
  // udunits gives 999.99999999999989 for g/cm3: a difference of a few bits is ignored
  const int power = static_cast<int>(std::lround(std::log10(s.factor)));
  if (std::abs(s.factor / std::pow(10.0, power) - 1.0) < 1e-13) s.power = power;
  return s;
}

/// The number at the start of a text, as written, and what follows it.
struct Split {
  std::string_view number, rest;
  double value; ///< of the number, finite
};

Split split_number(std::string_view text, const std::string& expected)
{
  text = trimmed(text);
  if (text.empty()) throw InputError("no value is given; expected " + expected);
  if (text.front() == '+' && text.size() > 1 && text[1] != '-') text.remove_prefix(1);

  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc::invalid_argument)
    throw InputError("is not a number; expected " + expected);
  if (error == std::errc::result_out_of_range)
    throw InputError("is beyond double precision; expected " + expected);
  if (!std::isfinite(value))
    throw InputError("is not a finite number; expected " + expected);

  const auto length = static_cast<std::size_t>(stop - text.data());
  const std::string_view rest = text.substr(length);
  if (rest.size() > 1 && rest[0] == ',' && rest[1] >= '0' && rest[1] <= '9')
    throw InputError("has a decimal comma; write a point, expected " + expected);
  return {text.substr(0, length), trimmed(rest), value};
}

/// The double next to number x 10^power, rounded once.
std::optional<double> shifted(std::string_view number, int power)
{
  const auto e = number.find_first_of("eE");
  int exponent = 0;
  if (e != std::string_view::npos) {
    std::string_view digits = number.substr(e + 1);
    if (digits.front() == '+') digits.remove_prefix(1);
    const auto parsed =
        std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (parsed.ec != std::errc{}) return std::nullopt; // an exponent of ten digits or more
  }
  const std::string text =
      std::string(number.substr(0, e)) + "e" + std::to_string(exponent + power);
  double value = 0.0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc{}) return std::nullopt;
  return value;
}

/// d.ddde<exponent> in a readable form: 0.0014, 195000, 1.1e9.
std::string readable(const std::string& digits, bool is_negative, int exponent)
{
  std::string text;
  if (exponent >= 0 && exponent < 6) {
    const auto n_whole = static_cast<std::size_t>(exponent + 1); // digits before the point
    text = digits.substr(0, n_whole);
    if (digits.size() > n_whole)
      text.append(".").append(digits, n_whole);
    else
      text.append(n_whole - digits.size(), '0');
  } else if (exponent < 0 && exponent >= -4) {
    text = "0.";
    text.append(static_cast<std::size_t>(-exponent - 1), '0').append(digits);
  } else {
    text = digits.substr(0, 1);
    if (digits.size() > 1) text.append(".").append(digits, 1);
    text.append("e").append(std::to_string(exponent));
  }
  return (is_negative ? "-" : "") + text;
}

/// `value` x 10^-power with the fewest digits that give `value` back.
std::string shortest(double value, int power)
{
  if (value == 0.0) return std::signbit(value) ? "-0" : "0";
  std::array<char, 64> buffer{};
  const auto written = std::to_chars(buffer.data(), buffer.data() + buffer.size(),
                                     std::abs(value), std::chars_format::scientific);
  const std::string_view text(buffer.data(),
                              static_cast<std::size_t>(written.ptr - buffer.data()));
  const auto e = text.find('e');
  std::string digits(text.substr(0, 1));
  if (e > 2) digits += text.substr(2, e - 2);
  const int exponent = std::atoi(std::string(text.substr(e + 1)).c_str());
  return readable(digits, value < 0.0, exponent - power);
}

std::string expected_of(const std::string& si_unit)
{
  if (si_unit == "1") return "a plain number, for example " + example_of(si_unit);
  return "a number with a unit such as " + si_unit + ", for example " + example_of(si_unit);
}

} // namespace

std::string example_of(const std::string& si_unit)
{
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> likely{{
      {"1", "0.3"},
      {"Pa", "0.63 GPa"},
      {"m", "1.4 mm"},
      {"rad", "60 degree"},
      {"m/s", "1.35 m/s"},
      {"kg/m3", "2556 kg/m3"},
      {"m/s2", "9.81 m/s2"},
      {"s", "2 ms"},
  }};
  for (const auto& [unit, text] : likely)
    if (unit == si_unit) return std::string(text);
  return "1 " + si_unit;
}

double to_si(const std::string& text, const std::string& si_unit)
{
  const std::string expected = expected_of(si_unit);
  const auto [number, unit_name, plain] = split_number(text, expected);

  if (si_unit == "1") {
    if (unit_name == "%")
      if (const auto value = shifted(number, -2)) return *value;
    if (!unit_name.empty())
      throw InputError("\"" + std::string(unit_name) + "\" after the number; expected " +
                       expected);
    return plain;
  }

  if (unit_name.empty()) throw InputError("has no unit; expected " + expected);
  // udunits would read "1.4 2 mm" as 2.8 mm; "1/s" is the one unit that starts with a digit
  if (!unit_name.starts_with("1/") &&
      std::string_view("0123456789.+-(").find(unit_name.front()) != std::string_view::npos)
    throw InputError("\"" + std::string(unit_name) + "\" is no unit; expected " + expected);

  const Unit from = parse_unit(std::string(unit_name));
  if (!from)
    throw InputError("unit \"" + std::string(unit_name) +
                     "\" is unknown (capitals count); expected " + expected);
  const Unit to = parse_unit(si_unit);
  if (!to) throw std::logic_error("no SI unit: " + si_unit);
  if (ut_compare(from.get(), to.get()) == 0) return plain;

  const std::optional<Scale> s = scale(from.get(), to.get());
  if (!s)
    throw InputError("unit \"" + std::string(unit_name) +
                     "\" has the wrong dimension; expected " + expected);
  const std::optional<double> value =
      s->power ? shifted(number, *s->power) : std::optional<double>(plain * s->factor);
  if (!value || !std::isfinite(*value) || (*value == 0.0 && plain != 0.0))
    throw InputError("is beyond double precision in " + si_unit + "; expected " + expected);
  return *value;
}

double unit_size(const std::string& unit, const std::string& base)
{
  if (unit == base) return 1.0;
  if (base == "-" && unit == "%") return 0.01;
  if (base == "%" && unit == "-") return 100.0;
  const auto fail = [&](const std::string& why) {
    throw InputError("[" + unit + "] for a column in [" + base + "]: " + why);
  };
  if (base == "-" || base == "%" || base.empty())
    fail("a pure number is given as it is [-] or in per cent [%].");
  try {
    return to_si("1 " + unit, base);
  } catch (const InputError& error) {
    fail(std::string(error.what()) + ".");
    throw;
  }
}

std::string with_unit(double value, const std::string& si_unit,
                      const std::string& shown_unit)
{
  if (si_unit == "1") return shortest(value, 0);
  const std::string shown = shown_unit.empty() ? si_unit : shown_unit;
  const Unit from = parse_unit(shown), to = parse_unit(si_unit);
  const std::optional<Scale> s =
      from && to ? scale(from.get(), to.get()) : std::optional<Scale>{};
  if (!s) throw std::logic_error("\"" + shown + "\" cannot show a value in " + si_unit);
  if (s->power) return shortest(value, *s->power) + " " + shown;

  // any other factor rounds: the shortest decimal that gives the same bits, if there is one
  std::array<char, 64> buffer{};
  for (int digits = 1; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    const auto written =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value / s->factor,
                      std::chars_format::scientific, digits - 1);
    double decimal = 0.0;
    std::from_chars(buffer.data(), written.ptr, decimal);
    if (decimal * s->factor == value) return shortest(decimal, 0) + " " + shown;
  }
  return shortest(value, 0) + " " + si_unit;
}

} // namespace mergel::apps
