/// A table of numbers in a text file, such as the history.csv of a run. Columns are found
/// by name.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace mergel::dem {

/// One column; its heading in the file is "name [unit]".
struct TableColumn {
  std::string name; ///< as written, without the unit
  std::string unit; ///< "-" for a pure number, empty if the heading gives none
  /// One per record; NaN where the run had no value ("nan" or empty), or text stands.
  std::vector<double> values;
  /// The place of its first text and what is wrong with it; empty: it has numbers only.
  std::string text{};
};

/// Size of a unit in another of the same dimension: 0.001 for "um" in "mm".
/// @throws InputError when there is no such
using UnitSize = std::function<double(const std::string& unit, const std::string& in)>;

/// Every column has n_rows values.
struct Table {
  std::filesystem::path file;
  std::vector<TableColumn> columns; ///< in the order of the file
  std::size_t n_rows = 0;
  std::vector<std::size_t> lines;   ///< line number in the file, one per row
  std::vector<std::string> remarks; ///< the lines that begin with #, without the #
  /// The last line is incomplete, because the run was writing or was killed; it is left
  /// out.
  bool is_last_line_cut = false;

  bool has(std::string_view name) const;

  /// The column of this name, which must carry this unit.
  /// @throws InputError naming the file, the missing name and unit, and the columns that
  ///   exist; or the text that stands there
  const std::vector<double>& column(std::string_view name, std::string_view unit) const;

  /// The values of a column in this unit, whatever unit its heading carries.
  /// @throws InputError as above, and when the heading has no unit or one of another dimension
  std::vector<double> column_in(std::string_view name, const std::string& unit,
                                const UnitSize& size) const;

  /// Take out the columns of text without a unit, such as remarks on the records.
  /// @return their names
  /// @throws InputError for text under a heading with a unit
  std::vector<std::string> drop_text_columns();
};

/// Whether a last line without a newline counts.
enum class LastLine {
  whole,     ///< yes: the file was written by hand
  may_be_cut ///< no: a run may be writing it, and "1.2" may be the beginning of "1.25"
};

/// Read a table. Lines that begin with # are remarks. Commas, semicolons or tabs separate the
/// columns: what a first line "sep=;" names, else what the line of headings has of them,
/// semicolons first, then tabs. Where it is not commas, a number may have a decimal comma. A line
/// of separators only is left out, as an empty one is. A cell may stand in double quotes. In a
/// file that was written by hand a column may hold text, while nothing asks for its numbers.
/// @throws InputError naming file and line: file not readable, no record, a line with too
///   few or too many values, a value that is no number, two columns with one name
Table read_table(const std::filesystem::path& file, LastLine last = LastLine::may_be_cut);

/// The value of column `y` at `x0` of the ascending column `x`, linear between records and
/// constant beyond the ends; NaN if the table has no row with both.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double x0);

/// For each row, the mean of `y` over the rows whose `x` differs by half a `window` at
/// most. Rows where either is NaN are left out and stay NaN.
std::vector<double> moving_mean(const std::vector<double>& x, const std::vector<double>& y,
                                double window);

} // namespace mergel::dem
