#include "dem/io/table.h"

#include "dem/error.h"
#include "dem/io/readable.h"
#include "dem/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

namespace mergel::dem {

namespace {

std::string_view trimmed(std::string_view text)
{
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Where a cell in double quotes ends, at its second quote; nothing where the line has no such
/// cell at its beginning.
std::optional<std::size_t> end_of_quoted(std::string_view line)
{
  const std::size_t open = line.find_first_not_of(" \t");
  if (open == std::string_view::npos || line[open] != '"') return {};
  std::size_t close = line.find('"', open + 1);
  while (close != std::string_view::npos && line.substr(close + 1, 1) == "\"")
    close = line.find('"', close + 2); // two of them stand for one in the text
  if (close == std::string_view::npos) return {};
  return close;
}

std::vector<std::string_view> split(std::string_view line, char separator)
{
  std::vector<std::string_view> cells;
  while (true) {
    const auto close = end_of_quoted(line);
    const std::size_t end = line.find(separator, close.value_or(0));
    std::string_view cell = trimmed(line.substr(0, end));
    if (close && cell.size() > 1 && cell.back() == '"')
      cell = trimmed(cell.substr(1, cell.size() - 2));
    cells.push_back(cell);
    if (end == std::string_view::npos) return cells;
    line.remove_prefix(end + 1);
  }
}

std::string name_of(char separator)
{
  return separator == ',' ? "commas" : separator == ';' ? "semicolons" : "tabs";
}

char separator_of(std::string_view headings)
{
  for (const char separator : {';', '\t'})
    if (headings.find(separator) != std::string_view::npos) return separator;
  return ',';
}

/// The separator that a spreadsheet names in a first line "sep=;"; nothing in any other line.
std::optional<char> named_separator(std::string_view line)
{
  if (line.ends_with('\r')) line.remove_suffix(1);
  const bool names_one =
      line.size() == 5 && (line.starts_with("sep=") || line.starts_with("SEP="));
  if (!names_one || std::string_view(",;\t").find(line.back()) == std::string_view::npos)
    return {};
  return line.back();
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
bool parse(std::string cell, char separator, double& value)
{
  if (cell.empty()) {
    value = std::numeric_limits<double>::quiet_NaN();
    return true;
  }
  if (separator != ',' && std::count(cell.begin(), cell.end(), ',') == 1 &&
      cell.find('.') == std::string::npos)
    std::replace(cell.begin(), cell.end(), ',', '.');
  const std::size_t sign = cell.front() == '+' ? 1 : 0;
  const auto [end, error] =
      std::from_chars(cell.data() + sign, cell.data() + cell.size(), value);
  return error == std::errc{} && end == cell.data() + cell.size();
}

/// A text of the user's for a message: other bytes than those of plain text are written out.
std::string shown(std::string_view text)
{
  std::string all;
  for (const char c : text) {
    constexpr char digits[] = "0123456789abcdef";
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f && byte < 0x80)
      all += c;
    else
      all.append("\\x").append({digits[byte / 16], digits[byte % 16]});
  }
  return all;
}

std::string quoted_names(const Table& table)
{
  std::string names;
  for (const TableColumn& c : table.columns)
    names += (names.empty() ? "'" : ", '") +
             shown(c.name + (c.unit.empty() ? "" : " [" + c.unit + "]")) + "'";
  return names;
}

bool is_same_but_for_capitals(std::string_view a, std::string_view b)
{
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; };
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

const char* const separators = "Commas, semicolons or tabs separate columns";

/// The likely cause of a missing column; "" for none.
std::string likely_cause(const Table& table, std::string_view name)
{
  for (const TableColumn& c : table.columns) {
    if (c.unit.empty() && c.name.ends_with(')') && c.name.starts_with(name))
      return " Units stand in square brackets, as in 'u_n [m]'.";
    if (c.name != name && is_same_but_for_capitals(c.name, name)) return " Capitals count.";
  }
  if (table.columns.size() == 1 && table.columns[0].name.find(' ') != std::string::npos)
    return " " + std::string(separators) + ", blanks do not.";
  return "";
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
              "]'; there are " + quoted_names(*this) + "." + likely_cause(*this, name));
  require(found->text.empty(), found->text);
  return found->values;
}

std::vector<double> Table::column_in(std::string_view name, const std::string& unit,
                                     const UnitSize& size) const
{
  const TableColumn* found = find(*this, name);
  if (found == nullptr) return column(name, unit); // throws
  require(found->text.empty(), found->text);
  if (found->unit == unit) return found->values;
  const std::string where = file.string() + ": column '" + std::string(name) + "'";
  require(!found->unit.empty(), where +
                                    " has no unit: write it behind its name, such as '" +
                                    std::string(name) + " [" + unit + "]'.");
  std::vector<double> values = found->values;
  try {
    const double factor = size(found->unit, unit);
    for (double& value : values) value *= factor;
  } catch (const InputError& e) {
    throw InputError(where + ": " + e.what());
  }
  return values;
}

std::vector<std::string> Table::drop_text_columns()
{
  std::vector<std::string> names;
  for (const TableColumn& c : columns) {
    if (c.text.empty()) continue;
    require(c.unit.empty(), c.text);
    names.push_back(c.name);
  }
  std::erase_if(columns, [](const TableColumn& c) { return !c.text.empty(); });
  return names;
}

namespace {

std::string read_text(const std::filesystem::path& file)
{
  require_readable(file);
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
  try {
    return plain_text(text.str());
  } catch (const InputError& e) {
    throw InputError(file.string() + ": " + e.what());
  }
}

} // namespace

Table read_table(const std::filesystem::path& file, LastLine last)
{
  std::istringstream in(read_text(file));
  Table table;
  table.file = file;
  std::string line;
  char separator = ',';
  std::optional<char> named; // by a line "sep=;"
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    const std::string where = file.string() + ":" + std::to_string(number) + ": ";
    const bool is_complete = !in.eof(); // getline stopped at a newline
    if (trimmed(line).empty()) continue;
    if (trimmed(line).front() == '#') {
      table.remarks.emplace_back(trimmed(trimmed(line).substr(1)));
      continue;
    }

    if (table.columns.empty()) {
      if (const auto of_spreadsheet = named_separator(line)) {
        named = of_spreadsheet;
        continue;
      }
      separator = named.value_or(separator_of(line));
    }
    const auto cells = split(line, separator);
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
    const bool is_blank = std::all_of(cells.begin(), cells.end(),
                                      [](std::string_view cell) { return cell.empty(); });
    if (is_blank) continue; // a spreadsheet's empty row
    require(cells.size() == table.columns.size(),
            where + std::to_string(cells.size()) + " values under " +
                std::to_string(table.columns.size()) + " headings, separated by " +
                name_of(separator) + ".");
    for (std::size_t c = 0; c < cells.size(); ++c) {
      double value = 0.0;
      TableColumn& column = table.columns[c];
      if (!parse(std::string(cells[c]), separator, value)) {
        const std::string wrong =
            where + "'" + shown(cells[c]) + "' under '" + shown(column.name) +
            "' is not a number." +
            (cells.size() == 1 && cells[c].find_first_of(" \t") != std::string::npos
                 ? " " + std::string(separators) + ", blanks do not."
                 : std::string());
        require(last == LastLine::whole && cells.size() > 1, wrong);
        if (column.text.empty()) column.text = wrong;
        value = std::numeric_limits<double>::quiet_NaN();
      }
      column.values.push_back(value);
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
