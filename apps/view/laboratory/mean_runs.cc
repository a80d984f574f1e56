#include "apps/view/laboratory/mean_runs.h"

#include "apps/laboratory/test_series.h"
#include "apps/view/laboratory/layout.h"
#include "dem/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mergel::apps {

namespace {

/// The rows in which the axial strain goes on; strains times -1 in extension, so that they
/// ascend.
struct Progress {
  std::vector<std::size_t> rows;
  std::vector<double> strain;
  double direction = 1.0;
};

Progress progress_of(const dem::Table& history)
{
  const auto& strain = history.column("axial strain", "-");
  Progress p;
  p.direction = strain.back() < 0.0 ? -1.0 : 1.0;
  for (std::size_t row = 0; row < strain.size(); ++row) {
    const double value = p.direction * strain[row];
    if (!std::isfinite(value) || (!p.strain.empty() && value <= p.strain.back())) continue;
    p.rows.push_back(row);
    p.strain.push_back(value);
  }
  return p;
}

std::vector<double> picked(const std::vector<double>& values,
                           const std::vector<std::size_t>& rows)
{
  std::vector<double> result;
  for (const std::size_t row : rows) result.push_back(values[row]);
  return result;
}

} // namespace

Run mean_of(const std::vector<Run>& runs, const RunName& name)
{
  std::vector<Progress> progress;
  double from = -1e300, to = 1e300; // that all have
  for (const Run& run : runs) {
    progress.push_back(progress_of(run.history));
    from = std::max(from, progress.back().strain.front());
    to = std::min(to, progress.back().strain.back());
  }
  std::vector<double> grid;
  for (const double strain : progress.front().strain)
    if (strain >= from && strain <= to) grid.push_back(strain);

  Run mean{name, runs.front().history, runs.front().history};
  for (dem::Table* table : {&mean.history, &*mean.error}) {
    table->n_rows = grid.size();
    table->lines.assign(grid.size(), 0);
    for (dem::TableColumn& column : table->columns) column.values.clear();
  }
  for (std::size_t c = 0; c < mean.history.columns.size(); ++c) {
    dem::TableColumn& column = mean.history.columns[c];
    std::vector<std::vector<double>> values;
    for (std::size_t r = 0; r < runs.size(); ++r)
      values.push_back(
          picked(runs[r].history.column(column.name, column.unit), progress[r].rows));
    for (const double strain : grid) {
      std::vector<double> here;
      for (std::size_t r = 0; r < runs.size(); ++r)
        here.push_back(dem::interpolate(progress[r].strain, values[r], strain));
      const Mean m = mean_with_error(here);
      column.values.push_back(m.mean);
      mean.error->columns[c].values.push_back(m.error);
    }
  }
  return mean;
}

std::vector<Run> as_asked(const Options& options, std::vector<Run> runs)
{
  if (!options.is_mean) return runs;
  std::vector<std::string> labels;
  for (const Run& run : runs) labels.push_back(run.name.label);
  const TestSeries series = read_series_of_tests(options.folders, labels);
  const auto names = group_names(series);
  const auto& groups = series.groups.members;
  require(groups.size() < runs.size(),
          "--mean: no two of the runs differ only by seed. Leave it out.");
  std::vector<Run> result;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::vector<Run> of_group;
    for (const std::size_t k : groups[g]) of_group.push_back(runs[k]);
    const RunName name{g, names[g]};
    if (of_group.size() > 1) {
      result.push_back(mean_of(of_group, name));
    } else {
      of_group.front().name = name;
      result.push_back(std::move(of_group.front()));
    }
  }
  return result;
}

} // namespace mergel::apps
