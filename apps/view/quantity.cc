#include "apps/view/quantity.h"

#include "apps/case/units.h"
#include "apps/case/words.h"
#include "apps/view/curve.h"
#include "dem/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace mergel::apps {

namespace {

constexpr double smallest_divisor = 1e-3; // of its largest

const dem::TableColumn* find(const dem::Table& history, const std::string& name)
{
  for (const dem::TableColumn& column : history.columns)
    if (column.name == name) return &column;
  return nullptr;
}

/// The two columns of "A/B"; a name may hold a slash itself.
std::optional<std::array<const dem::TableColumn*, 2>> find_ratio(const dem::Table& history,
                                                                 const std::string& name)
{
  for (std::size_t at = name.find('/'); at != std::string::npos;
       at = name.find('/', at + 1)) {
    const auto* above = find(history, std::string(trimmed(name.substr(0, at))));
    const auto* below = find(history, std::string(trimmed(name.substr(at + 1))));
    if (above != nullptr && below != nullptr) return {{above, below}};
  }
  return std::nullopt;
}

double largest(const std::vector<double>& values)
{
  const Range r = range(values);
  return std::max(-r.low, r.high);
}

std::string unit_of_ratio(const std::string& above, const std::string& below)
{
  if (above == below) return "-";
  if (below == "-") return above;
  return (above == "-" ? "1" : above) + "/" + below;
}

dem::TableColumn ratio(const dem::TableColumn& above, const dem::TableColumn& below,
                       const std::string& name)
{
  dem::TableColumn result{name, unit_of_ratio(above.unit, below.unit), above.values};
  const double smallest = smallest_divisor * largest(below.values);
  for (std::size_t row = 0; row < result.values.size(); ++row) {
    const double divisor = below.values[row];
    result.values[row] = std::abs(divisor) > smallest // and so not 0
                             ? result.values[row] / divisor
                             : std::numeric_limits<double>::quiet_NaN();
  }
  return result;
}

std::string usual_unit(const std::string& name, const std::string& base, double largest)
{
  if (base == "Pa") return "MPa";
  if (base == "-") return name.find("strain") != std::string::npos ? "%" : "-";
  return convenient_unit(largest, base).name;
}

} // namespace

std::string PlotQuantity::title() const
{
  return unit == "-" || unit.empty() ? words : words + " (" + unit + ")";
}

PlotQuantity quantity_of(const std::string& text)
{
  std::string name(trimmed(text));
  PlotQuantity q;
  const std::size_t open = name.rfind('[');
  if (open != std::string::npos && name.back() == ']') {
    q.unit = std::string(trimmed(name.substr(open + 1, name.size() - open - 2)));
    name = std::string(trimmed(name.substr(0, open)));
  }
  const std::string logarithm = "log ";
  if (name.starts_with(logarithm)) {
    q.is_logarithmic = true;
    name = std::string(trimmed(name.substr(logarithm.size())));
  }
  q.name = q.words = name;
  return q;
}

std::array<PlotQuantity, 2> curve_of(const std::string& text)
{
  const std::size_t colon = text.find(':');
  const bool is_one = colon != std::string::npos && colon == text.rfind(':');
  const std::string y = is_one ? text.substr(colon + 1) : "";
  std::array<PlotQuantity, 2> xy{quantity_of(text.substr(0, colon)), quantity_of(y)};
  require(is_one && !xy[0].name.empty() && !xy[1].name.empty(),
          "--curve " + in_quotes(text) +
              ": must be two columns of history.csv with a colon between, such as "
              "\"axial strain [%]:q [MPa]\".");
  return xy;
}

dem::TableColumn column_of(const dem::Table& history, const std::string& name)
{
  if (const auto* column = find(history, name)) return *column;
  if (const auto two = find_ratio(history, name))
    return ratio(*(*two)[0], *(*two)[1], name);
  std::vector<std::string> names;
  for (const dem::TableColumn& column : history.columns)
    names.push_back("'" + column.name + "'");
  throw InputError(history.file.string() + ": no column '" + name + "'; there are " +
                   joined(names, ", ") + ", and the ratio 'A/B' of any two.");
}

void settle(PlotQuantity& quantity, const std::vector<const dem::Table*>& histories)
{
  double most = 0.0;
  for (const dem::Table* history : histories) {
    const dem::TableColumn column = column_of(*history, quantity.name);
    require(quantity.base.empty() || quantity.base == column.unit,
            history->file.string() + ": '" + quantity.name + "' is in [" + column.unit +
                "], in the other runs in [" + quantity.base +
                "]: they cannot share an axis. Draw them one by one.");
    quantity.base = column.unit;
    most = std::max(most, largest(column.values));
  }
  if (quantity.unit.empty()) quantity.unit = usual_unit(quantity.name, quantity.base, most);
  unit_size(quantity.unit, quantity.base); // throws if they do not fit
}

std::vector<double> values_of(const dem::Table& history, const PlotQuantity& quantity)
{
  std::vector<double> values = column_of(history, quantity.name).values;
  const double size = unit_size(quantity.unit, quantity.base);
  for (double& value : values) value /= size;
  return values;
}

} // namespace mergel::apps
