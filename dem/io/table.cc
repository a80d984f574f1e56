#include "dem/io/table.h"

#include "dem/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>

namespace mergel::dem {

namespace {

std::string_view trimmed(std::string_view text)
{
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> split(std::string_view line)
{
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

/// "tip force [N]" -> name "tip force", unit "N".
TableColumn heading(std::string_view cell)
{
  const std::size_t open = cell.rfind('[');
  if (open == std::string_view::npos || cell.back() != ']')
    return {std::string(cell), "", {}};
  return {std::string(trimmed(cell.substr(0, open))),
          std::string(cell.substr(open + 1, cell.size() - open - 2)),
          {}};
}

/// False unless the whole cell is a number; an empty cell is NaN.
bool parse(std::string_view cell, double& value)
{
  if (cell.empty()) {
    value = std::numeric_limits<double>::quiet_NaN();
    return true;
  }
  if (cell.front() == '+') cell.remove_prefix(1);
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc{} && end == cell.data() + cell.size();
}

std::string quoted_names(const Table& table)
{
  std::string names;
  for (const TableColumn& c : table.columns)
    names += (names.empty() ? "'" : ", '") + c.name + " [" + c.unit + "]'";
  return names;
}

const TableColumn* find(const Table& table, std::string_view name)
{
  const auto found =
      std::find_if(table.columns.begin(), table.columns.end(),
                   [&](const TableColumn& column) { return column.name == name; });
  return found == table.columns.end() ? nullptr : &*found;
}

} // namespace

bool Table::has(std::string_view name) const
{
  return find(*this, name) != nullptr;
}

const std::vector<double>& Table::column(std::string_view name, std::string_view unit) const
{
  const TableColumn* found = find(*this, name);
  require(found != nullptr && found->unit == unit,
          file.string() + ": no column '" + std::string(name) + " [" + std::string(unit) +
              "]'; there are " + quoted_names(*this) + ".");
  return found->values;
}

Table read_table(const std::filesystem::path& file, LastLine last)
{
  std::ifstream in(file);
  std::error_code error; // for a name that is too long, or a folder without permission
  require(std::filesystem::is_regular_file(file, error) && in.good(),
          file.string() + ": cannot be read. Check the name and its permissions.");

  Table table;
  table.file = file;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    const std::string where = file.string() + ":" + std::to_string(number) + ": ";
    const bool is_complete = !in.eof(); // getline stopped at a newline
    if (trimmed(line).empty()) continue;
    if (trimmed(line).front() == '#') {
      table.remarks.emplace_back(trimmed(trimmed(line).substr(1)));
      continue;
    }

    const auto cells = split(line);
    if (table.columns.empty()) {
      for (const std::string_view cell : cells) {
        TableColumn column = heading(cell);
        require(!column.name.empty(), where + "a column has no name.");
        require(!table.has(column.name),
                where + "two columns are named '" + column.name + "'.");
        table.columns.push_back(std::move(column));
      }
      continue;
    }
    if (!is_complete && last == LastLine::may_be_cut) {
      table.is_last_line_cut = true;
      continue;
    }
    require(cells.size() == table.columns.size(),
            where + std::to_string(cells.size()) + " values under " +
                std::to_string(table.columns.size()) + " headings.");
    for (std::size_t c = 0; c < cells.size(); ++c) {
      double value = 0.0;
      require(parse(cells[c], value), where + "'" + std::string(cells[c]) + "' under '" +
                                          table.columns[c].name + "' is not a number.");
      table.columns[c].values.push_back(value);
    }
    ++table.n_rows;
    table.lines.push_back(number);
  }
  require(table.n_rows > 0, file.string() + ": holds no record below its headings.");
  return table;
}

double interpolate(const std::vector<double>& x, const std::vector<double>& y, double x0)
{
  double x_before = 0.0, y_before = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t row = 0; row < x.size(); ++row) {
    if (std::isnan(x[row]) || std::isnan(y[row])) continue;
    if (x[row] >= x0) {
      if (std::isnan(y_before) || x[row] == x0) return y[row];
      // x[row] > x0 > x_before: the divisor is positive
      return y_before + (y[row] - y_before) * (x0 - x_before) / (x[row] - x_before);
    }
    x_before = x[row];
    y_before = y[row];
  }
  return y_before;
}

std::vector<double> moving_mean(const std::vector<double>& x, const std::vector<double>& y,
                                double window)
{
  // Depth need not grow from row to row (holds, unloading): sort, then move the window.
  std::vector<std::size_t> order;
  for (std::size_t row = 0; row < x.size(); ++row)
    if (std::isfinite(x[row]) && std::isfinite(y[row])) order.push_back(row);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });

  std::vector<double> sum(order.size() + 1, 0.0);
  for (std::size_t k = 0; k < order.size(); ++k) sum[k + 1] = sum[k] + y[order[k]];

  std::vector<double> mean(x.size(), std::numeric_limits<double>::quiet_NaN());
  std::size_t first = 0, end = 0;
  for (const std::size_t row : order) {
    while (x[order[first]] < x[row] - 0.5 * window) ++first;
    while (end < order.size() && x[order[end]] <= x[row] + 0.5 * window) ++end;
    mean[row] =
        (sum[end] - sum[first]) / static_cast<double>(end - first); // row itself counts
  }
  return mean;
}

} // namespace mergel::dem
