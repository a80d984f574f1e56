#include "apps/run/protocol.h"

#include "apps/case/words.h"
#include "apps/run/ranks.h"
#include "apps/run/results.h"
#include "apps/run/shared_folder.h"
#include "dem/io/atomic_file.h"
#include "dem/timer.h"

#include <iostream>
#include <optional>
#include <stdexcept>

namespace mergel::apps {

namespace fs = std::filesystem;

void RunFolder::prepare()
{
  on_first_rank([&] {
    if (restart_)
      prepare_continued_folder(folder_, inputs_, file_, *restart_, made_);
    else
      begin_folder(folder_, inputs_, file_, made_);
  });
  require_shared(path());
  is_prepared_ = true;
}

void RunFolder::restore_case() const
{
  const fs::path resolved = path() / "resolved.prm";
  std::error_code error; // one that cannot be reached is missed by lost_results()
  if (fs::status(resolved, error).type() != fs::file_type::not_found) return;
  file_.write_resolved(resolved, made_.remark());
  std::cout << printable(resolved.string()) << ": was gone, and is written again\n";
}

namespace {

std::string sentence_on_lost(const std::string& lost, bool has_checkpoint)
{
  return lost + (has_checkpoint
                     ? ". The run is finished otherwise: its summary and the "
                       "checkpoint of its end are written"
                     : ". The run is finished otherwise: its summary is written");
}

std::vector<std::string> free_keys_of(const CheckpointedJob& job)
{
  std::vector<std::string> keys = job.free_keys();
  keys.insert(keys.end(),
              {"Motion/time step safety", "Motion/largest overlap",
               "Output/checkpoint every", "Output/checkpoint at end", "Specimen/file"});
  return keys;
}

/// Read the case, and find the checkpoint that the run continues from, if there is one.
/// Collective.
std::optional<Restart> read(CheckpointedJob& job, CaseFile& file, const JobOptions& options)
{
  std::optional<Restart> restart = find_restart(options.restart, job.name());
  job.declare(file);
  if (restart) file.continue_from(restart->checkpoint.label.case_text);
  on_every_rank([&] {
    read_case(file, options, restart);
    job.complete(file);
    if (!restart) return;
    check_case(file, *restart, free_keys_of(job));
    job.check_restart(file, *restart);
  });
  require_same_case(file);
  return restart;
}

/// Whether a folder has the summary of a finished run.
bool has_summary(const fs::path& folder)
{
  std::error_code error; // a summary that cannot be reached is written again
  return fs::exists(folder / "summary.json", error);
}

/// What the finished run in `folder` has reached; "" where something is left to do.
/// Collective.
std::string what_is_done(const CheckpointedJob& job, const Restart& restart,
                         const fs::path& folder)
{
  std::string done;
  on_first_rank([&] {
    std::error_code error; // another folder gets its own results
    if (fs::equivalent(folder, restart.folder, error) && has_summary(folder))
      done = job.what_is_done(restart);
  });
  share(done);
  return done;
}

double seconds_in(const dem::State& state)
{
  return state.get_rows<double>("seconds", 1).front();
}

/// Print the closing text of a run whose summary is this file.
void print_summary(const fs::path& file, const Summary& summary)
{
  const std::string text = summary.closing.str(), folder = file.parent_path().string();
  if (text.empty()) return;
  std::error_code error; // the user sees what there is
  const bool has_fields = fs::exists(file.parent_path() / "particles.pvd", error);
  std::cout << '\n'
            << text << "\nresults: " << printable(folder) << " (history.csv, "
            << file.filename().string() << (has_fields ? ", *.pvd for ParaView" : "")
            << "); pictures: mergel-view " << in_shell(folder) << std::endl;
}

} // namespace

void show_keys(CheckpointedJob& job, const UseKeys& use)
{
  CaseFile file;
  job.declare(file);
  use(file);
}

int run_job(CheckpointedJob& job, const JobOptions& options, MPI_Comm comm)
{
  const double start = dem::wall_clock();
  const dem::Communicator all(comm);
  CaseFile file;
  FolderLock lock = hold_restarted(options);
  std::optional<Restart> restart = read(job, file, options);
  const std::vector<fs::path> inputs = inputs_of(options, restart, job.inputs());
  OutputFolder output = folder_of(options, restart, inputs, std::move(lock));
  if (restart) {
    if (const std::string done = what_is_done(job, *restart, output.path());
        !done.empty()) {
      std::cout << output.path().string() << " holds the finished run: " << done << '\n';
      return 0;
    }
    std::cout << report(*restart) << '\n';
  }

  const double seconds_before = restart ? seconds_in(restart->checkpoint.state) : 0.0;
  const Provenance made = provenance(options);
  RunFolder folder(output, inputs, file, restart ? &*restart : nullptr, made);
  if (restart)
    job.resume(*restart, folder, comm);
  else {
    std::cout << lines_of(job.unusual());
    job.begin(file, folder, comm);
  }
  if (!folder.is_prepared())
    throw std::logic_error(std::string("the job ") + job.name() +
                           " began without its results folder");

  const std::uint64_t first_step = job.position().step;
  const auto seconds = [&] { return seconds_before + dem::wall_clock() - start; };
  CheckpointScheduler scheduler(
      {.folder = folder.path(),
       .job = job.name(),
       .case_text = file.resolved_text(),
       .every = job.checkpoints().every,
       .end = start + options.walltime,
       .restarted_from = restart ? checkpoint_in(folder.path(), *restart) : fs::path{}});
  restart.reset(); // its arrays are no longer needed
  const auto save = [&](dem::State& state) {
    job.save(state);
    state.add_common<double>("seconds", {seconds()});
  };
  const auto summarise = [&](const char* name, const std::string& failure) {
    Summary summary;
    if (!failure.empty()) summary.text("failure", failure);
    job.summarise(summary, {job.position().step - first_step, seconds()});
    summary.json("made by", made.json());
    const fs::path summary_file = folder.path() / name;
    on_first_rank([&] { dem::replace_file(summary_file, summary.object()); });
    print_summary(summary_file, summary);
  };
  std::string lost; // of the results, while the run went on
  try {
    job.run([&] { scheduler.after_step(all, job.position(), save); });
    // A summary says that a run is finished: only once its history was looked at.
    job.require_files();
    on_first_rank([&] {
      folder.restore_case();
      lost = lost_results(folder.path(), job.name());
    });
    summarise("summary.json", "");
  } catch (...) {
    scheduler.rethrow_with_remedy(
        [&](const std::string& failure) { summarise("failed.json", failure); });
  }
  if (job.checkpoints().at_end) scheduler.at_end(all, job.position(), save);
  share(lost);
  if (!lost.empty()) throw Remedied(sentence_on_lost(lost, job.checkpoints().at_end));
  return 0;
}

} // namespace mergel::apps
