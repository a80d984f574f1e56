/// Named arrays on disk (HDF5), written by all ranks at the same time and read completely
/// by each.
///
/// HDF5 creates the file and allocates the arrays; then each rank writes its rows directly
/// to their offset in the file, without HDF5. Parallel writes of HDF5 1.10.8 with Open MPI
/// 4.1 hang when the disk is full.
#pragma once

#include "dem/collective_failure.h"
#include "dem/parallel/communicator.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace mergel::dem {

/// Rows of `columns` numbers, or a text.
struct StateArray {
  using Values = std::variant<std::vector<double>, std::vector<std::uint64_t>,
                              std::vector<std::uint32_t>, std::vector<std::int32_t>,
                              std::vector<std::int16_t>, std::vector<char>>;
  Values values;
  std::size_t columns = 1;

  std::size_t rows() const
  {
    return std::visit([](const auto& v) { return v.size(); }, values) / columns;
  }
};

/// All arrays of a file; before it is written, the part of one rank.
class State {
public:
  State() = default;
  /// @param rank whose part it is
  explicit State(int rank) : is_first_(rank == 0) {}

  /// Rows of this rank; the array in the file has the rows of all ranks, in rank order.
  template <class T>
  void add(const std::string& name, std::vector<T> rows, std::size_t columns = 1)
  {
    arrays_[name] = {std::move(rows), columns};
  }
  /// An array that is the same on every rank.
  template <class T>
  void add_common(const std::string& name, std::vector<T> rows, std::size_t columns = 1)
  {
    if (!is_first_) rows.clear();
    add(name, std::move(rows), columns);
  }
  void add_text(const std::string& name, const std::string& text)
  {
    add_common(name, std::vector<char>(text.begin(), text.end()));
  }

  /// A complete array.
  /// @throws InputError when it is missing, or has another type or number of columns
  template <class T>
  const std::vector<T>& get(const std::string& name, std::size_t columns = 1) const
  {
    const StateArray& a = find(name);
    const auto* values = std::get_if<std::vector<T>>(&a.values);
    if (!values || a.columns != columns) refuse(name, "has another type or width");
    return *values;
  }
  /// The same, with this number of rows.
  template <class T>
  const std::vector<T>& get_rows(const std::string& name, std::size_t rows,
                                 std::size_t columns = 1) const
  {
    const auto& values = get<T>(name, columns);
    if (values.size() != rows * columns)
      refuse(name, "has " + std::to_string(values.size() / columns) + " rows, not " +
                       std::to_string(rows));
    return values;
  }
  std::string text(const std::string& name) const
  {
    const auto& chars = get<char>(name);
    return {chars.begin(), chars.end()};
  }
  bool has(const std::string& name) const { return arrays_.contains(name); }
  /// Free the arrays whose names begin with `beginning`.
  void forget(const std::string& beginning)
  {
    std::erase_if(arrays_, [&](const auto& a) { return a.first.starts_with(beginning); });
  }
  [[noreturn]] static void refuse(const std::string& name, const std::string& why);

  const std::map<std::string, StateArray>& arrays() const { return arrays_; }

private:
  const StateArray& find(const std::string& name) const;

  bool is_first_ = true;
  std::map<std::string, StateArray> arrays_;
};

/// Replace `file` atomically (dem/io/atomic_file.h). Collective; each rank has arrays with
/// the same names. What the ranks wrote is read back and compared (dem/io/shared_file.h),
/// then sealed with a checksum of its data (dem/io/seal.h).
/// @throws CollectiveFailure naming the file and the system's reason, or the rank that does
///   not see the file or whose rows are lost; an earlier `file` is unchanged
void write_state(const std::filesystem::path& file, const std::string& kind, int version,
                 const State& mine, const Communicator& comm);

/// A whole file of another version of the format: another version of mergel reads it.
struct OtherVersion : InputError {
  using InputError::InputError;
};

/// @param kind what the file must be, for example "checkpoint"
/// @param sum if not null, becomes the checksum of the file
/// @throws DamagedFile (dem/io/seal.h), without the file's name in front, when it is
///   truncated, changed, or holds an array that HDF5 cannot read or a number that is not
///   finite; OtherVersion; InputError when it is missing, may not be read, or has another
///   format
State read_state(const std::filesystem::path& file, const std::string& kind, int version,
                 std::uint64_t* sum = nullptr);

} // namespace mergel::dem
