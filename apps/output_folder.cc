#include "apps/output_folder.h"

#include "apps/words.h"
#include "dem/error.h"
#include "dem/io/atomic_file.h"
#include "dem/io/checkpoint.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <regex>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace mergel::apps {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 16> own_files{
    "history.csv", "resolved.prm", "summary.json",     "sample.h5",
    "damage.png",  "load.png",     "displacement.png", "particles.pvd",
    "bonds.pvd",   "pile.pvd",     "far_field.pvd",    "loads.png",
    "surface.png", "element.png",  "isotropic.png",    "curve.png"};
constexpr std::string_view own_folder = "fields";

[[noreturn]] void refuse(const fs::path& path, const std::string& message)
{
  throw InputError("output folder " + path.string() + ": " + message);
}

bool is_own_file(const fs::path& name)
{
  return std::find(own_files.begin(), own_files.end(), name.string()) != own_files.end() ||
         dem::is_checkpoint_name(name);
}

/// particles_0012.vtp and the like.
bool is_own_field(const fs::path& name)
{
  static const std::regex frame(
      "(particles|bonds|pile)_[0-9]{4,}\\.vtp|far_field_[0-9]{4,}\\.vtu");
  return std::regex_match(name.string(), frame);
}

/// The name that was meant when a run stopped before it could rename its temporary file:
/// history.csv for .history.partial.csv; else the name itself.
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

OutputFolder::OutputFolder(fs::path folder, Earlier earlier)
    : folder_(std::move(folder)), earlier_(earlier)
{
}

std::vector<fs::path> OutputFolder::left_by_earlier_run() const
{
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path name = entry->path().filename();
    // a link counts as the link, never as what it points to
    const bool is_folder = fs::is_directory(fs::symlink_status(entry->path()));
    if (!is_folder && (name == own_folder || is_own_file(final_name(name))))
      found.push_back(entry->path());
    if (is_folder && name == own_folder)
      for (const fs::directory_entry& field : fs::directory_iterator(entry->path()))
        if (!field.is_directory() && is_own_field(final_name(field.path().filename())))
          found.push_back(field.path());
  }
  std::error_code unknown;
  if (error && fs::exists(folder_, unknown))
    refuse(folder_, "cannot be read: " + error.message() + ".");
  std::sort(found.begin(), found.end()); // the order of a folder is arbitrary
  return found;
}

void OutputFolder::check(const std::vector<fs::path>& inputs) const
{
  if (folder_.empty())
    throw InputError("output folder: no name is given. Use --output DIR.");

  // the folder itself or, if it is yet to be made, the nearest that is there
  fs::path there = fs::absolute(folder_).lexically_normal();
  std::error_code error;
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
    refuse(folder_, in_quotes(there.string()) + " is in its way and is no folder" + remedy);
  }
  if (::access(there.c_str(), W_OK | X_OK) != 0)
    refuse(folder_, "cannot be written: " + std::generic_category().message(errno) +
                        " at \"" + there.string() +
                        "\". Choose another folder with --output.");

  const std::vector<fs::path> earlier = left_by_earlier_run();
  if (earlier.empty() || earlier_ == Earlier::go_on) return;
  if (earlier_ == Earlier::keep)
    refuse(folder_, "holds an earlier run (" +
                        earlier.front().lexically_relative(folder_).string() +
                        "). Choose another folder with --output, or replace that run with "
                        "--overwrite.");
  for (const fs::path& old : earlier)
    for (const fs::path& input : inputs) {
      if (input.empty()) continue;
      const fs::path relative =
          fs::weakly_canonical(input).lexically_relative(fs::weakly_canonical(old));
      if (!relative.empty() && *relative.begin() != "..")
        refuse(folder_, "--overwrite would remove " + input.string() +
                            ", which this run reads. Choose another folder with --output.");
    }
}

void OutputFolder::commit(const std::vector<fs::path>& inputs) const
{
  check(inputs);
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) refuse(folder_, "cannot be created: " + error.message() + ".");
  if (earlier_ == Earlier::go_on) return;
  for (const fs::path& old : left_by_earlier_run()) {
    fs::remove(old, error); // removes a link, not what it points to
    if (error)
      refuse(folder_, old.filename().string() +
                          " of an earlier run cannot be removed: " + error.message() + ".");
  }
  const fs::path fields = folder_ / own_folder;
  if (fs::is_directory(fs::symlink_status(fields)) && fs::is_empty(fields))
    fs::remove(fields, error);
}

void OutputFolder::cut_back(std::size_t n_frames, std::uint64_t step) const
{
  const std::string last = dem::checkpoint_name(step);
  std::error_code ignored; // what stays is written again, alike
  for (const fs::path& file : left_by_earlier_run()) {
    const fs::path name = file.filename();
    bool goes = final_name(name) != name || name == "summary.json";
    if (dem::is_checkpoint_name(name))
      goes = name.string().size() > last.size() ||
             (name.string().size() == last.size() && name.string() > last);
    else if (is_own_field(name)) {
      const std::string stem = name.stem().string();
      goes = std::stoull(stem.substr(stem.rfind('_') + 1)) >= n_frames;
    }
    if (goes) fs::remove(file, ignored);
  }
}

} // namespace mergel::apps
