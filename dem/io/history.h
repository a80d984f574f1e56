/// history.csv: one flushed line per record; the header has names and units.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mergel::dem {

/// Position in a history: number of bytes, and their checksum (fnv_1a() of dem/io/seal.h).
struct HistoryMark {
  std::uint64_t bytes = 0, sum = 0;
};

class History {
public:
  /// @param columns "name [unit]" each
  /// @throws NumericalError with the system's reason when the file cannot be written
  History(std::filesystem::path file, const std::vector<std::string>& columns);

  /// Continue the history `earlier`, which may be `file` itself, from the mark; later lines
  /// are dropped. Where `earlier` is missing the history begins at the mark: with a remark
  /// (#) that says so, and its heading. `file` is replaced atomically.
  /// @throws InputError when `earlier` differs before the mark
  History(std::filesystem::path file, const std::vector<std::string>& columns,
          const std::filesystem::path& earlier, const HistoryMark& mark);
  ~History();
  History(History&& other) noexcept;
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  /// One value per column; shortest text that reads back to the same bits.
  /// @throws NumericalError for a value that is not finite, naming its column, when the
  ///   disk is full, or as require_in_place()
  void add(const std::vector<double>& values);

  /// Flush all lines to the disk and return the position.
  /// @throws NumericalError as require_in_place()
  HistoryMark mark() const;

  /// Compare the file of this name with the one that is written: device, inode and size.
  /// @throws NumericalError when it was removed, replaced or changed meanwhile
  void require_in_place() const;

private:
  void open(int flags);
  void begin(const std::string& remark);
  void write(const std::string& line);

  std::filesystem::path file_;
  std::vector<std::string> columns_;
  int number_ = -1; ///< of the open file
  HistoryMark mark_;
};

/// False when the file is missing.
/// @throws InputError, naming the file, when it differs before the mark
bool check_history(const std::filesystem::path& file, const HistoryMark& mark);

} // namespace mergel::dem
