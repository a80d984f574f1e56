/// mergel pile: installs a cone-ended pile in bonded rock at a penetration rate.
#include "apps/case/words.h"
#include "apps/pile/installation.h"
#include "apps/pile/pile_summary.h"
#include "apps/run/jobs.h"
#include "apps/run/output_folder.h"
#include "apps/run/ranks.h"
#include "apps/run/restart.h"
#include "apps/run/results.h"
#include "apps/run/shared_folder.h"
#include "apps/specimen/specimen.h"
#include "dem/io/atomic_file.h"
#include "dem/text.h"
#include "dem/timer.h"

#include <algorithm>
#include <iostream>
#include <optional>

namespace mergel::apps {

void help_pile(std::ostream& out)
{
  CaseFile file;
  PileCase c;
  declare(file, c);
  file.help(out);
}

namespace {

/// Keys that a restart may change.
const std::vector<std::string> free_keys{
    "Pile/final depth", "Motion/time step safety", "Output/record every",
    "Output/frames",    "Output/checkpoint every", "Specimen/file"};

/// Refuse another final depth once the pile slows down for the old or the new one: the
/// velocity near the end depends on the final depth.
void check_new_end(const CaseFile& file, const PileCase& c, const Restart& restart)
{
  if (!Installation::is_in(restart.checkpoint.state)) return;
  CaseFile earlier_file;
  PileCase earlier;
  declare(earlier_file, earlier);
  earlier_file.read_text(restart.checkpoint.label.case_text, restart.file.string());
  if (earlier.travel() == c.travel()) return;
  const double travelled = Installation::travelled_in(restart.checkpoint.state);
  if (travelled <= std::min(PenetrationRate(earlier).slows_down_at(),
                            PenetrationRate(c).slows_down_at()))
    return;
  const auto mm = [](double x) { return dem::shortest(1e3 * x) + " mm"; };
  file.refuse("Pile", "final depth",
              "was " + mm(earlier.final_depth) +
                  ", and in the checkpoint, with the tip at " + mm(travelled) +
                  ", the pile has begun to slow down for one of the two depths: "
                  "restore it, or choose an older checkpoint");
}

/// Steps and wall-clock time of the run before this start of the program [-], [s].
struct WorkBefore {
  std::size_t n_steps = 0;
  double seconds = 0.0;
};

WorkBefore load_work(const dem::Checkpoint& checkpoint)
{
  return {checkpoint.label.step, checkpoint.state.get_rows<double>("seconds", 1).front()};
}

void go_on(Installation& run, const Restart& restart)
{
  run.load(restart.checkpoint.state);
  for (const CaseFile::Change& c : restart.changed) {
    if (c.key == "record every") run.space_records_anew();
    if (c.key == "final depth" || c.key == "frames") run.space_frames_anew();
  }
}

} // namespace

int run_pile(const JobOptions& options)
{
  const double start = dem::wall_clock();
  CaseFile file;
  PileCase c;
  FolderLock lock = hold_restarted(options);
  std::optional<Restart> restart = resume(file, c, options, "pile", free_keys);
  if (restart) {
    on_every_rank([&] { check_new_end(file, c, *restart); });
    std::cout << report(*restart) << '\n';
  }
  const auto inputs = inputs_of(options, restart, {c.assembly.sample, c.assembly.table});
  OutputFolder folder = folder_of(options, restart, inputs, std::move(lock));
  if (restart)
    on_first_rank([&] {
      std::cout << PileOutput::check(restart->folder, restart->checkpoint.state);
    });

  fem::FarField far_field = make_far_field(c.assembly);
  coupling::Interface interface = coupling::make_interface(
      far_field.interface(), c.assembly.interface, c.assembly.collar_height);
  std::optional<PileOutput> output;
  std::optional<CoupledSystem> coupled;
  if (restart) {
    std::cout << far_field.summary() << '\n';
    dem::State& state = restart->checkpoint.state;
    std::vector<dem::PileWall> piles;
    if (Installation::is_in(state)) piles.push_back(make_pile(c));
    coupled.emplace(c.assembly, state, std::move(piles), std::move(far_field),
                    std::move(interface));
    if (has_changed(*restart, "Motion", "time step safety")) coupled->lower_time_step(true);
    on_first_rank([&] {
      prepare_continued_folder(folder, inputs, file, *restart);
      output.emplace(folder.path(), c, restart->folder, state);
    });
    require_shared(folder.path());
    restart->file = checkpoint_in(folder.path(), *restart);
  } else {
    const dem::Sample sample = obtain_sample(file, c.assembly);
    std::cout << far_field.summary() << '\n' << report(c.assembly, sample) << '\n';
    on_first_rank([&] {
      folder.commit(inputs);
      file.write_resolved(folder.path() / "resolved.prm");
      dem::write_sample(folder.path() / "sample.h5", sample);
      output.emplace(folder.path(), c);
    });
    require_shared(folder.path());
    coupled.emplace(c.assembly, sample, std::move(far_field), std::move(interface));
  }

  Installation run(c, *coupled, output ? &*output : nullptr);
  const WorkBefore before = restart ? load_work(restart->checkpoint) : WorkBefore{};
  const auto seconds = [&] { return before.seconds + dem::wall_clock() - start; };
  CheckpointScheduler scheduler(
      {.folder = folder.path(),
       .job = "pile",
       .case_text = file.resolved_text(),
       .every = c.checkpoints.every,
       .end = start + options.walltime,
       .restarted_from = restart ? restart->file : std::filesystem::path{}});
  bool is_penetrating = restart && Installation::is_in(restart->checkpoint.state);
  if (is_penetrating) go_on(run, *restart);
  restart.reset(); // its arrays are no longer needed
  const auto after_step = [&] {
    scheduler.after_step(
        coupled->assembly.comm,
        {coupled->n_steps, coupled->time, is_penetrating ? "penetration" : "settling"},
        [&](dem::State& state) {
          coupled->save(state);
          PileOutput::save(state, output ? &*output : nullptr);
          state.add_common<double>("seconds", {seconds()});
          if (is_penetrating) run.save(state);
        });
  };
  const auto summarise = [&](const char* name, const std::string& failure) {
    const std::size_t n = count_debris(coupled->assembly, c.assembly.collar_height);
    on_first_rank(
        [&] { write_summary(folder.path() / name, run, *coupled, n, seconds(), failure); });
    return n;
  };
  std::size_t n_debris = 0;
  try {
    equilibrate(*coupled, c.assembly.unbalanced_tolerance, 200'000, after_step);
    if (!is_penetrating) run.begin();
    is_penetrating = true;
    run.run(after_step);
    n_debris = summarise("summary.json", "");
    on_first_rank([&] {
      output->require_in_place();
      require_results(folder.path(), "pile");
    });
  } catch (...) {
    scheduler.rethrow_with_remedy([&](const std::string& failure) {
      if (is_penetrating) {
        summarise("failed.json", failure);
        return;
      }
      on_first_rank([&] {
        dem::replace_file(folder.path() / "failed.json",
                          "{\n  \"failure\": " + in_json(failure) + "\n}\n");
      });
    });
  }
  print_summary(folder.path(), c, run, *coupled, n_debris,
                {coupled->n_steps - before.n_steps, seconds()});
  return 0;
}

} // namespace mergel::apps
