/// mergel pile: installs a pile in bonded rock and loads it.
#include "apps/pile/installation.h"
#include "apps/pile/pile_plan.h"
#include "apps/pile/pile_restart.h"
#include "apps/pile/pile_summary.h"
#include "apps/run/protocol.h"
#include "apps/run/ranks.h"
#include "apps/run/step_report.h"
#include "apps/specimen/specimen.h"
#include "apps/specimen/start_stress.h"
#include "dem/assembly/averages.h"

#include <iostream>
#include <optional>

namespace mergel::apps {

namespace {

class PileJob : public CheckpointedJob {
public:
  const char* name() const override { return "pile"; }
  void declare(CaseFile& file) override { apps::declare(file, case_); }
  void complete(CaseFile& file) override { apps::complete(file, case_); }
  const CheckpointKey& checkpoints() const override { return case_.checkpoints; }
  Remarks unusual() const override { return apps::unusual(case_); }
  std::vector<std::filesystem::path> inputs() const override
  {
    std::vector<std::filesystem::path> files{case_.assembly.sample, case_.assembly.table,
                                             case_.surface.file};
    if (!case_.assembly.elasticity_from.empty())
      files.push_back(case_.assembly.elasticity_from / "summary.json");
    return files;
  }
  std::vector<std::string> free_keys() const override
  {
    return {"Pile/final depth",
            "Loading/stage N",
            "Loading/displacement rate",
            "Loading/force ramp",
            "Loading/unbalanced-force tolerance",
            "Loading/largest settlement",
            "Pile/mass",
            "Output/record every",
            "Output/frames",
            "Output/averaging length",
            "Far field/elasticity from"};
  }

  void check_restart(const CaseFile& file, const Restart& restart) const override
  {
    check_changed_stages(file, restart, case_);
  }
  std::string what_is_done(const Restart& restart) const override;

  void begin(const CaseFile& file, RunFolder& folder, MPI_Comm comm) override;
  void resume(Restart& restart, RunFolder& folder, MPI_Comm comm) override;
  void run(const std::function<void()>& after_step) override;
  CheckpointScheduler::Position position() const override
  {
    return {coupled_->n_steps, coupled_->time,
            is_penetrating_ ? installation_->phase() : "settling"};
  }
  void save(dem::State& state) const override;
  void require_files() const override
  {
    on_first_rank([&] { output_->require_in_place(); });
  }
  void summarise(Summary& summary, const Work& work) const override;

private:
  void report_step() const
  {
    std::cout << report(case_.assembly.step, coupled_->stable_step, coupled_->dt,
                        coupled_->assembly.particles);
  }
  const PileOutput* output() const { return output_ ? &*output_ : nullptr; }

  PileCase case_;
  std::optional<PileOutput> output_; ///< on the first rank
  std::optional<coupling::CoupledSystem> coupled_;
  std::optional<Installation> installation_;
  dem::Vec3 start_ = dem::Vec3::Zero(); ///< stress before the penetration [Pa]
  bool is_penetrating_ = false;
};

/// Stress of a box in the middle third of the height, away from side and symmetry plane [Pa],
/// compression positive. Collective.
dem::Vec3 stress_in_the_middle(const CoupledCase& c, const dem::Assembly& assembly)
{
  const double R = 0.5 * c.diameter, y = c.is_half() ? 0.25 * R : -0.5 * R;
  const dem::Vec3 low(-0.5 * R, y, -2.0 / 3.0 * c.height),
      high(0.5 * R, 0.5 * R, -1.0 / 3.0 * c.height);
  return along_axes(dem::box_stress(assembly, low, high, (high - low).prod()));
}

std::string PileJob::what_is_done(const Restart& restart) const
{
  if (!Installation::is_in(restart.checkpoint.state)) return "";
  const StagePosition at = Installation::stages_in(restart.checkpoint.state);
  if (at.n_done < case_.stages.size()) return "";
  if (case_.has_stages())
    return "all its loading stages are done. To go on, restart with a further `Loading/" +
           key_of_pile_stage(case_.stages.size()) + "`.";
  if (Installation::push_in(restart.checkpoint.state).tip < case_.travel()) return "";
  return "the pile is at its final depth, " + mm_text(case_.final_depth) +
         ". To push it further, restart with a larger `Pile/final depth`.";
}

void PileJob::begin(const CaseFile& file, RunFolder& folder, MPI_Comm comm)
{
  fem::FarField far_field = make_far_field(case_.assembly, comm);
  dem::Sample sample = obtain_sample(file, case_.assembly);
  std::cout << far_field.summary() << '\n'
            << report_on_impedance(case_.assembly) << report(case_.assembly, sample)
            << '\n';
  if (case_.surface.polyhedron) std::cout << apps::report(case_.surface);
  apply_surcharge(case_.assembly, sample.packing.particles);
  coupled_.emplace(coupled_spec(case_.assembly),
                   structures(case_.assembly, std::move(far_field)),
                   sample.packing.particles, sample.bonding, comm);
  report_step();
  installation_.emplace(case_, *coupled_, output_);
  folder.prepare();
  on_first_rank([&] {
    dem::write_sample(folder.path() / "sample.h5", sample);
    output_.emplace(folder.path(), case_);
  });
}

void PileJob::resume(Restart& restart, RunFolder& folder, MPI_Comm comm)
{
  dem::State& state = restart.checkpoint.state;
  on_first_rank([&] { std::cout << PileOutput::check(restart.folder, state); });
  fem::FarField far_field = make_far_field(case_.assembly, comm);
  std::cout << far_field.summary() << '\n';
  is_penetrating_ = Installation::is_in(state);
  std::vector<dem::RigidWall> piles;
  if (is_penetrating_) piles.push_back(make_pile(case_));
  coupled_.emplace(coupled_spec(case_.assembly),
                   structures(case_.assembly, std::move(far_field)), state,
                   std::move(piles), comm);
  report_step();
  installation_.emplace(case_, *coupled_, output_);
  if (is_penetrating_) {
    start_ = load_start(state);
    installation_->load(state);
    if (const Push before = Installation::push_in(state);
        !case_.has_stages() && before.is_over() && before.tip < case_.travel())
      std::cout << "the pile starts again from rest, "
                << mm_text(before.tip - case_.tip_height())
                << " deep: the curve is that of " << installation_->n_pushes() + 1
                << " pushes\n";
    if (find_change(restart, "Output", "record every")) installation_->space_records_anew();
    if (find_change(restart, "Pile", "final depth") ||
        find_change(restart, "Output", "frames"))
      installation_->space_frames_anew();
  }
  folder.prepare();
  on_first_rank([&] { output_.emplace(folder.path(), case_, restart.folder, state); });
}

void PileJob::run(const std::function<void()>& after_step)
{
  equilibrate(*coupled_, case_.assembly.unbalanced_tolerance, 200'000, after_step);
  if (!is_penetrating_) {
    start_ = stress_in_the_middle(case_.assembly, coupled_->assembly);
    std::cout << report_on_start(start_, "in the middle of the specimen",
                                 "by contacts and bonds after settling");
    installation_->begin();
  }
  is_penetrating_ = true;
  installation_->run(after_step);
}

void PileJob::save(dem::State& state) const
{
  coupled_->save(state);
  PileOutput::save(state, output());
  if (!is_penetrating_) return;
  installation_->save(state);
  save_start(state, start_);
}

void PileJob::summarise(Summary& summary, const Work& work) const
{
  if (!is_penetrating_) return;
  if (output_) output_->summarise(summary); // on the first rank, which writes it
  apps::summarise(summary, case_, *installation_, *coupled_, work);
  add_start(summary, start_);
}

} // namespace

void keys_of_pile(const UseKeys& use)
{
  PileJob job;
  show_keys(job, use);
}

int run_pile(const JobOptions& options)
{
  PileJob job;
  return run_job(job, options);
}

} // namespace mergel::apps
