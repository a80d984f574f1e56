#include "apps/view/points.h"

#include "apps/case/units.h"
#include "apps/case/words.h"
#include "dem/error.h"

#include <cstdlib>

namespace mergel::apps {

namespace {

bool is_number(const std::string& word)
{
  char* end = nullptr;
  std::strtod(word.c_str(), &end);
  return end != word.c_str() && *end == '\0';
}

/// Column k in the unit of the axis.
std::vector<double> on_axis(const Points& points, std::size_t k, const PlotQuantity& axis)
{
  std::vector<double> values = points.values[k];
  const std::string& unit = points.names[k].unit;
  if (unit.empty() || unit == axis.unit) return values;
  try {
    const double factor = unit_size(unit, axis.base) / unit_size(axis.unit, axis.base);
    for (double& value : values) value *= factor;
  } catch (const InputError& error) {
    throw InputError(points.file.string() + ": '" + points.names[k].name +
                     "': " + error.what());
  }
  return values;
}

} // namespace

Points read_points(const std::filesystem::path& file, Mark mark)
{
  dem::Table table = dem::read_table(file, dem::LastLine::whole);
  table.drop_text_columns();
  const auto is_nameless = [&](std::size_t k) { return is_number(table.columns[k].name); };
  require(table.columns.size() == 2 && !is_nameless(0) && !is_nameless(1),
          file.string() +
              ": must have two columns, with their names above the numbers, such "
              "as \"p [MPa],q [MPa]\".");
  Points points;
  points.file = file;
  points.label = table.remarks.empty() ? file.stem().string() : table.remarks.front();
  points.mark = mark;
  for (std::size_t k = 0; k < 2; ++k) {
    const dem::TableColumn& column = table.columns[k];
    points.names[k].name = points.names[k].words = column.name;
    points.names[k].unit = column.unit;
    points.values[k] = column.values;
  }
  return points;
}

std::optional<Scatter> on_axes(const Points& points, const PlotQuantity& x,
                               const PlotQuantity& y)
{
  const auto& names = points.names;
  const bool is_x_first = names[0].name == x.name && names[1].name == y.name;
  const bool is_y_first = names[0].name == y.name && names[1].name == x.name;
  if (!is_x_first && !is_y_first) return std::nullopt;
  const std::size_t at_x = is_x_first ? 0 : 1;
  return Scatter{on_axis(points, at_x, x), on_axis(points, 1 - at_x, y), points.mark};
}

} // namespace mergel::apps
