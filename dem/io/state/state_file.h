/// Named arrays on disk (HDF5), written by all ranks at once and read back whole.
///
/// A rank writes its own rows of each array straight to their place in the file: HDF5 lays
/// the file out and describes it, the rows go past it. Its own parallel writes leave the
/// ranks waiting for each other for ever once the disk is full (1.10.8, Open MPI 4.1).
#pragma once

#include "dem/collective_failure.h"
#include "dem/parallel/communicator.h"

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

/// What a file holds; while it is put together, the part of one rank.
class State {
public:
  State() = default;
  /// @param rank that puts its part together
  explicit State(int rank) : is_first_(rank == 0) {}

  /// My rows of an array that the ranks share: it will be theirs in the order of the ranks.
  template <class T>
  void add(const std::string& name, std::vector<T> rows, std::size_t columns = 1)
  {
    arrays_[name] = {std::move(rows), columns};
  }
  /// An array that every rank has alike.
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

  /// The whole of an array.
  /// @throws InputError when it is missing, or of another type or number of columns
  template <class T>
  const std::vector<T>& get(const std::string& name, std::size_t columns = 1) const
  {
    const StateArray& a = find(name);
    const auto* values = std::get_if<std::vector<T>>(&a.values);
    if (!values || a.columns != columns) refuse(name, "is of another kind");
    return *values;
  }
  /// The same, of so many rows.
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
  /// Free the arrays whose names begin so.
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

/// Replace `file` whole (dem/io/atomic_file.h); collective, each rank with arrays of the
/// same names. What the ranks wrote is read back and compared (dem/io/shared_file.h), then
/// sealed by a sum over all bytes (dem/io/seal.h).
/// @throws CollectiveFailure naming the file and the system's reason, or the rank that does
///   not see it, or whose rows are lost; an earlier `file` stands
void write_state(const std::filesystem::path& file, const std::string& kind, int version,
                 const State& mine, const Communicator& comm);

/// @param kind what the file must be, for example "checkpoint"
/// @param sum if not null, becomes the sum that seals the file
/// @throws DamagedFile (dem/io/seal.h), without the file's name in front, when it is
///   truncated, changed, of another kind, or holds what no program of ours writes: an array
///   that HDF5 cannot read, a number that is not finite; InputError when it is missing, may
///   not be read or is of another version
State read_state(const std::filesystem::path& file, const std::string& kind, int version,
                 std::uint64_t* sum = nullptr);

} // namespace mergel::dem
