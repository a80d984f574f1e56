#include "apps/run/restart.h"

#include "apps/case/case_scan.h"
#include "apps/case/job_of_case.h"
#include "apps/case/words.h"
#include "apps/run/frames.h"
#include "dem/error.h"
#include "dem/io/atomic_file.h"

#include <algorithm>
#include <iostream>
#include <sstream>
#include <system_error>

namespace mergel::apps {

namespace fs = std::filesystem;

namespace {

/// Whether `place` is a file; what does not exist counts as one if its name ends in .h5.
bool names_file(const fs::path& place)
{
  std::error_code error; // an unreachable path is refused where it is read
  const fs::file_status status = fs::status(place, error);
  return fs::exists(status) ? !fs::is_directory(status) : place.extension() == ".h5";
}

/// @throws InputError when the folder exists and cannot be read
void require_readable(const fs::path& folder)
{
  std::error_code error;
  fs::directory_iterator(folder, error);
  if (error && error != std::errc::no_such_file_or_directory)
    throw InputError("--restart " + folder.string() + ": cannot be read: " +
                     error.message() + ". Check the path and its permissions.");
}

Restart read_file(const fs::path& file)
{
  try {
    return {file, folder_to_restart(file), dem::read_checkpoint(file), {}};
  } catch (const InputError& e) {
    const fs::path folder = folder_to_restart(file);
    const dem::FoundCheckpoint other = dem::newest_checkpoint(folder);
    throw InputError("--restart " + file.string() + ": " + e.what() +
                     (other.file.empty() ? "; no other checkpoint in its folder can be read"
                                         : "; a good one is " + other.file.string()));
  }
}

/// The newest good checkpoint of a folder; newer ones may be damaged.
/// @throws InputError when a newer one cannot be read for another reason, or none is good
Restart read_folder(const fs::path& place)
{
  const std::string in_front = "--restart " + place.string() + ": ";
  dem::FoundCheckpoint newest = dem::newest_checkpoint(place);
  std::vector<std::string> refused;
  for (const dem::RefusedCheckpoint& r : newest.refused) {
    refused.push_back(r.file.string() + ": " + r.reason);
    if (!r.is_damaged)
      throw InputError(in_front + refused.back() +
                       (r.is_of_other_version
                            ? ""
                            : ". It may be complete, so the run does not continue from an "
                              "older one: make it readable") +
                       (newest.file.empty() ? std::string(".")
                                            : ", or choose an older one with --restart " +
                                                  in_shell(newest.file.string()) + "."));
  }
  if (newest.file.empty())
    throw InputError(in_front + "no checkpoint can be read: " + joined(refused, "; "));
  return {newest.file, place, std::move(newest.checkpoint), std::move(refused)};
}

/// On the first rank only.
std::optional<Restart> choose(const fs::path& place, const std::string& job)
{
  std::optional<Restart> found;
  if (names_file(place))
    found = read_file(place);
  else {
    require_readable(place);
    if (dem::checkpoints_in(place).empty()) return found;
    found = read_folder(place);
  }
  const std::string& of = found->checkpoint.label.job;
  if (of != job)
    throw InputError("--restart " + found->file.string() + ": is a checkpoint of mergel " +
                     of + ", not of mergel " + job);
  return found;
}

} // namespace

fs::path folder_to_restart(const fs::path& place)
{
  if (!names_file(place)) return place;
  return place.parent_path().empty() ? fs::path(".") : place.parent_path();
}

FolderLock hold_restarted(const JobOptions& options)
{
  FolderLock lock;
  on_first_rank([&] {
    std::error_code error; // a folder that does not exist has no checkpoint
    if (!options.restart.empty() && fs::is_directory(options.output, error) &&
        fs::equivalent(options.output, folder_to_restart(options.restart), error))
      lock = FolderLock(options.output);
  });
  return lock;
}

std::optional<Restart> find_restart(const fs::path& place, const std::string& job)
{
  std::optional<Restart> found;
  if (place.empty()) return found;
  on_first_rank([&] { found = choose(place, job); });
  std::string file = found ? found->file.string() : "",
              folder = found ? found->folder.string() : "";
  share(file);
  share(folder);
  if (file.empty()) return found;
  on_ranks(!is_first_rank(), [&] {
    try {
      found = Restart{file, folder, dem::read_checkpoint(file), {}};
    } catch (const InputError& e) {
      throw InputError("--restart " + file + ": " + e.what());
    }
  });
  require_same_bytes(found->checkpoint.sum, "--restart " + file);
  return found;
}

namespace {

/// Read a case file. One that is refused may be a case of another job: then this is said, and
/// not which of its keys this job does not know.
/// @param arguments behind the name of the job, to run it
void read_or_name_job(CaseFile& file, const fs::path& path, const std::string& text,
                      const JobOptions& options, const std::string& arguments)
{
  try {
    file.read(path, text, options.set);
  } catch (const InputError&) {
    // Without --set: they are for this job. A specimen alone may be the start of any case.
    const CaseJob job = job_of_case(scan_case(text, path.string()), {});
    const bool is_other = !options.job.empty() && options.job != name_of(job) &&
                          (options.job != "sample" || job == CaseJob::bond);
    if (!is_other || job == CaseJob::sample) throw;
    throw InputError(path.string() + ": is a case of mergel " + name_of(job) +
                     ", not of mergel " + options.job + ". Run `mergel " + name_of(job) +
                     " " + arguments + "`.");
  }
}

} // namespace

void read_case(CaseFile& file, const JobOptions& options,
               const std::optional<Restart>& restart)
{
  if (!options.case_file.empty()) {
    read_or_name_job(file, options.case_file,
                     options.case_text ? *options.case_text
                                       : read_case_text(options.case_file),
                     options, in_shell(options.case_file.string()));
    return;
  }
  if (restart) {
    file.read_text(restart->checkpoint.label.case_text, restart->file.string(),
                   options.set);
    return;
  }
  const fs::path resolved = options.restart / "resolved.prm";
  std::error_code error;
  if (!fs::is_regular_file(resolved, error))
    throw InputError("--restart " + options.restart.string() +
                     ": holds neither a checkpoint nor a resolved.prm. Name the case file "
                     "to begin a run.");
  read_or_name_job(file, resolved, read_case_text(resolved), options,
                   "--restart " + in_shell(options.restart.string()));
}

namespace {

/// Whether `key` is `free`; one that ends in " N" stands for all numbers.
bool is_free(const std::string& key, const std::string& free)
{
  if (!free.ends_with(" N")) return key == free;
  const std::string stem = free.substr(0, free.size() - 1);
  return key.starts_with(stem) && key.size() > stem.size() &&
         key.find_first_not_of("0123456789", stem.size()) == std::string::npos;
}

} // namespace

void check_case(const CaseFile& file, Restart& restart,
                const std::vector<std::string>& free)
{
  restart.changed = file.changes_since(restart.checkpoint.label.case_text);
  for (const CaseFile::Change& c : restart.changed) {
    const std::string key = c.section + "/" + c.key;
    if (std::none_of(free.begin(), free.end(),
                     [&](const std::string& f) { return is_free(key, f); }))
      throw InputError("--restart " + restart.file.string() + ": " + key + " was " +
                       shown(c.was) + ", the case asks for " + shown(c.is) +
                       ". Restore it, or begin a new run; a restart may change only " +
                       joined(free, ", ") + ".");
  }
}

std::string report_on_history(const fs::path& file, const dem::HistoryMark& mark)
{
  if (dem::check_history(file, mark)) return "";
  return file.string() + ": is missing, and begins at the checkpoint\n";
}

const CaseFile::Change* find_change(const Restart& restart, const std::string& section,
                                    const std::string& key)
{
  for (const CaseFile::Change& c : restart.changed)
    if (c.section == section && c.key == key) return &c;
  return nullptr;
}

std::vector<fs::path> inputs_of(const JobOptions& options,
                                const std::optional<Restart>& restart,
                                const std::vector<fs::path>& others)
{
  std::vector<fs::path> inputs;
  if (options.restart.empty()) inputs.push_back(options.case_file);
  if (restart) inputs.push_back(restart->file);
  for (const fs::path& other : others)
    if (!restart && !other.empty()) inputs.push_back(other);
  return inputs;
}

OutputFolder folder_to_begin_in(const JobOptions& options)
{
  std::error_code error;
  const bool begins_again =
      !options.restart.empty() && fs::equivalent(options.output, options.restart, error);
  if (begins_again) return {options.output, Earlier::begun};
  return {options.output, options.overwrite ? Earlier::overwrite : Earlier::keep};
}

void begin_folder(OutputFolder& folder, const std::vector<fs::path>& inputs,
                  const CaseFile& file, const Provenance& made)
{
  folder.commit(inputs);
  file.write_resolved(folder.path() / "resolved.prm", made.remark());
}

namespace {

/// On the first rank only.
OutputFolder chosen_folder(const JobOptions& options, const std::optional<Restart>& restart)
{
  std::error_code error;
  if (restart && fs::equivalent(options.output, restart->folder, error))
    return {options.output, Earlier::go_on};
  if (restart)
    return {options.output, options.overwrite ? Earlier::overwrite : Earlier::keep};
  return folder_to_begin_in(options);
}

} // namespace

OutputFolder folder_of(const JobOptions& options, const std::optional<Restart>& restart,
                       const std::vector<fs::path>& inputs, FolderLock lock)
{
  OutputFolder folder(options.output, Earlier::keep);
  on_first_rank([&] {
    folder = chosen_folder(options, restart);
    folder.hold(std::move(lock));
    folder.check(inputs);
  });
  return folder;
}

fs::path checkpoint_in(const fs::path& folder, const Restart& restart)
{
  std::error_code error;
  return fs::equivalent(folder, restart.folder, error)
             ? restart.file
             : folder / dem::checkpoint_name(restart.checkpoint.label.step);
}

namespace {

/// Copy the checkpoint to the folder where the run continues, if that is another.
void copy_checkpoint(const Restart& restart, const fs::path& folder)
{
  const fs::path &checkpoint = restart.file, there = checkpoint_in(folder, restart);
  std::error_code error;
  if (fs::equivalent(checkpoint, there, error)) return;
  dem::replace_file(there, [&](const fs::path& file) {
    std::error_code failed;
    fs::copy_file(checkpoint, file, fs::copy_options::overwrite_existing, failed);
    if (failed)
      throw NumericalError(there.string() +
                           ": the checkpoint cannot be copied there: " + failed.message() +
                           ". Check the permissions of both folders and the free space, "
                           "or continue in its own folder, without --output.");
  });
}

} // namespace

void prepare_continued_folder(OutputFolder& folder,
                              const std::vector<std::filesystem::path>& inputs,
                              const CaseFile& file, const Restart& restart,
                              const Provenance& made)
{
  const std::string starts = earlier_starts(restart.folder / "resolved.prm");
  folder.commit(inputs);
  // Without it the folder would look like that of a run without checkpoints.
  copy_checkpoint(restart, folder.path());
  const std::size_t n_frames = Frames::count(restart.checkpoint.state);
  for (const auto& set_aside : folder.remove_after(n_frames, restart.checkpoint.label.step))
    std::cout << "set aside: " << set_aside.string() << '\n';
  file.write_resolved(folder.path() / "resolved.prm", starts + made.remark());
}

std::string report(const Restart& restart)
{
  const dem::CheckpointLabel& label = restart.checkpoint.label;
  std::ostringstream out;
  for (const std::string& file : restart.refused) out << "cannot be used: " << file << '\n';
  out << "restart from " << restart.file.string() << ": " << label.phase << ", step "
      << label.step << ", t = " << 1e3 * label.time << " ms";
  if (label.program != MERGEL_VERSION)
    out << "; written by mergel " << label.program
        << ": this program may not give the same bits";
  for (const CaseFile::Change& c : restart.changed)
    out << '\n'
        << c.section << '/' << c.key << " was " << shown(c.was) << ", is now "
        << shown(c.is);
  return printable(out.str());
}

} // namespace mergel::apps
