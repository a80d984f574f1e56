/// Numbers and counts of a checkpoint, each held by its name.
///
/// A list of numbers is one array of the state, its names are a text beside it, one a line.
/// Numbers are found by their names: their order in the file does not matter, and a number
/// that is missing or unknown is refused by its name.
///
/// One function lists the numbers of a struct, to save a const one and to load another:
///
///     template <class Self>
///     dem::NumbersOf<Self> numbers_of(Self& self)
///     {
///       return {{"time step [s]", &self.dt}, {"time [s]", &self.time}};
///     }
///     dem::save_numbers(state, "run_numbers", numbers_of(self));
///     dem::load_numbers(state, "run_numbers", numbers_of(self));
#pragma once

#include "dem/io/state/state_file.h"

#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace mergel::dem {

/// A number and its name, with its unit: "time step [s]".
/// @tparam Number double, or const double to save only
template <class Number>
struct NamedNumber {
  std::string name;
  Number* value; ///< borrowed
};

/// A count, a flag or a choice, and its name.
/// @tparam Pointer void*, or const void* to save only
template <class Pointer>
class NamedCount {
public:
  /// A count of 64 bits without sign, or a flag (0 or 1).
  template <class T>
  requires std::same_as<std::remove_const_t<T>, std::uint64_t> ||
      std::same_as < std::remove_const_t<T>,
  bool > NamedCount(std::string name_, T* value)
      : NamedCount(std::move(name_), value,
                   std::is_same_v<std::remove_const_t<T>, bool> ? 1 : UINT64_MAX, Tag{})
  {
  }
  /// A choice: an enum with the values 0 to `last`.
  template <class T>
  requires std::is_enum_v<T> NamedCount(std::string name_, T* value,
                                        std::remove_const_t<T> last)
      : NamedCount(std::move(name_), value, static_cast<std::uint64_t>(last), Tag{})
  {
  }

  std::uint64_t value() const { return get_(value_); }
  /// @pre count <= largest
  void set(std::uint64_t count) const requires std::same_as<Pointer, void*>
  {
    set_(value_, count);
  }

  std::string name;
  std::uint64_t largest; ///< allowed value

private:
  struct Tag {};
  template <class T>
  NamedCount(std::string name_, T* value, std::uint64_t largest_, Tag)
      : name(std::move(name_)), largest(largest_), value_(value), get_([](const void* at) {
          return static_cast<std::uint64_t>(*static_cast<const T*>(at));
        })
  {
    if constexpr (!std::is_const_v<T>)
      set_ = [](void* at, std::uint64_t count) {
        *static_cast<T*>(at) = static_cast<T>(count);
      };
  }

  Pointer value_; ///< borrowed
  std::uint64_t (*get_)(const void*);
  void (*set_)(void*, std::uint64_t) = nullptr; ///< null for a const value
};

/// Numbers and counts of a struct that may be const.
template <class Self>
using NumbersOf = std::vector<
    NamedNumber<std::conditional_t<std::is_const_v<Self>, const double, double>>>;
template <class Self>
using CountsOf =
    std::vector<NamedCount<std::conditional_t<std::is_const_v<Self>, const void*, void*>>>;

/// Add the array `array` with the numbers and the text `array`_names; the same on every
/// rank.
/// @throws std::logic_error for a name that occurs twice, is empty or has a line break
void save_numbers(State& state, const std::string& array,
                  const std::vector<NamedNumber<const double>>& numbers);
void save_numbers(State& state, const std::string& array,
                  const std::vector<NamedNumber<double>>& numbers);
void save_counts(State& state, const std::string& array,
                 const std::vector<NamedCount<const void*>>& counts);
void save_counts(State& state, const std::string& array,
                 const std::vector<NamedCount<void*>>& counts);

/// Set the numbers that save_numbers() or save_counts() added.
/// @throws InputError naming the array, and the number that is missing, unknown, twice
///   there, or out of its range; no number is set then
void load_numbers(const State& state, const std::string& array,
                  const std::vector<NamedNumber<double>>& numbers);
void load_counts(const State& state, const std::string& array,
                 const std::vector<NamedCount<void*>>& counts);

} // namespace mergel::dem
