/// mergel element: lead a periodic cell of rock along any path of stress and strain.
#include "apps/element/element_output.h"
#include "apps/element/element_pictures.h"
#include "apps/element/element_state.h"
#include "apps/run/jobs.h"
#include "apps/run/output_folder.h"
#include "apps/run/progress.h"
#include "apps/run/ranks.h"
#include "apps/run/restart.h"
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

/// A test under way: the rock, what it left on the disk and what is known of it.
struct Test {
  std::optional<dem::ElementTest> run;
  std::optional<ElementHistory> history; ///< on the first rank
  std::optional<ElementPictures> pictures;
  std::vector<dem::ElementRecord> records;
  std::vector<dem::Outcome> outcomes; ///< of the leg under way: broke_off
  double seconds_before = 0.0;        ///< that earlier runs took

  void add(const dem::ElementRecord& r)
  {
    records.push_back(r);
    on_first_rank([&] { history->add(r); });
  }
};

/// Follow one leg to its end, from its start or the middle, and append its records, the state
/// at its start first.
/// @param after_step called between two steps, for checkpoints
dem::Outcome follow(Test& test, const std::string& name, bool is_under_way,
                    const std::function<void()>& after_step)
{
  dem::ElementTest& run = *test.run;
  if (!is_under_way) test.add(run.record());
  Progress progress("leg " + std::to_string(run.state().leg + 1) + ", " + name);
  for (;;) {
    const bool approached = run.is_approaching();
    run.step();
    const dem::Outcome outcome = run.outcome();
    const bool begins = approached && !run.is_approaching();
    if (outcome != dem::Outcome::goes_on || run.record_is_due() || begins)
      test.add(run.record());
    test.pictures->look(outcome != dem::Outcome::goes_on);
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
  for (std::size_t leg = is_under_way ? test.run->state().leg : 0; leg < c.legs.size();
       ++leg) {
    if (!is_under_way) {
      test.run->set_out(leg);
      test.outcomes.push_back(dem::Outcome::broke_off);
    }
    test.outcomes.back() = follow(test, name_of(c.legs[leg]), is_under_way, after_step);
    is_under_way = false;
    if (test.outcomes.back() != dem::Outcome::done) return;
  }
}

void put(dem::State& state, const std::vector<dem::Outcome>& outcomes)
{
  std::vector<std::uint64_t> numbers;
  for (const dem::Outcome o : outcomes) numbers.push_back(static_cast<std::uint64_t>(o));
  state.add_common("element_outcomes", std::move(numbers));
}

/// Of the legs that were begun, all of the case.
std::vector<dem::Outcome> take_outcomes(const dem::State& state, const ElementCase& c)
{
  std::vector<dem::Outcome> outcomes;
  for (const std::uint64_t n : state.get<std::uint64_t>("element_outcomes")) {
    if (n > static_cast<std::uint64_t>(dem::Outcome::broke_off))
      dem::State::refuse("element_outcomes", "names what there is not");
    outcomes.push_back(static_cast<dem::Outcome>(n));
  }
  if (outcomes.empty() || outcomes.size() > c.legs.size())
    dem::State::refuse("element_outcomes", "counts legs that there are not");
  return outcomes;
}

/// What was found in the legs that were begun, and what it took.
ElementSummary summary_of(const ElementCase& c, const dem::ElementTest& run,
                          const std::vector<dem::Outcome>& outcomes,
                          const std::vector<dem::ElementRecord>& records, double seconds)
{
  ElementSummary s;
  s.legs = analyse(c, outcomes, records);
  for (const dem::ElementRecord& r : records) {
    s.worst_energy_error = std::max(s.worst_energy_error, std::abs(r.energy_error));
    s.greatest_inertial_number = std::max(s.greatest_inertial_number, r.inertial_number);
  }
  s.last = records.back();
  s.critical = critical_states(c, s.last);
  const dem::ElementState& state = run.state();
  s.n_particles = state.rock.particles.size();
  s.greatest_rate = state.greatest_rate;
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

/// Keys that a restart may change; of the legs those to come.
std::vector<std::string> free_keys()
{
  std::vector<std::string> keys{"Loading/strain limit",     "Analysis/secant from",
                                "Analysis/secant to",       "Analysis/yield offset",
                                "Analysis/critical states", "Motion/time step safety",
                                "Output/checkpoint every",  "Specimen/file"};
  for (std::size_t k = 0; k < most_legs; ++k) keys.push_back("Loading/" + key_of_leg(k));
  return keys;
}

/// Refuse other legs up to the one that is under way.
void check_legs(const CaseFile& file, const ElementCase& c, const Restart& restart)
{
  const auto leg = std::find_if(restart.changed.begin(), restart.changed.end(),
                                [](const auto& k) { return k.section == "Loading"; });
  if (leg == restart.changed.end()) return;
  CaseFile earlier_file;
  ElementCase earlier;
  declare(earlier_file, earlier);
  earlier_file.read_text(restart.checkpoint.label.case_text, restart.file.string());
  earlier.critical_text.clear(); // those runs may be gone; the legs are asked for
  complete(earlier_file, earlier);
  const std::size_t n = take_outcomes(restart.checkpoint.state, earlier).size();
  if (c.legs.size() < n ||
      !std::equal(earlier.legs.begin(), earlier.legs.begin() + n, c.legs.begin()))
    file.refuse(
        "Loading", leg->key,
        "was \"" + leg->was + "\", and the checkpoint stands in leg " + std::to_string(n) +
            " of the test: only legs behind that may change. Restore it, or take an "
            "older checkpoint");
}

void put(dem::State& state, const Test& test)
{
  apps::put(state, test.run->state());
  apps::put(state, test.records);
  put(state, test.outcomes);
  test.pictures->put(state);
  ElementHistory::put(state, test.history ? &*test.history : nullptr);
}

void begin(Test& test, const CaseFile& file, const ElementCase& c, OutputFolder& folder,
           const std::vector<std::filesystem::path>& inputs)
{
  dem::PeriodicSpecimen rock = obtain_rock(file, c);
  const dem::PairMaterials materials = resolved_materials(c, rock);
  std::cout << report(c, rock, materials) << '\n';
  test.run.emplace(c, std::move(rock), materials, MPI_COMM_WORLD);
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
  test.records = take_records(state);
  test.outcomes = take_outcomes(state, c);
  test.seconds_before = state.get_rows<double>("seconds", 1).front();
  test.run.emplace(c, take_element(state, c), MPI_COMM_WORLD);
  if (has_changed(restart, "Motion", "time step safety")) test.run->lower_time_step();
  on_first_rank([&] {
    go_on_in(folder, inputs, file, restart);
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
  std::optional<Restart> restart = take_up(file, c, options, "element", free_keys());
  if (restart) {
    on_every_rank([&] { check_legs(file, c, *restart); });
    std::cout << report(*restart) << '\n';
  }
  const auto inputs = inputs_of(options, restart, {c.specimen.sample, c.specimen.table});
  OutputFolder folder = folder_of(options, restart, inputs, std::move(lock));
  if (restart)
    on_first_rank([&] {
      ElementHistory::check(restart->folder / "history.csv", restart->checkpoint.state);
      ElementPictures::check(restart->folder, restart->checkpoint.state);
    });

  Test test;
  if (restart)
    go_on(test, file, c, folder, inputs, *restart);
  else
    begin(test, file, c, folder, inputs);
  const auto seconds = [&] { return test.seconds_before + dem::wall_clock() - start; };
  Keeper keeper({.folder = folder.path(),
                 .job = "element",
                 .case_text = file.resolved_text(),
                 .every = c.checkpoints.every,
                 .end = start + options.walltime,
                 .restarted_from = restart ? restart->file : std::filesystem::path{}});
  bool is_under_way = restart.has_value();
  restart.reset(); // its arrays are no longer needed

  const auto after_step = [&] {
    const dem::ElementState& s = test.run->state();
    const std::string stage = "leg " + std::to_string(s.leg + 1);
    keeper.after_step(s.rock.comm, {s.n_steps, s.time, stage.c_str()},
                      [&](dem::State& state) {
                        put(state, test);
                        state.add_common<double>("seconds", {seconds()});
                      });
  };
  const auto close = [&](const char* name, const std::string& failure) {
    on_first_rank([&] {
      if (test.records.empty()) return;
      const ElementSummary s =
          summary_of(c, *test.run, test.outcomes, test.records, seconds());
      write_summary(folder.path() / name, c, s, failure);
      print_summary(folder.path() / name, s);
    });
  };
  try {
    follow_all(test, c, is_under_way, after_step);
  } catch (...) {
    keeper.rethrow_with_remedy(
        [&](const std::string& failure) { close("failed.json", failure); });
  }
  close("summary.json", "");
  return 0;
}

} // namespace mergel::apps
