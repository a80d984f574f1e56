#include "apps/laboratory/stages.h"

#include "dem/error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
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

bool is_of(const Stages& stages, double stage)
{
  return stage >= stages.first && (stages.last == 0 || stage <= stages.last);
}

} // namespace

bool is_element_history(const dem::Table& history)
{
  return history.has("stage") && history.has("p") && history.has("q") &&
         history.has("void ratio") && !is_triaxial_history(history);
}

bool is_triaxial_history(const dem::Table& history)
{
  return history.has("cell pressure") && history.has(volume_of_middle);
}

Stages stages_of(const std::string& text)
{
  Stages stages;
  char rest = 0;
  const int n = std::sscanf(text.c_str(), "%d-%d%c", &stages.first, &stages.last, &rest);
  const bool is_one = n == 1 && text.find_first_not_of("0123456789") == std::string::npos;
  const bool is_range = n == 2 && stages.last >= stages.first;
  require(
      (is_one || is_range) && stages.first >= 1,
      "--stage " + text +
          ": must be the number of a stage, from which on to draw, or the first and the "
          "last of several: 2 or 2-3.");
  return stages;
}

dem::Table from_stages(const dem::Table& history, const Stages& stages)
{
  if (stages.is_all()) return history;
  const std::vector<double>& stage = history.column("stage", "-");
  const auto last = std::find(stage.rbegin(), stage.rend(), stages.first);
  const double longest = *std::max_element(stage.begin(), stage.end());
  require(last != stage.rend(), history.file.string() + ": no record of stage " +
                                    std::to_string(stages.first) + "; the last is " +
                                    std::to_string(std::lround(longest)) + ".");
  // During the approach to its stress a stage counts from another start.
  const auto anchor = static_cast<std::size_t>(stage.rend() - last - 1);
  const std::vector<CountedStrain> strains = counted_in(history);
  const auto counts_as_anchor = [&](std::size_t row) {
    return std::all_of(strains.begin(), strains.end(), [&](const CountedStrain& strain) {
      return !strain.of_stage ||
             std::abs(strain.start(row) - strain.start(anchor)) < round_off;
    });
  };
  const auto is_drawn = [&](std::size_t row) {
    return is_of(stages, stage[row]) &&
           (stage[row] > stages.first || counts_as_anchor(row));
  };
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
  for (std::size_t row = 0; row < history.n_rows; ++row) {
    if (!is_drawn(row)) continue;
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
