/// mergel element: loads a periodic cell of bonded rock along any path of stress and
/// strain.
#include "apps/element/element_output.h"
#include "apps/element/element_pictures.h"
#include "apps/element/element_state.h"
#include "apps/run/jobs.h"
#include "apps/run/output_folder.h"
#include "apps/run/progress.h"
#include "apps/run/ranks.h"
#include "apps/run/restart.h"
#include "apps/run/results.h"
#include "apps/run/shared_folder.h"
#include "dem/timer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <optional>

namespace mergel::apps {

namespace {

std::string words(const dem::ElementRecord& r)
{
  std::ostringstream out;
  out.precision(3);
  out << "p " << 1e-6 * r.whole.p() << "  q " << 1e-6 * r.whole.q() << " MPa  axial strain "
      << 100.0 * r.whole.axial_strain() << " %  broken " << r.broken;
  return out.str();
}

/// A running test: its state, its files and its records.
struct Test {
  std::optional<dem::ElementTest> run;
  std::optional<ElementHistory> history; ///< on the first rank
  std::optional<ElementPictures> pictures;
  std::vector<dem::ElementRecord> records;
  std::vector<dem::Outcome> outcomes; ///< of stages begun; of the present one unstable
  double seconds_before = 0.0;        ///< wall-clock time of earlier starts

  void add(const dem::ElementRecord& r)
  {
    records.push_back(r);
    on_first_rank([&] { history->add(r); });
  }
  void require_in_place() const
  {
    on_first_rank([&] { history->require_in_place(); });
  }
};

/// Run one stage to its end, from its start or, if `is_under_way`, from the present state.
/// Adds its records, the first at its start.
/// @param after_step called between two steps, for checkpoints
dem::Outcome follow(Test& test, const std::string& name, bool is_under_way,
                    const std::function<void()>& after_step)
{
  dem::ElementTest& run = *test.run;
  if (!is_under_way) test.add(run.record());
  Progress progress("stage " + std::to_string(run.state().stage + 1) + ", " + name);
  for (;;) {
    const bool approached = run.is_approaching();
    run.step();
    const dem::Outcome outcome = run.outcome();
    const bool begins = approached && !run.is_approaching();
    if (outcome != dem::Outcome::goes_on || run.record_is_due() || begins)
      test.add(run.record());
    if (test.pictures->update(outcome != dem::Outcome::goes_on)) test.require_in_place();
    if (outcome != dem::Outcome::goes_on) {
      progress.done(words(test.records.back()));
      return outcome;
    }
    progress.update(run.progress(), [&] { return words(test.records.back()); });
    after_step();
  }
}

void follow_all(Test& test, const ElementCase& c, bool is_under_way,
                const std::function<void()>& after_step)
{
  for (std::size_t stage = is_under_way ? test.run->state().stage : 0;
       stage < c.stages.size(); ++stage) {
    if (!is_under_way) {
      test.run->begin_stage(stage);
      test.outcomes.push_back(dem::Outcome::unstable);
    }
    test.outcomes.back() = follow(test, name_of(c.stages[stage]), is_under_way, after_step);
    is_under_way = false;
    if (test.outcomes.back() != dem::Outcome::done) return;
  }
}

void save(dem::State& state, const std::vector<dem::Outcome>& outcomes)
{
  std::vector<std::uint64_t> numbers;
  for (const dem::Outcome o : outcomes) numbers.push_back(static_cast<std::uint64_t>(o));
  state.add_common("element_outcomes", std::move(numbers));
}

/// Outcomes of the stages that were begun, which must be stages of the case.
std::vector<dem::Outcome> load_outcomes(const dem::State& state, const ElementCase& c)
{
  std::vector<dem::Outcome> outcomes;
  for (const std::uint64_t n : state.get<std::uint64_t>("element_outcomes")) {
    if (n > static_cast<std::uint64_t>(dem::Outcome::unstable))
      dem::State::refuse("element_outcomes", "holds an unknown outcome");
    outcomes.push_back(static_cast<dem::Outcome>(n));
  }
  if (outcomes.empty() || outcomes.size() > c.stages.size())
    dem::State::refuse("element_outcomes", "counts stages that the case does not have");
  return outcomes;
}

/// Results of the stages that were begun, and the cost of the run.
ElementSummary summary_of(const ElementCase& c, const dem::ElementTest& run,
                          const std::vector<dem::Outcome>& outcomes,
                          const std::vector<dem::ElementRecord>& records, double seconds)
{
  ElementSummary s;
  s.stages = analyse(c, outcomes, records);
  for (const dem::ElementRecord& r : records) {
    s.worst_energy_error = std::max(s.worst_energy_error, std::abs(r.energy_error));
    s.largest_inertial_number = std::max(s.largest_inertial_number, r.inertial_number);
  }
  s.last = records.back();
  s.critical = critical_states(c, s.last);
  const dem::ElementState& state = run.state();
  s.n_particles = state.assembly.particles.size();
  s.largest_rate = state.largest_rate;
  s.n_steps = state.n_steps;
  s.n_limited = state.servo.n_limited;
  s.dt = state.dt;
  s.seconds = seconds;
  return s;
}

} // namespace

void help_element(std::ostream& out)
{
  CaseFile file;
  ElementCase c;
  declare(file, c);
  file.help(out);
}

namespace {

/// Keys that a restart may change. Of the stages only later ones, see check_stages().
std::vector<std::string> free_keys()
{
  std::vector<std::string> keys{"Loading/strain limit",     "Analysis/secant from",
                                "Analysis/secant to",       "Analysis/yield offset",
                                "Analysis/critical states", "Motion/time step safety",
                                "Output/checkpoint every",  "Specimen/file"};
  for (std::size_t k = 0; k < max_stages; ++k) keys.push_back("Loading/" + key_of_stage(k));
  return keys;
}

/// Refuse a change of the stages up to the present one.
void check_stages(const CaseFile& file, const ElementCase& c, const Restart& restart)
{
  const auto stage = std::find_if(restart.changed.begin(), restart.changed.end(),
                                  [](const auto& k) { return k.section == "Loading"; });
  if (stage == restart.changed.end()) return;
  CaseFile earlier_file;
  ElementCase earlier;
  declare(earlier_file, earlier);
  earlier_file.read_text(restart.checkpoint.label.case_text, restart.file.string());
  earlier.critical_text.clear(); // those runs may be gone; only the stages are needed
  complete(earlier_file, earlier);
  const std::size_t n = load_outcomes(restart.checkpoint.state, earlier).size();
  if (c.stages.size() < n ||
      !std::equal(earlier.stages.begin(), earlier.stages.begin() + n, c.stages.begin()))
    file.refuse(
        "Loading", stage->key,
        "was \"" + stage->was + "\", and the checkpoint is in stage " + std::to_string(n) +
            " of the test: only later stages may change. Restore it, or choose an older "
            "checkpoint");
}

void save(dem::State& state, const Test& test)
{
  apps::save(state, test.run->state());
  apps::save(state, test.records);
  save(state, test.outcomes);
  test.pictures->save(state);
  ElementHistory::save(state, test.history ? &*test.history : nullptr);
}

void begin(Test& test, const CaseFile& file, const ElementCase& c, OutputFolder& folder,
           const std::vector<std::filesystem::path>& inputs)
{
  dem::PeriodicSpecimen specimen = obtain_specimen(file, c);
  const dem::PairMaterials materials = resolved_materials(c, specimen);
  std::cout << report(c, specimen, materials) << '\n';
  test.run.emplace(c, std::move(specimen), materials, MPI_COMM_WORLD);
  on_first_rank([&] {
    folder.commit(inputs);
    file.write_resolved(folder.path() / "resolved.prm");
    test.history.emplace(folder.path() / "history.csv");
  });
  require_shared(folder.path());
  test.pictures.emplace(folder.path(), c, *test.run);
}

void go_on(Test& test, const CaseFile& file, const ElementCase& c, OutputFolder& folder,
           const std::vector<std::filesystem::path>& inputs, Restart& restart)
{
  dem::State& state = restart.checkpoint.state;
  test.records = load_records(state);
  test.outcomes = load_outcomes(state, c);
  test.seconds_before = state.get_rows<double>("seconds", 1).front();
  test.run.emplace(c, load_element(state, c), MPI_COMM_WORLD);
  if (has_changed(restart, "Motion", "time step safety")) test.run->lower_time_step();
  on_first_rank([&] {
    prepare_continued_folder(folder, inputs, file, restart);
    test.history.emplace(folder.path() / "history.csv", restart.folder / "history.csv",
                         state);
  });
  require_shared(folder.path());
  test.pictures.emplace(folder.path(), c, *test.run, restart.folder, state);
  restart.file = checkpoint_in(folder.path(), restart);
}

} // namespace

int run_element(const JobOptions& options)
{
  const double start = dem::wall_clock();
  CaseFile file;
  ElementCase c;
  FolderLock lock = hold_restarted(options);
  std::optional<Restart> restart = resume(file, c, options, "element", free_keys());
  if (restart) {
    on_every_rank([&] { check_stages(file, c, *restart); });
    std::cout << report(*restart) << '\n';
  }
  const auto inputs = inputs_of(options, restart, {c.specimen.sample, c.specimen.table});
  OutputFolder folder = folder_of(options, restart, inputs, std::move(lock));
  if (restart)
    on_first_rank([&] {
      const dem::State& state = restart->checkpoint.state;
      std::cout << ElementHistory::check(restart->folder / "history.csv", state)
                << ElementPictures::check(restart->folder, state);
    });

  Test test;
  if (restart)
    go_on(test, file, c, folder, inputs, *restart);
  else
    begin(test, file, c, folder, inputs);
  const auto seconds = [&] { return test.seconds_before + dem::wall_clock() - start; };
  CheckpointScheduler scheduler(
      {.folder = folder.path(),
       .job = "element",
       .case_text = file.resolved_text(),
       .every = c.checkpoints.every,
       .end = start + options.walltime,
       .restarted_from = restart ? restart->file : std::filesystem::path{}});
  bool is_under_way = restart.has_value();
  restart.reset(); // its arrays are no longer needed

  const auto after_step = [&] {
    const dem::ElementState& s = test.run->state();
    const std::string phase = "stage " + std::to_string(s.stage + 1);
    scheduler.after_step(s.assembly.comm, {s.n_steps, s.time, phase.c_str()},
                         [&](dem::State& state) {
                           save(state, test);
                           state.add_common<double>("seconds", {seconds()});
                         });
  };
  const auto close = [&](const char* name, const std::string& failure) {
    on_first_rank([&] {
      if (test.records.empty()) return;
      const ElementSummary s =
          summary_of(c, *test.run, test.outcomes, test.records, seconds());
      write_summary(folder.path() / name, c, s, failure);
      if (failure.empty()) {
        test.history->require_in_place();
        require_results(folder.path(), "element");
      }
      print_summary(folder.path() / name, s);
    });
  };
  try {
    follow_all(test, c, is_under_way, after_step);
    close("summary.json", "");
  } catch (...) {
    scheduler.rethrow_with_remedy(
        [&](const std::string& failure) { close("failed.json", failure); });
  }
  return 0;
}

} // namespace mergel::apps
