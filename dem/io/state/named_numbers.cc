#include "dem/io/state/named_numbers.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace mergel::dem {

namespace {

const std::string names_of_array = "_names";

/// The names of a list, one a line.
template <class List>
std::string lines_of_names(const std::string& array, const List& list)
{
  std::string lines;
  std::set<std::string> seen;
  for (const auto& entry : list) {
    if (entry.name.empty() || entry.name.find('\n') != std::string::npos)
      throw std::logic_error(array + " has a number without a name of one line");
    if (!seen.insert(entry.name).second)
      throw std::logic_error(array + " has two numbers of the name " + entry.name);
    lines += entry.name + '\n';
  }
  return lines;
}

std::vector<std::string> lines_in(const std::string& text)
{
  std::vector<std::string> lines;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return lines;
}

/// The values of an array in the order of `list`.
template <class T, class List>
std::vector<T> values_by_name(const State& state, const std::string& array,
                              const List& list)
{
  const std::vector<T>& values = state.get<T>(array);
  const std::vector<std::string> names = lines_in(state.text(array + names_of_array));
  if (names.size() != values.size())
    State::refuse(array, "has " + std::to_string(values.size()) + " numbers and " +
                             std::to_string(names.size()) + " names");
  std::map<std::string, T> found;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (!found.emplace(names[k], values[k]).second)
      State::refuse(array, "has the number `" + names[k] + "` twice");
  std::vector<T> in_order;
  for (const auto& entry : list) {
    const auto at = found.find(entry.name);
    if (at == found.end()) State::refuse(array, "has no number `" + entry.name + "`");
    in_order.push_back(at->second);
    found.erase(at);
  }
  if (!found.empty())
    State::refuse(array, "has the number `" + found.begin()->first +
                             "`, which this program does not know");
  return in_order;
}

template <class Number>
void save_numbers_of(State& state, const std::string& array,
                     const std::vector<NamedNumber<Number>>& numbers)
{
  std::vector<double> values;
  for (const auto& n : numbers) values.push_back(*n.value);
  state.add_text(array + names_of_array, lines_of_names(array, numbers));
  state.add_common(array, std::move(values));
}

template <class Pointer>
void save_counts_of(State& state, const std::string& array,
                    const std::vector<NamedCount<Pointer>>& counts)
{
  std::vector<std::uint64_t> values;
  for (const auto& n : counts) values.push_back(n.value());
  state.add_text(array + names_of_array, lines_of_names(array, counts));
  state.add_common(array, std::move(values));
}

} // namespace

void save_numbers(State& state, const std::string& array,
                  const std::vector<NamedNumber<const double>>& numbers)
{
  save_numbers_of(state, array, numbers);
}

void save_numbers(State& state, const std::string& array,
                  const std::vector<NamedNumber<double>>& numbers)
{
  save_numbers_of(state, array, numbers);
}

void save_counts(State& state, const std::string& array,
                 const std::vector<NamedCount<const void*>>& counts)
{
  save_counts_of(state, array, counts);
}

void save_counts(State& state, const std::string& array,
                 const std::vector<NamedCount<void*>>& counts)
{
  save_counts_of(state, array, counts);
}

void load_numbers(const State& state, const std::string& array,
                  const std::vector<NamedNumber<double>>& numbers)
{
  const auto values = values_by_name<double>(state, array, numbers);
  for (std::size_t k = 0; k < values.size(); ++k) *numbers[k].value = values[k];
}

void load_counts(const State& state, const std::string& array,
                 const std::vector<NamedCount<void*>>& counts)
{
  const auto values = values_by_name<std::uint64_t>(state, array, counts);
  for (std::size_t k = 0; k < values.size(); ++k)
    if (values[k] > counts[k].largest)
      State::refuse(array, "has " + std::to_string(values[k]) + " for `" + counts[k].name +
                               "`, at most " + std::to_string(counts[k].largest));
  for (std::size_t k = 0; k < values.size(); ++k) counts[k].set(values[k]);
}

} // namespace mergel::dem
