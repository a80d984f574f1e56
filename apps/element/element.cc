/// mergel element: loads a periodic cell of bonded rock along any path of stress and
/// strain.
#include "apps/element/element_output.h"
#include "apps/element/element_pictures.h"
#include "apps/element/element_plan.h"
#include "apps/element/element_state.h"
#include "apps/run/progress.h"
#include "apps/run/protocol.h"
#include "apps/run/ranks.h"
#include "apps/run/step_report.h"
#include "apps/specimen/start_stress.h"
#include "dem/collective_failure.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

namespace mergel::apps {

namespace {

class ElementJob : public CheckpointedJob {
public:
  const char* name() const override { return "element"; }
  void declare(CaseFile& file) override { apps::declare(file, case_); }
  void complete(CaseFile& file) override { apps::complete(file, case_); }
  const CheckpointKey& checkpoints() const override { return case_.checkpoints; }
  Remarks unusual() const override { return apps::unusual(case_); }
  std::vector<std::filesystem::path> inputs() const override
  {
    return {case_.specimen.sample, case_.specimen.table};
  }
  std::vector<std::string> free_keys() const override;

  void check_restart(const CaseFile& file, const Restart& restart) const override;
  std::string what_is_done(const Restart& restart) const override;

  void begin(const CaseFile& file, RunFolder& folder, MPI_Comm comm) override;
  void resume(Restart& restart, RunFolder& folder, MPI_Comm comm) override;
  void run(const std::function<void()>& after_step) override;
  CheckpointScheduler::Position position() const override
  {
    const dem::ElementState& s = test_->state();
    return {s.n_steps, s.time, "stage " + label().name()};
  }
  void save(dem::State& state) const override;
  void require_files() const override
  {
    on_first_rank([&] { history_->require_in_place(); });
  }
  void summarise(Summary& summary, const Work& work) const override;

private:
  bool is_under_way() const
  {
    return !outcomes_.empty() && outcomes_.back() == dem::Outcome::unstable;
  }
  /// Of the stage that was begun last.
  const StageLabel& label() const { return case_.stage_labels[test_->state().stage]; }
  dem::Outcome load_stage(bool is_under_way, const std::function<void()>& after_step);
  void report_step() const
  {
    const dem::ElementState& s = test_->state();
    std::cout << report(case_.step, s.stable_step, s.dt, s.assembly.particles);
  }
  std::string record(); ///< returns lines for the user; mostly none

  ElementCase case_;
  std::optional<dem::ElementTest> test_;
  std::optional<ElementHistory> history_; ///< on the first rank
  std::optional<ElementPictures> pictures_;
  dem::Vec3 start_ = dem::Vec3::Zero(); ///< stress before the first stage [Pa]
  std::vector<dem::ElementRecord> records_;
  /// Of stages begun; of the one under way unstable.
  std::vector<dem::Outcome> outcomes_;
};

/// Of the stages only later ones may change, see check_restart().
std::vector<std::string> ElementJob::free_keys() const
{
  return {"Loading/stage N",
          "Loading/strain limit",
          "Analysis/secant from",
          "Analysis/secant to",
          "Analysis/yield offset",
          "Analysis/critical states",
          "Analysis/critical state values"};
}

/// Refuse a change of the stages up to the present one.
void ElementJob::check_restart(const CaseFile& file, const Restart& restart) const
{
  const auto change =
      std::find_if(restart.changed.begin(), restart.changed.end(), [](const auto& k) {
        return k.section == "Loading" && k.key.starts_with("stage ");
      });
  if (change == restart.changed.end()) return;
  CaseFile earlier_file;
  ElementCase earlier;
  apps::declare(earlier_file, earlier);
  earlier_file.read_text(restart.checkpoint.label.case_text, restart.file.string());
  earlier.critical_folders.clear(); // those runs may be gone; only the stages are needed
  apps::complete(earlier_file, earlier);
  const auto n = load_outcomes(restart.checkpoint.state, earlier.stages.size()).size();
  if (!may_go_on(earlier.stage_texts, case_.stage_texts, n))
    file.refuse("Loading", change->key,
                "was \"" + change->was + "\", and the checkpoint is in stage " +
                    earlier.stage_labels[n - 1].name() +
                    " of the test: only later stages may change. Restore it, and add a "
                    "stage such as `resume to axial strain = 5 %` to go further; or choose "
                    "an older checkpoint");
}

/// Whether a test that has ended at its strain limit is below the limit of this case.
bool goes_on(const dem::ElementRecord& last, const ElementCase& c)
{
  return last.whole.largest_strain() <= c.strain_limit;
}

std::string ElementJob::what_is_done(const Restart& restart) const
{
  const dem::State& state = restart.checkpoint.state;
  const auto outcomes = load_outcomes(state, case_.stages.size());
  const std::size_t n = outcomes.size();
  const bool is_analysed_anew =
      std::any_of(restart.changed.begin(), restart.changed.end(),
                  [](const auto& k) { return k.section == "Analysis"; });
  using dem::Outcome;
  switch (outcomes.back()) {
  case Outcome::unstable: // under way
  case Outcome::goes_on:
    return "";
  case Outcome::done:
    if (n < case_.stages.size() || is_analysed_anew) return "";
    return "all its stages are done. To load the specimen further, restart with another "
           "stage.";
  case Outcome::strain_limit_reached:
    if (goes_on(load_records(state).back(), case_)) return "";
    break;
  case Outcome::pulled_apart:
  case Outcome::reversed:
    break;
  }
  if (is_analysed_anew) return "";
  return "stage " + case_.stage_labels[n - 1].name() +
         " ended the test: " + dem::sentence_of(outcomes.back()) +
         ". It cannot be loaded further" +
         (outcomes.back() == Outcome::strain_limit_reached
              ? ", but with a larger `Loading/strain limit`."
              : ".");
}

void ElementJob::begin(const CaseFile& file, RunFolder& folder, MPI_Comm comm)
{
  dem::PeriodicSpecimen specimen = obtain_specimen(file, case_);
  const dem::PairMaterials materials = resolved_materials(case_, specimen);
  std::cout << report(case_, specimen, materials) << '\n';
  test_.emplace(case_, std::move(specimen), materials, comm);
  start_ = along_axes(dem::cell_averages(test_->assembly()).stress);
  std::cout << report_on_start(start_, "of the cell",
                               case_.specimen.is_granular() ? borne_without_bonds
                                                            : borne_by_contacts);
  report_step();
  folder.prepare();
  on_first_rank([&] { history_.emplace(folder.path() / "history.csv"); });
  pictures_.emplace(folder.path(), case_, *test_);
}

void ElementJob::resume(Restart& restart, RunFolder& folder, MPI_Comm comm)
{
  dem::State& state = restart.checkpoint.state;
  on_first_rank([&] {
    std::cout << ElementHistory::check(restart.folder / "history.csv", state)
              << ElementPictures::check(restart.folder, state);
  });
  start_ = load_start(state);
  records_ = load_records(state);
  outcomes_ = load_outcomes(state, case_.stages.size());
  if (outcomes_.back() == dem::Outcome::strain_limit_reached &&
      goes_on(records_.back(), case_))
    outcomes_.back() = dem::Outcome::unstable; // under way again
  test_.emplace(case_, load_element(state, case_), comm);
  report_step();
  folder.prepare();
  on_first_rank([&] {
    history_.emplace(folder.path() / "history.csv", restart.folder / "history.csv", state);
  });
  pictures_.emplace(folder.path(), case_, *test_, restart.folder, state);
}

std::string ElementJob::record()
{
  const bool was_raised = test_->state().alarm.is_raised();
  records_.push_back(test_->record());
  on_first_rank([&] { history_->add(records_.back(), label()); });
  const dem::EnergyAlarm& alarm = test_->state().alarm;
  return alarm.is_raised() && !was_raised ? alarm_text(alarm) : "";
}

std::string words(const dem::ElementRecord& r)
{
  std::ostringstream out;
  out.precision(3);
  out << "p " << 1e-6 * r.whole.p() << "  q " << 1e-6 * r.whole.q() << " MPa  axial strain "
      << 100.0 * r.whole.axial_strain() << " %  broken " << r.broken;
  return out.str();
}

/// Run one stage to its end, from its start or, if `is_under_way`, from the present state.
/// Adds its records, the first at its start.
dem::Outcome ElementJob::load_stage(bool is_under_way,
                                    const std::function<void()>& after_step)
{
  std::string alarm;
  if (!is_under_way) alarm = record();
  Progress progress("stage " + label().name() + ", " + label().text);
  progress.say(alarm);
  for (;;) {
    const bool approached = test_->is_approaching();
    test_->step();
    const dem::Outcome outcome = test_->outcome();
    const bool begins = approached && !test_->is_approaching();
    if (outcome != dem::Outcome::goes_on || test_->record_is_due() || begins)
      progress.say(record());
    if (pictures_->update(outcome != dem::Outcome::goes_on)) require_files();
    if (outcome != dem::Outcome::goes_on) {
      progress.done(words(records_.back()));
      return outcome;
    }
    progress.update(test_->progress(), [&] { return words(records_.back()); });
    after_step();
  }
}

void ElementJob::run(const std::function<void()>& after_step)
{
  for (;;) {
    const bool resumes = is_under_way();
    if (!resumes) {
      const std::size_t next = outcomes_.size();
      const bool is_over = !outcomes_.empty() && outcomes_.back() != dem::Outcome::done;
      if (is_over || next == case_.stages.size()) return;
      const dem::ActiveStage before = test_->state().active;
      test_->begin_stage(next);
      const auto first = case_.stage_labels.begin();
      const std::string wrong =
          wrong_direction({first, first + static_cast<std::ptrdiff_t>(next) + 1}, before,
                          test_->state().active);
      if (!wrong.empty()) throw CollectiveFailure(wrong);
      outcomes_.push_back(dem::Outcome::unstable);
    }
    outcomes_.back() = load_stage(resumes, after_step);
  }
}

void ElementJob::save(dem::State& state) const
{
  apps::save(state, test_->state());
  save_start(state, start_);
  apps::save(state, records_);
  apps::save(state, outcomes_);
  pictures_->save(state);
  ElementHistory::save(state, history_ ? &*history_ : nullptr);
}

/// Results of the stages that were begun, and the cost of the run.
ElementSummary summary_of(const ElementCase& c, const dem::ElementState& state,
                          const std::vector<dem::Outcome>& outcomes,
                          const std::vector<dem::ElementRecord>& records, double seconds)
{
  ElementSummary s;
  s.stages = analyse(c.stages, c.stage_labels, c.analysis, outcomes, points_of(records));
  for (const dem::ElementRecord& r : records) {
    s.worst_energy_error = std::max(s.worst_energy_error, std::abs(r.energy_error));
    s.largest_inertial_number = std::max(s.largest_inertial_number, r.inertial_number);
  }
  s.last = records.back();
  s.critical = critical_states(c, s.last);
  s.n_particles = state.assembly.particles.size();
  s.largest_rate = state.largest_rate;
  s.n_steps = state.n_steps;
  s.n_limited = state.servo.n_limited;
  s.dt = state.dt;
  s.stable_step = state.stable_step;
  s.alarm = state.alarm;
  s.particles = &state.assembly.particles;
  s.seconds = seconds;
  return s;
}

void ElementJob::summarise(Summary& summary, const Work& work) const
{
  if (records_.empty()) return;
  on_first_rank([&] { // which alone prints and writes it
    apps::summarise(summary, case_,
                    summary_of(case_, test_->state(), outcomes_, records_, work.seconds));
    add_start(summary, start_);
  });
}

} // namespace

void keys_of_element(const UseKeys& use)
{
  ElementJob job;
  show_keys(job, use);
}

int run_element(const JobOptions& options)
{
  ElementJob job;
  return run_job(job, options);
}

} // namespace mergel::apps
