#include "apps/run/output_folder.h"

#include "apps/case/case_file.h"
#include "apps/case/words.h"
#include "dem/error.h"
#include "dem/io/atomic_file.h"
#include "dem/io/picture_of_view.h"
#include "dem/io/readable.h"
#include "dem/io/seal.h"
#include "dem/io/state/checkpoint.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <limits>
#include <regex>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace mergel::apps {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 42> own_files{
    "history.csv",        "localisation.csv", "localisation.png",  "resolved.prm",
    "summary.json",       "sample.h5",        "damage.png",        "load.png",
    "displacement.png",   "particles.pvd",    "bonds.pvd",         "pile.pvd",
    "platens.pvd",        "membrane.pvd",     "far_field.pvd",     "loads.png",
    "surface.png",        "element.png",      "triaxial.png",      "specimen.png",
    "isotropic.png",      "curve.png",        "breaks.pvd",        "plates.pvd",
    "brazilian.png",      "disc.png",         "compare.png",       "failed.json",
    "fields.pvd",         "contacts.pvd",     "shaft_profile.csv", "tip_profile.csv",
    "radial_profile.csv", "stress.png",       "porosity.png",      "layers.png",
    "principal.png",      "chains.png",       "shaft.png",         "profiles.png",
    "stress_path.csv",    "paths.png"};
constexpr std::string_view own_folder = "fields";

[[noreturn]] void refuse(const fs::path& path, const std::string& message)
{
  throw InputError("output folder " + path.string() + ": " + message);
}

/// checkpoint_000000000300.h5.aside, .aside-2 and so on.
bool is_set_aside(const fs::path& name)
{
  static const std::regex form("\\.aside(-[0-9]+)?");
  return std::regex_match(name.extension().string(), form) &&
         dem::is_checkpoint_name(name.stem());
}

/// The first of these names that is free.
fs::path name_aside(const fs::path& checkpoint)
{
  for (int n = 1;; ++n) {
    fs::path name = checkpoint;
    name += n == 1 ? ".aside" : ".aside-" + std::to_string(n);
    std::error_code error; // a name that cannot be checked cannot be used either
    if (!fs::exists(fs::symlink_status(name, error))) return name;
  }
}

bool is_own_file(const fs::path& name)
{
  return std::find(own_files.begin(), own_files.end(), name.string()) != own_files.end() ||
         dem::is_checkpoint_name(name) || is_set_aside(name);
}

/// Refuse to begin again where a run finished or could be continued: its results would be
/// lost.
void require_unfinished(const fs::path& folder)
{
  std::error_code error;
  std::string found;
  if (fs::exists(folder / "summary.json", error))
    found = "a finished run";
  else if (fs::exists(folder / "failed.json", error))
    found = "a failed run";
  else
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      const fs::path name = entry->path().filename();
      if (dem::is_checkpoint_name(name) || dem::is_checkpoint_name(name.stem()))
        found = "a run with checkpoints"; // those set aside included
    }
  require(found.empty(),
          "--restart " + folder.string() + ": holds " + found +
              ", which a new run would replace. Choose another folder with --output, or "
              "replace that run with --overwrite and without --restart.");
}

/// Number in particles_0012.vtp; the largest std::uint64_t where it does not fit.
std::uint64_t frame_of(const fs::path& name)
{
  const std::string stem = name.stem().string();
  std::uint64_t frame = 0;
  const char* const digits = stem.data() + stem.rfind('_') + 1;
  const auto read = std::from_chars(digits, stem.data() + stem.size(), frame);
  return read.ec == std::errc{} ? frame : std::numeric_limits<std::uint64_t>::max();
}

/// Whether it is a folder, and not a link to one.
bool is_real_folder(const fs::path& path)
{
  std::error_code error;
  return fs::is_directory(fs::symlink_status(path, error));
}

/// particles_0012.vtp and the like.
bool is_own_field(const fs::path& name)
{
  static const std::regex frame("(particles|bonds|pile|platens|membrane|breaks|plates|"
                                "contacts)_[0-9]{4,}\\.vtp|far_field_[0-9]{4,}\\.vtu|"
                                "fields_[0-9]{4,}\\.vti");
  return std::regex_match(name.string(), frame);
}

/// Final name of a temporary file, which a stopped run could not rename: history.csv for
/// .history.partial.csv. Any other name is returned as it is.
fs::path final_name(const fs::path& name)
{
  constexpr std::string_view mark = ".partial";
  std::string text = name.string();
  const auto at = text.rfind(mark);
  if (!text.starts_with('.') || at == std::string::npos) return name;
  text.erase(at, mark.size()).erase(0, 1);
  return dem::temporary_name(text) == name ? fs::path(text) : name;
}

} // namespace

bool holds_run(const fs::path& folder)
{
  if (dem::begins_with(folder / "resolved.prm", CaseFile::first_words_of_resolved))
    return true;
  std::error_code error; // a folder that cannot be read holds no run
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path name = entry->path().filename();
    const bool is_checkpoint = (dem::is_checkpoint_name(name) || is_set_aside(name)) &&
                               dem::begins_as_sealed(entry->path(), "checkpoint");
    if (is_checkpoint || (final_name(name) != name && is_own_file(final_name(name))))
      return true;
  }
  return false;
}

OutputFolder::OutputFolder(fs::path folder, Earlier earlier)
    : folder_(std::move(folder)), earlier_(earlier)
{
}

std::vector<fs::path> OutputFolder::left_by_earlier_run() const
{
  std::vector<fs::path> found;
  const auto look_into = [&](const fs::path& folder, auto&& is_own) {
    std::error_code error, unknown;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
      // a link counts as a file, never as what it points to
      if (is_own(entry->path().filename(), is_real_folder(entry->path())))
        found.push_back(entry->path());
    if (error && fs::exists(folder_, unknown))
      refuse(folder_, "cannot be read: " + error.message() + " at " +
                          in_quotes(folder.string()) +
                          ". Check its permissions, or choose another folder with "
                          "--output.");
  };
  look_into(folder_, [](const fs::path& name, bool is_folder) {
    return !is_folder && (name == own_folder || is_own_file(final_name(name)));
  });
  if (is_real_folder(folder_ / own_folder))
    look_into(folder_ / own_folder, [](const fs::path& name, bool is_folder) {
      return !is_folder && is_own_field(final_name(name));
    });
  std::sort(found.begin(), found.end()); // a folder lists its files in any order
  return found;
}

bool OutputFolder::is_of_run() const
{
  const bool has_lock_of_another = !lock_.is_held() && FolderLock::is_known(folder_);
  return has_lock_of_another || holds_run(folder_);
}

void OutputFolder::check(const std::vector<fs::path>& inputs) const
{
  check(inputs, is_of_run());
}

void OutputFolder::check(const std::vector<fs::path>& inputs, bool is_of_run) const
{
  if (folder_.empty())
    throw InputError("output folder: no name is given. Use --output DIR.");

  // the folder itself or, if it does not exist yet, the nearest parent that does
  std::error_code error;
  fs::path there = fs::absolute(folder_, error).lexically_normal();
  if (error)
    refuse(folder_, "cannot be located: the working folder no longer exists (" +
                        error.message() + "). Use an absolute path.");
  while (!fs::exists(fs::symlink_status(there, error)) && there.has_relative_path()) {
    if (error == std::errc::filename_too_long)
      refuse(folder_, "cannot be created: " + error.message() +
                          ". Choose another folder with --output.");
    there = there.parent_path();
  }
  if (!fs::is_directory(fs::status(there, error))) {
    const std::string remedy = ". Choose another folder with --output.";
    if (error == std::errc::permission_denied)
      refuse(folder_, "cannot be reached: " + error.message() + remedy);
    refuse(folder_, in_quotes(there.string()) + " exists and is not a folder" + remedy);
  }
  if (::access(there.c_str(), W_OK | X_OK) != 0)
    refuse(folder_, "cannot be written: " + std::generic_category().message(errno) +
                        " at \"" + there.string() +
                        "\". Choose another folder with --output.");

  if (!lock_.is_held()) require_no_run(folder_);
  if (earlier_ == Earlier::begun) require_unfinished(folder_);
  const std::vector<fs::path> earlier = left_by_earlier_run();
  if (earlier.empty() || earlier_ == Earlier::go_on) return;
  if (!is_of_run)
    refuse(folder_, "holds " + earlier.front().lexically_relative(folder_).string() +
                        ", and no run of mergel that has written it. Move it away, or "
                        "choose another folder with --output.");
  if (earlier_ == Earlier::keep)
    refuse(folder_, "holds an earlier run (" +
                        earlier.front().lexically_relative(folder_).string() +
                        "). Choose another folder with --output, or replace that run with "
                        "--overwrite.");
  for (const fs::path& old : earlier)
    if (old.extension() == ".png" && final_name(old.filename()) == old.filename() &&
        !dem::is_picture_of_view(old))
      refuse(folder_, "holds " + old.filename().string() +
                          ", which this version of mergel-view has not made. Move it away, "
                          "or choose another folder with --output.");
  for (const fs::path& old : earlier)
    for (const fs::path& input : inputs) {
      if (input.empty()) continue;
      std::error_code no_input, no_old; // an unreachable file is not read
      const fs::path relative = fs::weakly_canonical(input, no_input)
                                    .lexically_relative(fs::weakly_canonical(old, no_old));
      if (no_input || no_old) continue;
      if (!relative.empty() && *relative.begin() != "..")
        refuse(folder_, "--overwrite would remove " + input.string() +
                            ", which this run reads. Choose another folder with --output.");
    }
}

void OutputFolder::commit(const std::vector<fs::path>& inputs)
{
  const bool was_of_run = is_of_run(); // before the lock of this run is there
  check(inputs, was_of_run);
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error)
    refuse(folder_, "cannot be created: " + error.message() +
                        ". Choose another folder with --output.");
  if (!lock_.is_held()) {
    lock_ = FolderLock(folder_);
    check(inputs, was_of_run || holds_run(folder_)); // another run may have written since
  }
  if (earlier_ == Earlier::go_on) return;
  for (const fs::path& old : left_by_earlier_run()) {
    fs::remove(old, error); // removes a link, not what it points to
    if (error)
      refuse(folder_, old.filename().string() +
                          " of an earlier run cannot be removed: " + error.message() + ".");
  }
  const fs::path fields = folder_ / own_folder;
  if (is_real_folder(fields)) fs::remove(fields, error); // only when it is empty
}

OwnFiles own_files_in(const fs::path& folder)
{
  OwnFiles found;
  dem::require_folder(folder);
  if (is_real_folder(folder / own_folder)) dem::require_folder(folder / own_folder);
  std::error_code error; // a folder that goes meanwhile counts as empty
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path name = entry->path().filename();
    if (is_own_file(final_name(name))) found.files.push_back(entry->path());
    if (is_set_aside(name)) found.aside.push_back(entry->path());
  }
  for (fs::directory_iterator entry(folder / own_folder, error), end;
       !error && entry != end; entry.increment(error))
    if (is_own_field(entry->path().filename())) found.frames.push_back(entry->path());
  std::sort(found.frames.begin(), found.frames.end());
  return found;
}

std::vector<fs::path> OutputFolder::remove_after(std::size_t n_frames,
                                                 std::uint64_t step) const
{
  std::vector<fs::path> set_aside;
  for (const fs::path& file : left_by_earlier_run()) {
    const fs::path name = file.filename();
    if (dem::is_checkpoint_name(name) && dem::is_later(name, dem::checkpoint_name(step))) {
      set_aside.push_back(name_aside(file));
      std::error_code error; // under its old name it would count as one of this run
      fs::rename(file, set_aside.back(), error);
      if (error)
        throw NumericalError(file.string() + ": cannot be set aside as " +
                             set_aside.back().filename().string() + ": " + error.message() +
                             ". Check the permissions of the folder, or choose another "
                             "with --output.");
      continue;
    }
    std::error_code ignored; // a file that stays is written again, with the same content
    if (final_name(name) != name || name == "summary.json" || name == "failed.json" ||
        (is_own_field(name) && frame_of(name) >= n_frames))
      fs::remove(file, ignored);
  }
  return set_aside;
}

} // namespace mergel::apps
