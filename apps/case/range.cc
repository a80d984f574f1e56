#include "apps/case/range.h"

#include "apps/case/units.h"

#include <cmath>
#include <utility>

namespace mergel::apps {

bool Range::holds(double value) const
{
  return (is_lower_open ? value > lower : value >= lower) &&
         (is_upper_open ? value < upper : value <= upper);
}

std::string Range::text(const std::string& si_unit, const std::string& shown_unit) const
{
  const auto bound = [&](double value) {
    return value == 0.0 ? "0" : with_unit(value, si_unit, shown_unit);
  };
  const bool has_lower = std::isfinite(lower), has_upper = std::isfinite(upper);
  const std::string below = is_upper_open ? " < " : " <= ";
  if (has_lower && has_upper)
    return bound(lower) + (is_lower_open ? " < " : " <= ") + symbol + below + bound(upper);
  if (has_lower) return symbol + (is_lower_open ? " > " : " >= ") + bound(lower);
  if (has_upper) return symbol + below + bound(upper);
  return "any number";
}

Range Range::named(std::string new_symbol) const
{
  Range range = *this;
  range.symbol = std::move(new_symbol);
  return range;
}

Range Range::advise(std::string new_remedy) const
{
  Range range = *this;
  range.remedy = std::move(new_remedy);
  return range;
}

Range between(double a, double b)
{
  return {.lower = a, .upper = b};
}
Range from_to(double a, double b)
{
  return {.lower = a, .upper = b, .is_upper_open = true};
}
Range above_to(double a, double b)
{
  return {.lower = a, .upper = b, .is_lower_open = true};
}
Range inside(double a, double b)
{
  return {.lower = a, .upper = b, .is_lower_open = true, .is_upper_open = true};
}
Range at_least(double a)
{
  return {.lower = a};
}

} // namespace mergel::apps
