/// history.csv: one flushed line a record, header with names and units.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace mergel::dem {

class History {
public:
  /// @param columns "name [unit]" each
  /// @throws NumericalError when the file cannot be written
  History(std::filesystem::path file, const std::vector<std::string>& columns);

  /// One value per column; shortest text that reads back to the same bits.
  /// @throws NumericalError for a value that is not finite, naming its column, or when
  ///   the disk is full
  void add(const std::vector<double>& values);

private:
  std::filesystem::path file_;
  std::vector<std::string> columns_;
  std::ofstream out_;
};

/// The shortest decimal text that reads back to the same bits.
std::string shortest(double value);

} // namespace mergel::dem
