/// mergel brazilian: presses a disc of bonded rock across its diameter between two plates.
#include "apps/brazilian/brazilian_output.h"
#include "apps/brazilian/brazilian_plan.h"
#include "apps/brazilian/brazilian_summary.h"
#include "apps/run/progress.h"
#include "apps/run/protocol.h"
#include "apps/run/ranks.h"
#include "apps/run/step_report.h"
#include "apps/specimen/specimen.h"
#include "dem/continuum/particle_stress.h"
#include "dem/text.h"

#include <algorithm>
#include <iostream>
#include <optional>
#include <sstream>

namespace mergel::apps {

namespace {

using coupling::BrazilianOutcome;

class BrazilianJob : public CheckpointedJob {
public:
  const char* name() const override { return "brazilian"; }
  void declare(CaseFile& file) override { apps::declare(file, case_); }
  void complete(CaseFile& file) override { apps::complete(file, case_); }
  const CheckpointKey& checkpoints() const override { return case_.checkpoints; }
  Remarks unusual() const override { return apps::unusual(case_); }
  std::vector<std::filesystem::path> inputs() const override
  {
    return {case_.specimen.sample, case_.specimen.table};
  }
  std::vector<std::string> free_keys() const override
  {
    return {"Loading/strain limit", "Loading/final load"};
  }

  void check_restart(const CaseFile&, const Restart&) const override {}
  std::string what_is_done(const Restart& restart) const override;

  void begin(const CaseFile& file, RunFolder& folder, MPI_Comm comm) override;
  void resume(Restart& restart, RunFolder& folder, MPI_Comm comm) override;
  void run(const std::function<void()>& after_step) override;
  CheckpointScheduler::Position position() const override
  {
    return {system_->n_steps, system_->time, "strain " + dem::shortest(test_->strain())};
  }
  void save(dem::State& state) const override;
  void require_files() const override
  {
    on_first_rank([&] { output_->require_in_place(); });
  }
  void summarise(Summary& summary, const Work& work) const override;

private:
  void report_step() const;
  std::string record(); ///< returns lines for the user; mostly none
  void frame();
  std::string now() const;

  BrazilianCase case_;
  std::optional<coupling::CoupledSystem> system_;
  std::optional<coupling::BrazilianTest> test_;
  std::optional<BrazilianOutput> output_; ///< on the first rank
  double porosity_ = 0.0;                 ///< of the specimen as made [-]
  double next_frame_ = 0.0; ///< diametral strain of the next picture by strain [-]
};

std::string BrazilianJob::what_is_done(const Restart& restart) const
{
  const auto points = coupling::BrazilianTest::load_points(restart.checkpoint.state);
  const BrazilianOutcome outcome = coupling::outcome(case_, points);
  if (outcome == BrazilianOutcome::goes_on) return "";
  return sentence_of(outcome) + ". To load the disc further, restart with " +
         (outcome == BrazilianOutcome::load_fell ? "a lower `Loading/final load`."
                                                 : "a larger `Loading/strain limit`.");
}

void BrazilianJob::report_step() const
{
  std::cout << report(case_.step, system_->stable_step, system_->dt,
                      system_->assembly.particles);
}

std::string report_on_start(const coupling::BrazilianPoint& first)
{
  std::ostringstream out;
  out.precision(3);
  out << "stress at the start, at the centre: across the loaded diameter "
      << 1e-6 * first.across << ", along it " << 1e-6 * first.along
      << " MPa (tension positive), borne by its contacts: bonds begin without load\n";
  return out.str();
}

void BrazilianJob::begin(const CaseFile& file, RunFolder& folder, MPI_Comm comm)
{
  const dem::Sample sample = obtain_sample(file, case_.specimen);
  std::cout << report(case_.specimen, sample) << '\n';
  porosity_ = sample.packing.porosity;
  dem::Particles particles = sample.packing.particles;
  coupling::lay_disc(particles, case_.disc());
  system_.emplace(coupled_spec(case_), std::vector<coupling::StructureSpec>{}, particles,
                  sample.bonding, comm);
  system_->settling.phase = coupling::Settling::Phase::done; // nothing acts on it yet
  test_.emplace(case_, case_.disc(), case_.plate_contact, *system_);
  report_step();
  std::cout << describe(case_, *test_) << '\n';
  folder.prepare();
  on_first_rank([&] {
    dem::write_sample(folder.path() / "sample.h5", sample);
    output_.emplace(folder.path(), case_.disc());
  });
  std::cout << record() << report_on_start(test_->points().front());
  if (case_.pictures != BrazilianCase::Pictures::none) frame();
  next_frame_ = case_.picture_every;
}

void BrazilianJob::resume(Restart& restart, RunFolder& folder, MPI_Comm comm)
{
  dem::State& state = restart.checkpoint.state;
  on_first_rank([&] { std::cout << BrazilianOutput::check(restart.folder, state); });
  next_frame_ = state.get_rows<double>("next_frame", 1).front();
  porosity_ = state.get_rows<double>("porosity", 1).front();
  const dem::State& numbers = state;
  system_.emplace(coupled_spec(case_), std::vector<coupling::StructureSpec>{}, state,
                  coupling::BrazilianTest::plates(case_.plate_contact), comm);
  test_.emplace(case_, case_.disc(), *system_, numbers);
  report_step();
  folder.prepare();
  on_first_rank(
      [&] { output_.emplace(folder.path(), case_.disc(), restart.folder, state); });
}

std::string BrazilianJob::record()
{
  const bool was_raised = test_->state().alarm.is_raised();
  const coupling::BrazilianRecord r = test_->record();
  on_first_rank([&] { output_->record(r); });
  const dem::EnergyAlarm& alarm = test_->state().alarm;
  return alarm.is_raised() && !was_raised ? alarm_text(alarm) : "";
}

void BrazilianJob::frame()
{
  dem::Assembly& assembly = system_->assembly;
  assembly.partition.gather_motion(assembly.particles, assembly.comm);
  const auto fits = dem::local_deformations(system_->x_0, assembly.particles);
  std::vector<dem::LoadedBranch> branches;
  on_every_rank([&] { branches = dem::loaded_branches(assembly); });
  const dem::FrameFiles frame({assembly, system_->x_0, branches,
                               dem::strained_porosity(porosity_, fits),
                               dem::strain_fields(fits)});
  dem::AssemblyFiles files;
  on_first_rank([&] {
    output_->require_in_place();
    files = output_->files();
  });
  write_together(frame, files, [&] { output_->write_fields(assembly, *test_); });
  on_first_rank([&] { output_->add_frame(system_->time); });
}

std::string BrazilianJob::now() const
{
  const coupling::BrazilianPoint& p = test_->points().back();
  std::ostringstream out;
  out.precision(3);
  out << "P " << p.load << " N  2P/(pi D t) "
      << 1e-6 * case_.disc().splitting_stress(p.load) << " MPa  diametral strain "
      << 100.0 * p.strain << " %  broken " << p.broken;
  return out.str();
}

void BrazilianJob::run(const std::function<void()>& after_step)
{
  Progress progress("loading");
  const auto outcome = [&] { return coupling::outcome(case_, test_->points()); };
  while (outcome() == BrazilianOutcome::goes_on) {
    do {
      test_->step();
      if (test_->record_is_due()) break;
      if (system_->n_steps % 20 == 0)
        progress.update(test_->strain() / case_.strain_limit, [&] { return now(); });
      after_step();
    } while (true);
    progress.say(record());
    const bool ends = outcome() != BrazilianOutcome::goes_on;
    using Pictures = BrazilianCase::Pictures;
    const bool is_due =
        case_.pictures == Pictures::strain && test_->strain() >= next_frame_;
    if (is_due || (ends && case_.pictures != Pictures::none)) {
      frame();
      next_frame_ = test_->strain() + case_.picture_every;
    }
    if (!ends) after_step();
  }
  progress.done(now());
}

void BrazilianJob::save(dem::State& state) const
{
  system_->save(state);
  test_->save(state);
  state.add_common<double>("next_frame", {next_frame_});
  state.add_common<double>("porosity", {porosity_});
  BrazilianOutput::save(state, output_ ? &*output_ : nullptr);
}

void BrazilianJob::summarise(Summary& summary, const Work& work) const
{
  if (!test_ || test_->points().empty()) return;
  on_first_rank([&] { apps::summarise(summary, case_, *test_, *system_, work); });
}

} // namespace

void keys_of_brazilian(const UseKeys& use)
{
  BrazilianJob job;
  show_keys(job, use);
}

int run_brazilian(const JobOptions& options)
{
  BrazilianJob job;
  return run_job(job, options);
}

} // namespace mergel::apps
