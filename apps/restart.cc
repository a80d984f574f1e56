#include "apps/restart.h"

#include "apps/words.h"
#include "dem/error.h"

#include <algorithm>
#include <sstream>

namespace mergel::apps {

namespace fs = std::filesystem;

namespace {

/// A results folder may still have to be made.
bool names_file(const fs::path& place)
{
  return fs::exists(place) ? !fs::is_directory(place) : place.extension() == ".h5";
}

Restart read_file(const fs::path& file)
{
  try {
    return {file, folder_to_restart(file), dem::read_checkpoint(file), {}};
  } catch (const InputError& e) {
    const fs::path folder = folder_to_restart(file);
    const dem::FoundCheckpoint other = dem::newest_checkpoint(folder);
    throw InputError("--restart " + file.string() + ": " + e.what() +
                     (other.file.empty()
                          ? "; there is no other checkpoint beside it that can be read"
                          : "; a good one is " + other.file.string()));
  }
}

std::string shown(const std::string& value)
{
  return value.empty() ? "not given" : value;
}

} // namespace

fs::path folder_to_restart(const fs::path& place)
{
  if (!names_file(place)) return place;
  return place.parent_path().empty() ? fs::path(".") : place.parent_path();
}

std::optional<Restart> find_restart(const fs::path& place, const std::string& job)
{
  std::optional<Restart> found;
  if (place.empty()) return found;
  if (!names_file(place)) {
    if (dem::checkpoints_in(place).empty()) return found;
    dem::FoundCheckpoint newest = dem::newest_checkpoint(place);
    if (newest.file.empty())
      throw InputError("--restart " + place.string() +
                       ": no checkpoint can be read: " + joined(newest.refused, "; "));
    found = Restart{newest.file, place, std::move(newest.checkpoint), newest.refused};
  } else {
    found = read_file(place);
  }
  const std::string& of = found->checkpoint.label.job;
  if (of != job)
    throw InputError("--restart " + found->file.string() + ": is a checkpoint of mergel " +
                     of + ", not of mergel " + job);
  return found;
}

void read_case(CaseFile& file, const JobOptions& options,
               const std::optional<Restart>& restart)
{
  if (!options.case_file.empty()) {
    file.read(options.case_file, options.set);
    return;
  }
  if (restart) {
    file.read_text(restart->checkpoint.label.case_text, restart->file.string(),
                   options.set);
    return;
  }
  const fs::path resolved = options.restart / "resolved.prm";
  if (!fs::is_regular_file(resolved))
    throw InputError("--restart " + options.restart.string() +
                     ": holds neither a checkpoint nor a resolved.prm. Give the case file "
                     "to begin.");
  file.read(resolved, options.set);
}

std::vector<CaseFile::Change> check_case(const CaseFile& file, const Restart& restart,
                                         const std::vector<std::string>& free)
{
  std::vector<CaseFile::Change> changes =
      file.changes_since(restart.checkpoint.label.case_text);
  for (const CaseFile::Change& c : changes) {
    const std::string key = c.section + "/" + c.key;
    if (std::find(free.begin(), free.end(), key) == free.end())
      throw InputError("--restart " + restart.file.string() + ": " + key + " was " +
                       shown(c.was) + ", the case asks for " + shown(c.is) +
                       ". Restore it, or begin a new run; a restart may change only " +
                       joined(free, ", ") + ".");
  }
  return changes;
}

namespace {

/// Refuse to begin again where a run ended, or could go on: its results would be lost.
void require_unfinished(const fs::path& folder)
{
  std::error_code error;
  std::string found;
  if (fs::exists(folder / "summary.json", error))
    found = "a finished run";
  else
    for (const auto& entry : fs::directory_iterator(folder, error))
      if (dem::is_checkpoint_name(entry.path().filename()))
        found = "a run with checkpoints";
  require(found.empty(),
          "--restart " + folder.string() + ": holds " + found +
              ", and this one would begin again. Choose another folder with --output, or "
              "replace that run with --overwrite and without --restart.");
}

} // namespace

OutputFolder folder_to_begin_in(const JobOptions& options)
{
  std::error_code error;
  const bool begins_again =
      !options.restart.empty() && fs::equivalent(options.output, options.restart, error);
  if (begins_again) require_unfinished(options.output);
  return {options.output,
          options.overwrite || begins_again ? Earlier::overwrite : Earlier::keep};
}

std::string report(const Restart& restart, const std::vector<CaseFile::Change>& changed)
{
  const dem::CheckpointLabel& label = restart.checkpoint.label;
  std::ostringstream out;
  for (const std::string& file : restart.refused) out << "cannot be used: " << file << '\n';
  out << "restart from " << restart.file.string() << ": " << label.stage << ", step "
      << label.step << ", t = " << 1e3 * label.time << " ms";
  if (label.program != MERGEL_VERSION)
    out << "; written by mergel " << label.program
        << ": this program may not give the same bits";
  for (const CaseFile::Change& c : changed)
    out << '\n'
        << c.section << '/' << c.key << " was " << shown(c.was) << ", is now "
        << shown(c.is);
  return out.str();
}

} // namespace mergel::apps
