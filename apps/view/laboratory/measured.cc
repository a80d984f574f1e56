#include "apps/view/laboratory/measured.h"

#include "apps/case/units.h"
#include "apps/case/words.h"
#include "apps/laboratory/stages.h"
#include "dem/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace mergel::apps {

namespace {

constexpr std::array abscissas{"axial strain", "diametral strain",  "depth", "depth/D_p",
                               "tip depth",    "volumetric strain", "p"};

/// Names that laboratories use, and those of the histories.
struct Synonym {
  const char *measured, *of_history;
};
constexpr std::array synonyms{Synonym{"e", "void ratio"},
                              Synonym{"volumetric strain", volume_of_middle},
                              Synonym{"depth / pile diameter", "depth/D_p"}};

bool is_depth(const std::string& name)
{
  return name.find("depth") != std::string::npos;
}

std::vector<std::string> names_in(const std::vector<Run>& runs)
{
  std::vector<std::string> names;
  for (const dem::TableColumn& column : runs.front().history.columns)
    names.push_back(column.name);
  return names;
}

/// The name in the histories of what a heading names, and its unit there.
struct Found {
  std::string name, base;
};

std::optional<Found> find(const std::string& name, const dem::Table& history)
{
  try {
    return Found{name, column_of(history, name).unit};
  } catch (const InputError&) {
  }
  for (const Synonym& s : synonyms)
    if (name == s.measured && history.has(s.of_history))
      return Found{s.of_history, column_of(history, s.of_history).unit};
  return std::nullopt;
}

/// A column of a file as a quantity of the histories, in the unit of its heading.
PlotQuantity quantity_in(const Measured& m, const dem::TableColumn& column,
                         const std::vector<Run>& runs)
{
  const std::string where = m.file.string() + ": '" + column.name + "'";
  const auto found = find(column.name, runs.front().history);
  if (!found) {
    std::vector<std::string> quoted, names = names_in(runs);
    const std::string meant = nearest(column.name, names);
    for (const std::string& name : names) quoted.push_back("'" + name + "'");
    throw InputError(where + " is no column of " + runs.front().history.file.string() +
                     (meant.empty() ? "" : "; did you mean '" + meant + "'?") +
                     " There are " + joined(quoted, ", ") +
                     ", and the ratio 'A/B' of any two.");
  }
  PlotQuantity q = quantity_of(found->name);
  q.name = found->name; // as it is: "log ..." has no meaning here
  q.words = found->name;
  q.base = found->base;
  q.unit = column.unit;
  const bool is_strain = found->name.find("strain") != std::string::npos;
  if (q.unit.empty()) {
    require(q.base == "-" && !is_strain,
            where + " has no unit. Write it into the heading, such as " +
                in_quotes(column.name + (is_strain ? " [%]" : " [" + q.base + "]")) + ".");
    q.unit = "-";
  }
  try {
    unit_size(q.unit, q.base);
  } catch (const InputError& error) {
    throw InputError(where + ": " + error.what());
  }
  return q;
}

/// The number of the column that is the abscissa.
std::size_t abscissa_of(const Measured& m)
{
  const auto& columns = m.table.columns;
  for (const char* name : abscissas)
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (columns[c].name == name) return c;
  return 0;
}

/// The same quantity with the unit of an axis.
PlotQuantity for_axis(PlotQuantity q)
{
  q.unit.clear();
  return q;
}

} // namespace

Measured read_measured(const std::filesystem::path& file)
{
  Measured m{
      file, file.filename().string(), dem::read_table(file, dem::LastLine::whole), {}};
  m.text_columns = m.table.drop_text_columns();
  require(m.table.columns.size() > 1,
          file.string() +
              ": has one column. Two are needed, with their names above the "
              "numbers and commas between, such as \"axial strain [%],q [MPa]\".");
  return m;
}

std::vector<RunPlot> panels_of(const std::vector<Measured>& measured,
                               const std::vector<Run>& runs)
{
  std::vector<RunPlot> panels;
  for (const Measured& m : measured) {
    const std::size_t at = abscissa_of(m);
    const PlotQuantity x = quantity_in(m, m.table.columns[at], runs);
    for (std::size_t c = 0; c < m.table.columns.size(); ++c) {
      if (c == at) continue;
      const PlotQuantity y = quantity_in(m, m.table.columns[c], runs);
      const bool is_there =
          std::any_of(panels.begin(), panels.end(), [&](const RunPlot& panel) {
            return panel.x.name == (is_depth(x.name) ? y.name : x.name) &&
                   panel.y.name == (is_depth(x.name) ? x.name : y.name);
          });
      if (is_there) continue;
      RunPlot panel = is_depth(x.name) ? plot_of(for_axis(y), for_axis(x), runs)
                                       : plot_of(for_axis(x), for_axis(y), runs);
      if (is_depth(x.name)) panel.y_reach = Reach::downwards;
      panels.push_back(std::move(panel));
    }
  }
  return panels;
}

PlotCurve curve_in(const RunPlot& panel, const Measured& m, const std::vector<Run>& runs)
{
  const std::size_t at = abscissa_of(m);
  const PlotQuantity x = quantity_in(m, m.table.columns[at], runs);
  const auto in_unit_of = [&](const PlotQuantity& axis, std::size_t column) {
    const PlotQuantity own = quantity_in(m, m.table.columns[column], runs);
    const double factor = unit_size(own.unit, own.base) / unit_size(axis.unit, axis.base);
    std::vector<double> values = m.table.columns[column].values;
    for (double& value : values) value *= factor;
    return values;
  };
  PlotCurve curve;
  for (std::size_t c = 0; c < m.table.columns.size(); ++c) {
    if (c == at) continue;
    const std::string y = quantity_in(m, m.table.columns[c], runs).name;
    const bool is_down = is_depth(x.name);
    if (panel.x.name != (is_down ? y : x.name) || panel.y.name != (is_down ? x.name : y))
      continue;
    curve.x = in_unit_of(panel.x, is_down ? c : at);
    curve.y = in_unit_of(panel.y, is_down ? at : c);
  }
  return curve;
}

std::vector<std::string> gaps_in(const Measured& m)
{
  std::vector<std::string> lines;
  for (const std::string& name : m.text_columns)
    lines.push_back(m.file.string() + ": '" + name + "' holds text, which is not drawn");
  for (const dem::TableColumn& column : m.table.columns) {
    const auto n = std::count_if(column.values.begin(), column.values.end(),
                                 [](double value) { return !std::isfinite(value); });
    if (n > 0)
      lines.push_back(m.file.string() + ": " + std::to_string(n) + " of " +
                      std::to_string(m.table.n_rows) + " values of '" + column.name +
                      "' are missing; the curve has gaps there");
  }
  return lines;
}

} // namespace mergel::apps
