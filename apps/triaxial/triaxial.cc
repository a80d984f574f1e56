/// mergel triaxial: loads a cylinder of bonded rock between two platens, in a membrane under
/// a cell pressure or unconfined.
#include "apps/coupled/system_of_case.h"
#include "apps/run/progress.h"
#include "apps/run/protocol.h"
#include "apps/run/ranks.h"
#include "apps/run/step_report.h"
#include "apps/specimen/specimen.h"
#include "apps/specimen/start_stress.h"
#include "apps/triaxial/triaxial_output.h"
#include "apps/triaxial/triaxial_plan.h"
#include "apps/triaxial/triaxial_summary.h"
#include "dem/assembly/averages.h"
#include "dem/collective_failure.h"
#include "dem/continuum/particle_stress.h"
#include "dem/io/state/named_rows.h"

#include <algorithm>
#include <iostream>
#include <optional>
#include <sstream>

namespace mergel::apps {

namespace {

class TriaxialJob : public CheckpointedJob {
public:
  const char* name() const override { return "triaxial"; }
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
    return {system_->n_steps, system_->time, "stage " + label().name()};
  }
  void save(dem::State& state) const override;
  void require_files() const override
  {
    on_first_rank([&] { output_->require_in_place(); });
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
  void report_step() const;
  std::string record(); ///< returns lines for the user; mostly none
  double axial_strain() const
  {
    return 1.0 - test_->state().height / test_->geometry().height;
  }
  bool frame_is_due(bool stage_ends) const;
  bool bands_are_due(bool stage_ends) const;
  std::vector<dem::Vec3> positions();
  void write_fields(bool frame, bool bands);
  void write_frame(const coupling::LocalStrains& strains);

  TriaxialCase case_;
  coupling::SpecimenGeometry geometry_;
  std::optional<coupling::CoupledSystem> system_;
  std::optional<coupling::TriaxialTest> test_;
  std::optional<TriaxialOutput> output_;    ///< on the first rank
  std::vector<TriaxialPoint> points_;       ///< of all records
  std::vector<coupling::BandRecord> bands_; ///< numbers on the first rank
  std::optional<coupling::EarlierPositions> earlier_;
  TriaxialExtremes extremes_;
  dem::Vec3 start_ = dem::Vec3::Zero(); ///< stress of the middle third where it begins [Pa]
  /// Of stages begun; of the one under way unstable.
  std::vector<dem::Outcome> outcomes_;
  double next_frame_ = 0.0; ///< axial strain of the next picture by strain [-]
};

std::vector<std::string> TriaxialJob::free_keys() const
{
  return {"Loading/stage N", "Loading/strain limit", "Analysis/secant from",
          "Analysis/secant to", "Analysis/yield offset"};
}

std::vector<dem::Outcome> load_outcomes(const dem::State& state, std::size_t n_stages)
{
  std::vector<dem::Outcome> outcomes;
  for (const std::uint64_t n : state.get<std::uint64_t>("triaxial_outcomes")) {
    if (n > static_cast<std::uint64_t>(dem::Outcome::unstable))
      dem::State::refuse("triaxial_outcomes", "holds an unknown outcome");
    outcomes.push_back(static_cast<dem::Outcome>(n));
  }
  if (outcomes.empty() || outcomes.size() > n_stages)
    dem::State::refuse("triaxial_outcomes", "counts stages that the case does not have");
  return outcomes;
}

/// Refuse a change of the stages up to the present one.
void TriaxialJob::check_restart(const CaseFile& file, const Restart& restart) const
{
  const auto change =
      std::find_if(restart.changed.begin(), restart.changed.end(), [](const auto& k) {
        return k.section == "Loading" && k.key.starts_with("stage ");
      });
  if (change == restart.changed.end()) return;
  CaseFile earlier_file;
  TriaxialCase earlier;
  apps::declare(earlier_file, earlier);
  earlier_file.read_text(restart.checkpoint.label.case_text, restart.file.string());
  apps::complete(earlier_file, earlier);
  const auto n = load_outcomes(restart.checkpoint.state, earlier.stages.size()).size();
  if (!may_go_on(earlier.stage_texts, case_.stage_texts, n))
    file.refuse("Loading", change->key,
                "was \"" + change->was + "\", and the checkpoint is in stage " +
                    earlier.stage_labels[n - 1].name() +
                    " of the test: only later stages may change. Restore it, and add a "
                    "stage to go further; or choose an older checkpoint");
}

std::string TriaxialJob::what_is_done(const Restart& restart) const
{
  const auto outcomes = load_outcomes(restart.checkpoint.state, case_.stages.size());
  const std::size_t n = outcomes.size();
  const bool is_analysed_anew =
      std::any_of(restart.changed.begin(), restart.changed.end(),
                  [](const auto& k) { return k.section == "Analysis"; });
  switch (outcomes.back()) {
  case dem::Outcome::unstable: // under way
  case dem::Outcome::goes_on:
    return "";
  case dem::Outcome::done:
    if (n < case_.stages.size() || is_analysed_anew) return "";
    return "all its stages are done. To load the specimen further, restart with another "
           "stage.";
  default:
    if (is_analysed_anew) return "";
    return "stage " + case_.stage_labels[n - 1].name() +
           " ended the test: " + dem::sentence_of(outcomes.back()) +
           ". It cannot be loaded further.";
  }
}

void TriaxialJob::report_step() const
{
  std::cout << report(case_.step, system_->stable_step, system_->dt,
                      system_->assembly.particles);
}

/// Under which pressure the test begins.
std::string words_of_seat(const coupling::TriaxialTest& test, std::size_t n_steps)
{
  std::ostringstream out;
  out.precision(3);
  out << "at rest under " << 1e-3 * test.state().pressure << " kPa after " << n_steps
      << " steps; strains count from here";
  return out.str();
}

void TriaxialJob::begin(const CaseFile& file, RunFolder& folder, MPI_Comm comm)
{
  if (case_.membrane.is_there) load_mesh_library();
  const dem::Sample sample = obtain_sample(file, case_.specimen);
  std::cout << report(case_.specimen, sample) << '\n';
  geometry_ = geometry_of(case_, sample.packing.porosity);
  system_.emplace(coupled_spec(case_), structures(case_, comm), sample.packing.particles,
                  sample.bonding, comm);
  system_->settling.phase = coupling::Settling::Phase::done; // nothing acts on it yet
  system_->find_time_step();
  system_->dt_before = system_->dt;
  test_.emplace(case_, geometry_, *system_);
  if (case_.specimen.is_granular()) {
    Progress progress("seating in the membrane");
    test_->seat(case_.specimen.specimen.pressure);
    progress.done(words_of_seat(*test_, system_->n_steps));
  }
  const coupling::SpecimenGeometry& g = test_->geometry();
  start_ = along_axes(dem::slab_stress(system_->assembly, g.z_bottom + g.height / 3.0,
                                       g.z_bottom + 2.0 * g.height / 3.0, g.area));
  std::cout << report_on_start(start_, "of the middle third",
                               case_.specimen.is_granular() ? borne_without_bonds
                                                            : borne_by_contacts);
  report_step();
  std::cout << describe(case_, *test_) << '\n';
  folder.prepare();
  on_first_rank([&] {
    dem::write_sample(folder.path() / "sample.h5", sample);
    output_.emplace(folder.path(), case_);
  });
  earlier_.emplace(case_.localisation_every, axial_strain(), system_->x_0);
  if (case_.pictures != TriaxialCase::Pictures::none) write_fields(true, false);
  next_frame_ = case_.picture_every;
}

void TriaxialJob::resume(Restart& restart, RunFolder& folder, MPI_Comm comm)
{
  dem::State& state = restart.checkpoint.state;
  on_first_rank([&] { std::cout << TriaxialOutput::check(restart.folder, case_, state); });
  start_ = load_start(state);
  points_ = load_points(state);
  bands_ = coupling::load_band_records(state);
  outcomes_ = load_outcomes(state, case_.stages.size());
  dem::load_numbers(state, "triaxial_extremes", numbers_of(extremes_));
  geometry_ = geometry_of(case_, state.get_rows<double>("porosity", 1).front());
  next_frame_ = state.get_rows<double>("next_frame", 1).front();
  const dem::State& numbers = state;
  system_.emplace(coupled_spec(case_), structures(case_, comm), state,
                  std::vector<dem::RigidWall>{}, comm);
  test_.emplace(case_, geometry_, *system_, numbers);
  earlier_.emplace(case_.localisation_every, numbers, system_->x_0.size());
  report_step();
  folder.prepare();
  on_first_rank([&] { output_.emplace(folder.path(), case_, restart.folder, state); });
}

std::string TriaxialJob::record()
{
  const bool was_raised = test_->state().alarm.is_raised();
  const coupling::TriaxialRecord r = test_->record();
  points_.push_back(point_of(r));
  extremes_.add(r);
  on_first_rank([&] { output_->record(r, label()); });
  const dem::EnergyAlarm& alarm = test_->state().alarm;
  return alarm.is_raised() && !was_raised ? alarm_text(alarm) : "";
}

/// Of all particles, on every rank. Collective.
std::vector<dem::Vec3> TriaxialJob::positions()
{
  dem::Assembly& a = system_->assembly;
  a.partition.gather_motion(a.particles, a.comm);
  std::vector<dem::Vec3> x;
  for (const dem::ParticleState& b : a.particles.state) x.push_back(b.x);
  return x;
}

/// Find the local strains, and with them what is wanted: a frame, a line of localisation.csv.
void TriaxialJob::write_fields(bool frame, bool bands)
{
  const std::vector<dem::Vec3> x = positions();
  const double strain = axial_strain();
  const auto strains = coupling::local_strains(system_->x_0, earlier_->x(strain),
                                               system_->assembly.particles);
  if (bands) {
    const auto all = coupling::gather_on_first_rank(strains, system_->assembly);
    coupling::BandRecord found;
    on_first_rank([&] {
      found = coupling::find_bands(x, all, case_.d_50());
      found.time = test_->state().time;
      found.stage = test_->state().stage;
      found.axial_strain = strain;
      found.increment = earlier_->increment(strain);
      output_->record(found, case_.d_50(), label());
    });
    bands_.push_back(found);
  }
  if (frame) write_frame(strains);
  if (earlier_->is_due(strain)) earlier_->add(strain, x);
}

void TriaxialJob::write_frame(const coupling::LocalStrains& strains)
{
  const dem::Assembly& assembly = system_->assembly;
  const double e = test_->geometry().void_ratio;
  std::vector<dem::LoadedBranch> branches;
  on_every_rank([&] { branches = dem::loaded_branches(assembly); });
  const dem::FrameFiles frame({assembly, system_->x_0, branches,
                               dem::strained_porosity(e / (1.0 + e), strains.total),
                               fields_of(strains)});
  dem::AssemblyFiles files;
  on_first_rank([&] {
    output_->require_in_place();
    files = output_->files();
  });
  write_together(frame, files, [&] { output_->write_fields(*system_); });
  on_first_rank([&] { output_->add_frame(test_->state().time); });
}

bool TriaxialJob::frame_is_due(bool stage_ends) const
{
  using Pictures = TriaxialCase::Pictures;
  if (case_.pictures == Pictures::none) return false;
  if (stage_ends) return true;
  return case_.pictures == Pictures::strain && std::abs(axial_strain()) >= next_frame_;
}

bool TriaxialJob::bands_are_due(bool stage_ends) const
{
  const dem::ActiveStage& stage = test_->state().active;
  if (stage.controlled == dem::ActiveStage::Controlled::all || stage.is_approaching)
    return false;
  return stage_ends || earlier_->is_due(axial_strain()) || frame_is_due(stage_ends);
}

std::string words(const TriaxialPoint& r)
{
  std::ostringstream out;
  out.precision(3);
  out << "cell " << 1e-6 * r.cell_pressure << "  q " << 1e-6 * r.whole.q()
      << " MPa  axial strain " << 100.0 * r.whole.axial_strain() << " %  broken "
      << r.analysed.broken;
  return out.str();
}

/// Run one stage to its end, from its start or, if `is_under_way`, from the present state.
dem::Outcome TriaxialJob::load_stage(bool is_under_way,
                                     const std::function<void()>& after_step)
{
  std::string alarm;
  if (!is_under_way) {
    alarm = record();
    earlier_->begin_stage(axial_strain(), positions());
  }
  Progress progress("stage " + label().name() + ", " + label().text);
  progress.say(alarm);
  for (;;) {
    const bool approached = test_->is_approaching();
    test_->step();
    const dem::Outcome outcome = test_->outcome();
    const bool ends = outcome != dem::Outcome::goes_on;
    const bool begins = approached && !test_->is_approaching();
    if (ends || test_->record_is_due() || begins) progress.say(record());
    if (begins) earlier_->begin_stage(axial_strain(), positions());
    const bool draws = frame_is_due(ends), looks = bands_are_due(ends);
    if (draws || looks) write_fields(draws, looks);
    if (draws) next_frame_ = std::abs(axial_strain()) + case_.picture_every;
    if (ends) {
      progress.done(words(points_.back()));
      return outcome;
    }
    if (system_->n_steps % 20 == 0)
      progress.update(test_->progress(), [&] { return words(points_.back()); });
    after_step();
  }
}

void TriaxialJob::run(const std::function<void()>& after_step)
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

void TriaxialJob::save(dem::State& state) const
{
  system_->save(state);
  test_->save(state);
  save_start(state, start_);
  apps::save(state, points_);
  coupling::save(state, bands_);
  earlier_->save(state);
  dem::save_numbers(state, "triaxial_extremes", numbers_of(extremes_));
  const double e = geometry_.void_ratio;
  state.add_common<double>("porosity", {e / (1.0 + e)});
  state.add_common<double>("next_frame", {next_frame_});
  std::vector<std::uint64_t> outcomes;
  for (const dem::Outcome o : outcomes_) outcomes.push_back(static_cast<std::uint64_t>(o));
  state.add_common("triaxial_outcomes", std::move(outcomes));
  TriaxialOutput::save(state, output_ ? &*output_ : nullptr);
}

void TriaxialJob::summarise(Summary& summary, const Work& work) const
{
  if (points_.empty()) return;
  on_first_rank([&] {
    apps::summarise(summary, case_, *test_, *system_, outcomes_, points_, bands_, extremes_,
                    work);
    add_start(summary, start_);
  });
}

} // namespace

void keys_of_triaxial(const UseKeys& use)
{
  TriaxialJob job;
  show_keys(job, use);
}

int run_triaxial(const JobOptions& options)
{
  TriaxialJob job;
  return run_job(job, options);
}

} // namespace mergel::apps
