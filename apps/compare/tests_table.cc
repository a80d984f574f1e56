#include "apps/compare/tests_table.h"

#include "apps/case/words.h"
#include "apps/compare/test_columns.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <utility>

namespace mergel::apps {

namespace {

/// Which group each test belongs to, from 1.
std::vector<std::size_t> group_numbers(const TestSeries& s)
{
  std::vector<std::size_t> numbers(s.tests.size());
  for (std::size_t g = 0; g < s.groups.members.size(); ++g)
    for (const std::size_t k : s.groups.members[g]) numbers[k] = g + 1;
  return numbers;
}

std::string mean_label(const TestSeries& s, const std::vector<std::size_t>& group)
{
  return "mean of " + std::to_string(group.size()) + ", " +
         condition_of(s.tests[group.front()]);
}

using Test = const TestReading&;

std::string padded(const std::string& text, std::size_t width, bool is_left)
{
  const std::string blanks(width > text.size() ? width - text.size() : 0, ' ');
  return is_left ? text + blanks : blanks + text;
}

std::string digits(double value)
{
  if (!std::isfinite(value)) return "-";
  char text[32];
  const double size = std::abs(value);
  std::snprintf(text, sizeof text,
                size >= 100.0 || size == 0.0 ? "%.1f"
                : size >= 1e-3               ? "%.3f"
                                             : "%.1e",
                value);
  return text;
}

/// One row of the terminal.
struct Row {
  std::string label;
  std::vector<std::string> cells;
};

void print_rows(std::ostream& out, const std::vector<Row>& rows)
{
  std::size_t label = 0;
  std::vector<std::size_t> widths(rows.front().cells.size(), 0);
  for (const Row& row : rows) {
    label = std::max(label, row.label.size());
    for (std::size_t c = 0; c < widths.size(); ++c)
      widths[c] = std::max(widths[c], row.cells[c].size());
  }
  for (const Row& row : rows) {
    out << padded(row.label, label, true);
    for (std::size_t c = 0; c < widths.size(); ++c)
      out << "  " << padded(row.cells[c], widths[c], false);
    out << '\n';
  }
}

void print_selection(std::ostream& out, const char* what, const Selection& of,
                     const std::string& line)
{
  if (of.why_not.empty())
    out << what << " of " << of.tests.size() << " tests: " << line << '\n';
  else
    out << "no " << what << ": " << of.why_not << '\n';
  for (const std::string& test : of.left_out) out << "  without " << test << '\n';
}

std::string csv_cell(const std::string& text)
{
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csv_number(double value)
{
  return std::isfinite(value) ? "," + dem::shortest(value) : ",";
}

} // namespace

void print(std::ostream& out, const TestSeries& s)
{
  std::vector<const TestColumn*> shown;
  for (const TestColumn& column : test_columns())
    if (*column.head != '\0' && std::any_of(s.tests.begin(), s.tests.end(), [&](Test t) {
          return std::isfinite(column.of(t));
        }))
      shown.push_back(&column);

  std::vector<Row> rows{{"test", {"kind"}}, {"", {""}}};
  for (const TestColumn* column : shown) {
    rows[0].cells.emplace_back(column->head);
    rows[1].cells.emplace_back(column->shown_unit);
  }
  for (Test test : s.tests) {
    rows.push_back({test.label, {name_of(test.kind)}});
    for (const TestColumn* column : shown)
      rows.back().cells.push_back(digits(column->of(test) / column->shown_size));
  }
  for (const auto& group : s.groups.members) {
    if (group.size() < 2) continue;
    Row mean{mean_label(s, group), {name_of(s.tests[group.front()].kind)}};
    Row error{"  standard error", {""}};
    for (const TestColumn* column : shown) {
      const Mean m = mean_with_error(values_of(*column, s.tests, group));
      mean.cells.push_back(digits(m.mean / column->shown_size));
      error.cells.push_back(digits(m.error / column->shown_size));
    }
    rows.push_back(std::move(mean));
    rows.push_back(std::move(error));
  }
  print_rows(out, rows);
  for (const std::string& note : s.groups.notes) out << note << '\n';
  for (Test test : s.tests)
    if (!test.is_finished)
      out << test.label
          << ": has no summary.json (not finished): moduli and yield are missing\n";

  print_selection(out, "Coulomb line at the peak", s.peak.of,
                  s.peak.line ? in_words(*s.peak.line) : "");
  print_selection(out, "Coulomb line in the critical state", s.critical.of,
                  s.critical.line ? in_words(*s.critical.line) : "");
  if (!s.critical.caution().empty()) out << "  " << s.critical.caution() << '\n';
  const CriticalFit& critical = s.critical_states;
  print_selection(out, "critical state line", critical.of,
                  critical.line
                      ? in_words(*critical.line) + "; " + in_words(*critical.ratio) + "; " +
                            volume_in_words(critical)
                      : "");
}

std::string csv_of(const TestSeries& s)
{
  std::string text = "test,kind,group,realisations";
  for (const TestColumn& column : test_columns())
    text += "," + csv_cell(std::string(column.name) + " [" + column.unit + "]");
  text += '\n';
  const auto group = group_numbers(s);
  for (std::size_t k = 0; k < s.tests.size(); ++k) {
    text += csv_cell(s.tests[k].label) + "," + name_of(s.tests[k].kind) + "," +
            std::to_string(group[k]) + ",1";
    for (const TestColumn& column : test_columns())
      text += csv_number(column.of(s.tests[k]));
    text += '\n';
  }
  for (std::size_t g = 0; g < s.groups.members.size(); ++g) {
    const auto& members = s.groups.members[g];
    if (members.size() < 2) continue;
    for (const bool is_mean : {true, false}) {
      text += std::string(is_mean ? "mean" : "standard error") + "," +
              name_of(s.tests[members.front()].kind) + "," + std::to_string(g + 1) + "," +
              std::to_string(members.size());
      for (const TestColumn& column : test_columns()) {
        const Mean m = mean_with_error(values_of(column, s.tests, members));
        text += csv_number(is_mean ? m.mean : m.error);
      }
      text += '\n';
    }
  }
  return text;
}

} // namespace mergel::apps
