/// Tables of a checkpoint: a row of numbers for each record, with a name for each column.
///
/// The columns are those that numbers_of() or counts_of() of a record lists
/// (dem/io/state/named_numbers.h). Their names are a text beside the array, one a line;
/// columns are found by these names.
#pragma once

#include "dem/io/state/named_numbers.h"

namespace mergel::dem {

/// Add the text `array`_names. @throws std::logic_error as save_numbers()
void save_columns(State& state, const std::string& array,
                  const std::vector<std::string>& names);

/// Place of each of `names` in the rows of `array`.
/// @throws InputError naming a column that is missing, unknown, or twice there
std::vector<std::size_t> find_columns(const State& state, const std::string& array,
                                      const std::vector<std::string>& names);

template <class List>
std::vector<std::string> names_of(const List& list)
{
  std::vector<std::string> names;
  for (const auto& entry : list) names.push_back(entry.name);
  return names;
}

/// Add a row of numbers for each record; the same on every rank.
/// @param numbers_of the NumbersOf of a record
template <class Record, class NumbersOfRecord>
void save_number_rows(State& state, const std::string& array,
                      const std::vector<Record>& records, NumbersOfRecord&& numbers_of)
{
  const Record any{};
  const std::vector<std::string> names = names_of(numbers_of(any));
  std::vector<double> values;
  for (const Record& record : records)
    for (const auto& number : numbers_of(record)) values.push_back(*number.value);
  save_columns(state, array, names);
  state.add_common(array, std::move(values), names.size());
}

/// Set the numbers of `records`, which has as many as there are rows.
/// @throws InputError as find_columns(), and for another number of rows
template <class Record, class NumbersOfRecord>
void load_number_rows(const State& state, const std::string& array,
                      std::vector<Record>& records, NumbersOfRecord&& numbers_of)
{
  Record any{};
  const auto columns = find_columns(state, array, names_of(numbers_of(any)));
  const auto& values = state.get_rows<double>(array, records.size(), columns.size());
  for (std::size_t row = 0; row < records.size(); ++row) {
    const auto numbers = numbers_of(records[row]);
    for (std::size_t k = 0; k < columns.size(); ++k)
      *numbers[k].value = values[row * columns.size() + columns[k]];
  }
}

/// The same for counts, flags and choices.
template <class Record, class CountsOfRecord>
void save_count_rows(State& state, const std::string& array,
                     const std::vector<Record>& records, CountsOfRecord&& counts_of)
{
  const Record any{};
  const std::vector<std::string> names = names_of(counts_of(any));
  std::vector<std::uint64_t> values;
  for (const Record& record : records)
    for (const auto& count : counts_of(record)) values.push_back(count.value());
  save_columns(state, array, names);
  state.add_common(array, std::move(values), names.size());
}

/// The records of save_count_rows(), with nothing but their counts.
/// @throws InputError as find_columns(), and for a count beyond its largest value
template <class Record, class CountsOfRecord>
std::vector<Record> load_count_rows(const State& state, const std::string& array,
                                    CountsOfRecord&& counts_of)
{
  Record any{};
  const auto columns = find_columns(state, array, names_of(counts_of(any)));
  const auto& values = state.get<std::uint64_t>(array, columns.size());
  std::vector<Record> records(values.size() / columns.size());
  for (std::size_t row = 0; row < records.size(); ++row) {
    const auto counts = counts_of(records[row]);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::uint64_t value = values[row * columns.size() + columns[k]];
      if (value > counts[k].largest)
        State::refuse(array, "has " + std::to_string(value) + " for `" + counts[k].name +
                                 "`, at most " + std::to_string(counts[k].largest));
      counts[k].set(value);
    }
  }
  return records;
}

} // namespace mergel::dem
