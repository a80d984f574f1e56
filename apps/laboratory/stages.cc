#include "apps/laboratory/stages.h"

#include "dem/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace mergel::apps {

namespace {

/// Relative difference below which two numbers of a history are the same [-].
constexpr double round_off = 1e-9;

/// Ratio of the edge (or volume) from which the strain of the stage counts to that from
/// which the strain of the whole test counts: 1 - whole = start (1 - of the stage).
double start(double whole, double of_stage)
{
  return (1.0 - whole) / (1.0 - of_stage); // > 0: at a strain of 1 there is no cell
}

/// A strain of the whole test.
struct CountedStrain {
  std::size_t column;
  const std::vector<double>* whole;
  const std::vector<double>* of_stage; ///< null where the history has none for each stage

  double start(std::size_t row) const
  {
    return apps::start((*whole)[row], (*of_stage)[row]);
  }
};

/// Those of a history, the axial strain first.
/// @throws InputError when that, or its strain of the stage, is missing
std::vector<CountedStrain> counted_in(const dem::Table& history)
{
  history.column("axial strain", "-");
  history.column("axial strain of the stage", "-");
  std::vector<CountedStrain> strains;
  for (const std::string name : counted_strains) {
    const std::string of_stage = name + " of the stage";
    for (std::size_t c = 0; c < history.columns.size(); ++c)
      if (history.columns[c].name == name)
        strains.push_back(
            {c, &history.column(name, "-"),
             history.has(of_stage) ? &history.column(of_stage, "-") : nullptr});
  }
  return strains;
}

std::vector<double> values_or_zero(const dem::Table& history, const std::string& name)
{
  return history.has(name) ? history.column(name, "-")
                           : std::vector<double>(history.n_rows, 0.0);
}

/// Numbers of stage, part and cycle at each record.
struct StageColumns {
  const std::vector<double>& stage;
  std::vector<double> part, cycle;

  explicit StageColumns(const dem::Table& history)
      : stage(history.column("stage", "-")), part(parts_of(history)),
        cycle(values_or_zero(history, "cycle"))
  {
  }
  /// @param which, in part and cycle; 0: any
  bool is(std::size_t row, int number, int which, int in) const
  {
    return stage[row] == number && (which == 0 || part[row] == which) &&
           (in == 0 || cycle[row] == in);
  }
  bool has(int number, int which, int in) const
  {
    for (std::size_t row = 0; row < stage.size(); ++row)
      if (is(row, number, which, in)) return true;
    return false;
  }
  /// Rows from the first record of the first stage to the last record of the last one: the parts of
  /// a repeated unload-reload alternate. @pre both are there
  std::pair<std::size_t, std::size_t> rows_of(const Stages& s) const
  {
    std::size_t first = 0, last = stage.size() - 1;
    while (!is(first, s.first, s.first_part, s.first_cycle)) ++first;
    if (s.last == 0) return {first, last};
    while (last > first &&
           !(stage[last] < s.last || is(last, s.last, s.last_part, s.last_cycle)))
      --last;
    return {first, last};
  }
};

/// Take a number from 1 on off the start of the text. @return whether it is there
bool take_number(std::string_view& text, int& number)
{
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || number < 1) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

/// Take "3", "3a" or "3a of cycle 2" off the start of the text. @return whether it is there
bool take_stage(std::string_view& text, int& number, int& part, int& cycle)
{
  constexpr std::string_view of_cycle = " of cycle ";
  if (!take_number(text, number)) return false;
  part = text.starts_with('a') ? 1 : text.starts_with('b') ? 2 : 0;
  if (part > 0) text.remove_prefix(1);
  if (!text.starts_with(of_cycle)) return true;
  text.remove_prefix(of_cycle.size());
  return take_number(text, cycle);
}

/// Whether the last stage is not before the first.
bool is_in_order(const Stages& s)
{
  if (s.last != s.first) return s.last > s.first;
  const int first_cycle = std::max(s.first_cycle, 1);
  if (s.last_cycle > 0 && s.last_cycle != first_cycle) return s.last_cycle > first_cycle;
  return s.last_part == 0 || s.last_part >= s.first_part;
}

} // namespace

std::vector<double> parts_of(const dem::Table& history)
{
  return values_or_zero(history, "part");
}

bool is_element_history(const dem::Table& history)
{
  return history.has("stage") && history.has("p") && history.has("q") &&
         history.has("void ratio") && !is_triaxial_history(history);
}

bool is_triaxial_history(const dem::Table& history)
{
  return history.has("cell pressure") && history.has(volume_of_middle);
}

std::string name_of_stage(int number, int part, int cycle)
{
  const std::string letter = part == 1 ? "a" : part == 2 ? "b" : "";
  return std::to_string(number) + letter +
         (cycle > 0 ? " of cycle " + std::to_string(cycle) : "");
}

Stages stages_of(const std::string& text)
{
  Stages s;
  std::string_view rest = text;
  bool is_read = take_stage(rest, s.first, s.first_part, s.first_cycle);
  if (is_read && rest.starts_with('-')) {
    rest.remove_prefix(1);
    is_read = take_stage(rest, s.last, s.last_part, s.last_cycle) && is_in_order(s);
  }
  require(
      is_read && rest.empty(),
      "--stage " + text +
          ": must be the number of a stage, from which on to draw, or the first and the "
          "last of several: 2 or 2-3; 3a and 3b are the unloading and the reloading of "
          "stage 3, 3b of cycle 2 is that of its second cycle.");
  return s;
}

dem::Table from_stages(const dem::Table& history, const Stages& stages)
{
  if (stages.is_all()) return history;
  const StageColumns columns(history);
  const std::vector<double>& stage = columns.stage;
  const double longest = *std::max_element(stage.begin(), stage.end());
  const auto require_stage = [&](int number, int part, int cycle) {
    require(columns.has(number, part, cycle),
            history.file.string() + ": no record of stage " +
                name_of_stage(number, part, cycle) +
                (columns.has(number, 0, 0)
                     ? ", but of stage " + std::to_string(number) +
                           ": a, b and cycles are the parts of an unload-reload."
                     : "; the last is " + std::to_string(std::lround(longest)) + "."));
  };
  require_stage(stages.first, stages.first_part, stages.first_cycle);
  if (stages.last_part > 0 || stages.last_cycle > 0)
    require_stage(stages.last, stages.last_part, stages.last_cycle);
  // During the approach to its stress a stage counts from another start.
  std::size_t anchor = stage.size() - 1;
  while (!columns.is(anchor, stages.first, stages.first_part, stages.first_cycle)) --anchor;
  const std::vector<CountedStrain> strains = counted_in(history);
  const auto counts_as_anchor = [&](std::size_t row) {
    return std::all_of(strains.begin(), strains.end(), [&](const CountedStrain& strain) {
      return !strain.of_stage ||
             std::abs(strain.start(row) - strain.start(anchor)) < round_off;
    });
  };
  const auto [first_row, last_row] = columns.rows_of(stages);
  // A strain without one of its own for each stage counts from the record at which the axial
  // strain of the stage began.
  std::size_t begin = 0;
  while (begin < anchor && !(counts_as_anchor(begin) &&
                             std::abs((*strains.front().of_stage)[begin]) < round_off))
    ++begin;

  dem::Table result = history;
  result.n_rows = 0;
  result.lines.clear();
  for (dem::TableColumn& column : result.columns) column.values.clear();
  for (std::size_t row = first_row; row <= last_row; ++row) {
    if (stage[row] == stages.first && !counts_as_anchor(row)) continue;
    ++result.n_rows;
    result.lines.push_back(history.lines[row]);
    for (std::size_t c = 0; c < history.columns.size(); ++c)
      result.columns[c].values.push_back(history.columns[c].values[row]);
    for (const CountedStrain& strain : strains) {
      const double from =
          strain.of_stage ? strain.start(anchor) : 1.0 - (*strain.whole)[begin];
      double& value = result.columns[strain.column].values.back();
      value = 1.0 - (1.0 - value) / from; // > 0, as both cells are
    }
  }
  return result;
}

} // namespace mergel::apps
