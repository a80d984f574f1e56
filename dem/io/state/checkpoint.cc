#include "dem/io/state/checkpoint.h"

#include "dem/io/seal.h"

#include <algorithm>
#include <cstdio>
#include <regex>
#include <system_error>

namespace mergel::dem {

namespace fs = std::filesystem;

namespace {

// 1: numbers in a fixed order, without names; 2: rigid walls that do not rotate; 3: element and
// triaxial tests without the stress at their start, and records without what breaks in approaches
constexpr int version = 4;
const std::string kind = "checkpoint";

} // namespace

std::string checkpoint_name(std::uint64_t step)
{
  char name[48];
  std::snprintf(name, sizeof name, "checkpoint_%012llu.h5",
                static_cast<unsigned long long>(step));
  return name;
}

bool is_checkpoint_name(const fs::path& name)
{
  static const std::regex form("checkpoint_[0-9]{12,}\\.h5");
  return std::regex_match(name.string(), form);
}

bool is_later(const fs::path& a, const fs::path& b)
{
  const std::string x = a.filename().string(), y = b.filename().string();
  return x.size() != y.size() ? x.size() > y.size() : x > y;
}

void write_checkpoint(const fs::path& file, const CheckpointLabel& label, State mine,
                      const Communicator& comm)
{
  mine.add_text("label_program", label.program);
  mine.add_text("label_job", label.job);
  mine.add_text("label_stage", label.phase);
  mine.add_text("label_case", label.case_text);
  mine.add_common<std::uint64_t>("label_step", {label.step});
  mine.add_common<double>("label_time", {label.time});
  write_state(file, kind, version, mine, comm);
}

Checkpoint read_checkpoint(const fs::path& file)
{
  Checkpoint c;
  c.state = read_state(file, kind, version, &c.sum);
  c.label = {c.state.text("label_program"),
             c.state.text("label_job"),
             c.state.text("label_stage"),
             c.state.text("label_case"),
             c.state.get_rows<std::uint64_t>("label_step", 1).front(),
             c.state.get_rows<double>("label_time", 1).front()};
  return c;
}

std::vector<fs::path> checkpoints_in(const fs::path& folder)
{
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (is_checkpoint_name(entry->path().filename())) found.push_back(entry->path());
  std::sort(found.begin(), found.end(), is_later);
  return found;
}

void keep_newest(const fs::path& written, std::size_t n)
{
  const fs::path folder = written.parent_path().empty() ? "." : written.parent_path();
  std::error_code ignored;
  std::size_t n_kept = 0;
  for (const fs::path& file : checkpoints_in(folder))
    if (!is_later(file, written) && ++n_kept > n) fs::remove(file, ignored);
}

FoundCheckpoint newest_checkpoint(const fs::path& folder)
{
  FoundCheckpoint found;
  for (const fs::path& file : checkpoints_in(folder)) {
    try {
      found.checkpoint = read_checkpoint(file);
      found.file = file;
      break;
    } catch (const DamagedFile& e) {
      found.refused.push_back({file, e.what(), true});
    } catch (const OtherVersion& e) {
      found.refused.push_back({file, e.what(), false, true});
    } catch (const InputError& e) {
      found.refused.push_back({file, e.what(), false});
    }
  }
  return found;
}

} // namespace mergel::dem
