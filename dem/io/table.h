/// A table of numbers in a text file, such as the history.csv of a run: columns found by
/// name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mergel::dem {

/// One column; its heading in the file is "name [unit]".
struct TableColumn {
  std::string name; ///< as written, without the unit
  std::string unit; ///< "-" for a pure number, empty if the heading gives none
  std::vector<double>
      values; ///< one per record; NaN where the run had no value ("nan" or empty)
};

/// Every column has n_rows values.
struct Table {
  std::filesystem::path file;
  std::vector<TableColumn> columns; ///< in the order of the file
  std::size_t n_rows = 0;
  std::vector<std::size_t> lines;   ///< of the file, one per row
  std::vector<std::string> remarks; ///< the lines that begin with #, without it
  bool is_last_line_cut =
      false; ///< the run was writing, or was killed: that line is left out

  bool has(std::string_view name) const;

  /// The column of this name, which must carry this unit.
  /// @throws InputError naming the file, the name or unit found missing, and the names
  ///   there are
  const std::vector<double>& column(std::string_view name, std::string_view unit) const;
};

/// Whether a last line without its end counts.
enum class LastLine {
  whole,     ///< yes: a person wrote the file
  may_be_cut ///< no: a run may be writing it, and "1.2" be the beginning of "1.25"
};

/// Read a table. Any column may be missing and more may follow: ask by name. Lines that
/// begin with # are remarks.
/// @throws InputError naming file and line: unreadable, no record, a line with too few or
///   too many values, a value that is no number, two columns of one name
Table read_table(const std::filesystem::path& file, LastLine last = LastLine::may_be_cut);

/// The value of column `y` at `x0` of the ascending column `x`, linear between records and
/// constant beyond the ends; NaN if the table has no row with both.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double x0);

/// The mean of `y` over the rows whose `x` lies within half a `window` of each row's; rows
/// where either is NaN count nowhere and stay NaN.
std::vector<double> moving_mean(const std::vector<double>& x, const std::vector<double>& y,
                                double window);

} // namespace mergel::dem
