#include "apps/run/frames.h"

#include "apps/run/ranks.h"
#include "dem/error.h"
#include "dem/io/atomic_file.h"

#include <algorithm>
#include <cstdio>
#include <system_error>

namespace mergel::apps {

namespace {

/// particles_0012.vtp
std::string frame_name(const Frames::Kind& kind, std::size_t frame)
{
  char name[64];
  std::snprintf(name, sizeof name, "%s_%04zu.%s", kind.name, frame, kind.extension);
  return name;
}

const std::vector<double>& times_in(const dem::State& state)
{
  return state.get<double>("output_frames");
}

bool is_there(const std::filesystem::path& file)
{
  std::error_code error;
  return std::filesystem::is_regular_file(file, error);
}

/// Copy a file under a temporary name and rename it.
void copy_atomically(const std::filesystem::path& from, const std::filesystem::path& to)
{
  dem::replace_file(to, [&](const std::filesystem::path& path) {
    std::filesystem::copy_file(from, path,
                               std::filesystem::copy_options::overwrite_existing);
  });
}

} // namespace

void copy_specimen(const std::filesystem::path& earlier,
                   const std::filesystem::path& folder)
{
  constexpr const char* name = "sample.h5";
  if (!std::filesystem::equivalent(folder, earlier) && is_there(earlier / name))
    copy_atomically(earlier / name, folder / name);
}

void write_together(const dem::FrameFiles& frame, dem::AssemblyFiles files,
                    const std::function<void()>& others)
{
  for (std::filesystem::path* file : {&files.particles, &files.bonds, &files.contacts}) {
    std::string name = file->string();
    share(name);
    *file = name;
  }
  on_every_rank([&] {
    frame.write(files);
    if (is_first_rank()) others();
  });
}

Frames::Frames(const std::filesystem::path& folder, std::vector<Kind> kinds)
    : fields_(folder / "fields"), kinds_(std::move(kinds))
{
  for (const Kind& kind : kinds_)
    series_.emplace_back(folder / (std::string(kind.name) + ".pvd"));
}

Frames::Frames(const std::filesystem::path& folder, std::vector<Kind> kinds,
               const std::filesystem::path& earlier, const dem::State& state)
    : Frames(folder, std::move(kinds))
{
  times_ = times_in(state);
  const bool is_elsewhere = !std::filesystem::equivalent(folder, earlier);
  if (!times_.empty() && is_elsewhere) std::filesystem::create_directories(fields_);
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    std::vector<dem::SeriesEntry> entries;
    for (std::size_t frame = 0; frame < times_.size(); ++frame) {
      const std::string name = frame_name(kinds_[k], frame);
      if (!is_there(earlier / "fields" / name)) continue;
      if (is_elsewhere) copy_atomically(earlier / "fields" / name, fields_ / name);
      entries.push_back({times_[frame], std::filesystem::path("fields") / name});
    }
    series_[k] = dem::Series(folder / (std::string(kinds_[k].name) + ".pvd"), entries);
    series_[k].write();
  }
}

std::filesystem::path Frames::file(std::size_t kind) const
{
  std::filesystem::create_directories(fields_);
  return fields_ / frame_name(kinds_[kind], times_.size());
}

void Frames::add(double time)
{
  for (std::size_t k = 0; k < kinds_.size(); ++k) series_[k].add(time, file(k));
  times_.push_back(time);
}

void Frames::save(dem::State& state, const Frames* frames)
{
  state.add_common("output_frames", frames ? frames->times_ : std::vector<double>{});
}

std::size_t Frames::count(const dem::State& state)
{
  return state.has("output_frames") ? times_in(state).size() : 0;
}

std::string Frames::check(const std::filesystem::path& folder,
                          const std::vector<Kind>& kinds, const dem::State& state)
{
  std::size_t n_missing = 0;
  for (std::size_t frame = 0; frame < count(state); ++frame)
    n_missing += !std::all_of(kinds.begin(), kinds.end(), [&](const Kind& kind) {
      return is_there(folder / "fields" / frame_name(kind, frame));
    });
  if (n_missing == 0) return "";
  return "of " + std::to_string(count(state)) + " frames before the checkpoint " +
         std::to_string(n_missing) + " are missing in " + (folder / "fields").string() +
         ": the series (.pvd) list the others\n";
}

} // namespace mergel::apps
