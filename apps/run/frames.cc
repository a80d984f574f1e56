#include "apps/run/frames.h"

#include "dem/error.h"
#include "dem/io/atomic_file.h"

#include <cstdio>

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

} // namespace

void copy_atomically(const std::filesystem::path& from, const std::filesystem::path& to)
{
  dem::replace_file(to, [&](const std::filesystem::path& path) {
    std::filesystem::copy_file(from, path,
                               std::filesystem::copy_options::overwrite_existing);
  });
}

Frames::Frames(const std::filesystem::path& folder, std::vector<Kind> kinds,
               std::vector<double> times)
    : fields_(folder / "fields"), kinds_(std::move(kinds)), times_(std::move(times))
{
  for (const Kind& kind : kinds_) {
    std::vector<dem::SeriesEntry> entries;
    for (const double time : times_)
      entries.push_back(
          {time, std::filesystem::path("fields") / frame_name(kind, entries.size())});
    series_.emplace_back(folder / (std::string(kind.name) + ".pvd"), std::move(entries));
  }
}

Frames::Frames(const std::filesystem::path& folder, std::vector<Kind> kinds)
    : Frames(folder, std::move(kinds), std::vector<double>{})
{
}

Frames::Frames(const std::filesystem::path& folder, std::vector<Kind> kinds,
               const std::filesystem::path& earlier, const dem::State& state)
    : Frames(folder, std::move(kinds), times_in(state))
{
  if (!times_.empty() && !std::filesystem::equivalent(folder, earlier)) {
    std::filesystem::create_directories(fields_);
    for (const Kind& kind : kinds_)
      for (std::size_t k = 0; k < times_.size(); ++k)
        copy_atomically(earlier / "fields" / frame_name(kind, k),
                        fields_ / frame_name(kind, k));
  }
  for (const dem::Series& series : series_) series.write();
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

void Frames::check(const std::filesystem::path& folder, const std::vector<Kind>& kinds,
                   const dem::State& state)
{
  for (const Kind& kind : kinds)
    for (std::size_t k = 0; k < count(state); ++k) {
      const auto file = folder / "fields" / frame_name(kind, k);
      require(std::filesystem::is_regular_file(file),
              file.string() + ": is missing, so the series cannot be continued. Put it "
                              "back.");
    }
}

} // namespace mergel::apps
