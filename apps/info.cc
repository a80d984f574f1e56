/// mergel info: what a sample, a checkpoint or a results folder is, and whether it is
/// whole.
#include "apps/case_scan.h"
#include "apps/command_line.h"
#include "apps/jobs.h"
#include "apps/ranks.h"
#include "dem/io/checkpoint.h"
#include "dem/io/history.h"
#include "dem/io/sample_file.h"
#include "dem/io/table.h"

#include <iostream>

namespace mergel::apps {

namespace {

namespace fs = std::filesystem;

void line(const std::string& name, const std::string& value)
{
  std::string padded = name;
  padded.resize(std::max<std::size_t>(name.size(), 12), ' ');
  std::cout << "  " << padded << ' ' << value << '\n';
}

std::string size_text(const fs::path& file)
{
  return dem::shortest(1e-3 * static_cast<double>(fs::file_size(file) / 100) / 10.0) +
         " MB";
}

/// @throws InputError
void describe_checkpoint(const fs::path& file)
{
  const dem::Checkpoint c = dem::read_checkpoint(file);
  const auto rows = [&](const char* name) {
    const auto found = c.state.arrays().find(name);
    return found == c.state.arrays().end() ? 0 : found->second.rows();
  };
  std::cout << file.string() << ": checkpoint\n";
  line("job", "mergel " + c.label.job + ", " + c.label.stage);
  line("step", std::to_string(c.label.step));
  line("time", dem::shortest(1e3 * c.label.time) + " ms");
  line("particles", std::to_string(rows("grains")));
  line("bonds",
       std::to_string(rows("bond_pairs")) + " between grains, " +
           std::to_string(c.state.get<std::uint64_t>("bonds_broken_and_yielded")[0]) +
           " of all broken");
  line("contacts", std::to_string(rows("contact_pairs")) + " with shear");
  line("case", std::to_string(scan_case(c.label.case_text, "its case").entries.size()) +
                   " keys, inside");
  line("written by", "mergel " + c.label.program);
  line("health", "good, checksum right, " + size_text(file));
}

/// @throws InputError
void describe_sample(const fs::path& file)
{
  const dem::Sample s = dem::read_sample(file);
  std::cout << file.string() << ": sample\n";
  line("particles", std::to_string(s.packing.particles.size()));
  line("bonds", std::to_string(s.bonding.pairs.size()) + " between grains");
  line("porosity", dem::shortest(s.packing.porosity) + " in the core, " +
                       dem::shortest(s.packing.whole_porosity) + " in all");
  for (const auto& [key, value] : s.recipe) line(key, value);
  line("health", "good, checksum right, " + size_text(file));
}

/// What is wrong with a file, or "".
template <class Read>
std::string fault(Read&& read)
{
  try {
    read();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

/// False when something in it cannot be used.
bool describe_folder(const fs::path& folder)
{
  bool is_good = true;
  std::cout << folder.string() << ": results folder, "
            << (fs::exists(folder / "summary.json") ? "finished" : "not finished") << '\n';
  const auto judge = [&](const std::string& name, const std::string& wrong,
                         const std::string& good) {
    is_good = is_good && wrong.empty();
    line(name, wrong.empty() ? good : wrong);
  };
  if (fs::exists(folder / "resolved.prm")) {
    std::size_t n_keys = 0;
    const std::string wrong = fault([&] {
      n_keys =
          scan_case(read_case_text(folder / "resolved.prm"), "resolved.prm").entries.size();
    });
    judge("case", wrong, "resolved.prm, " + std::to_string(n_keys) + " keys");
  }
  if (fs::exists(folder / "history.csv")) {
    dem::Table table;
    const std::string wrong =
        fault([&] { table = dem::read_table(folder / "history.csv"); });
    std::string last;
    if (table.n_rows > 0)
      last = ", the last at " + table.columns.front().name + " " +
             dem::shortest(table.columns.front().values.back()) + " " +
             table.columns.front().unit;
    const bool is_empty = wrong.find("holds no record") != std::string::npos;
    judge("history", is_empty ? "" : wrong,
          std::to_string(table.n_rows) + " records" + last +
              (table.is_last_line_cut ? "; a line is cut" : ""));
  }
  if (fs::exists(folder / "sample.h5")) {
    dem::Sample s;
    const std::string wrong = fault([&] { s = dem::read_sample(folder / "sample.h5"); });
    judge("sample", wrong.empty() ? "" : "sample.h5 " + wrong,
          std::to_string(s.packing.particles.size()) + " particles, " +
              std::to_string(s.bonding.pairs.size()) + " bonds, good");
  }
  const auto checkpoints = dem::checkpoints_in(folder);
  if (checkpoints.empty()) line("checkpoints", "none");
  for (const fs::path& file : checkpoints) {
    dem::Checkpoint c;
    const std::string wrong = fault([&] { c = dem::read_checkpoint(file); });
    judge("checkpoint", wrong.empty() ? "" : file.filename().string() + " " + wrong,
          file.filename().string() + ", " + c.label.stage + ", step " +
              std::to_string(c.label.step) + ", t = " + dem::shortest(1e3 * c.label.time) +
              " ms, mergel " + c.label.program + ", good");
  }
  return is_good;
}

int run_info(const fs::path& path)
{
  bool is_good = true;
  on_first_rank([&] {
    if (fs::is_directory(path)) {
      is_good = describe_folder(path);
      return;
    }
    std::string as_checkpoint, as_sample;
    as_checkpoint = fault([&] { describe_checkpoint(path); });
    if (as_checkpoint.empty()) return;
    as_sample = fault([&] { describe_sample(path); });
    if (as_sample.empty()) return;
    const bool is_sample = as_checkpoint.starts_with("is no checkpoint, or") &&
                           !as_sample.starts_with("is no sample");
    throw InputError("mergel info " + path.string() + ": " +
                     (is_sample ? as_sample : as_checkpoint));
  });
  return is_good ? 0 : 1;
}

} // namespace

void help_info(std::ostream& out)
{
  out << "  PATH  a sample, a checkpoint, or the results folder of a run\n\n"
         "Exit code 1 when something there is damaged or no file of mergel.\n";
}

std::function<int()> read_info(const std::vector<std::string>& arguments)
{
  CLI::App app;
  fs::path path;
  app.add_option("PATH", path)->required();
  parse(app, "mergel info", arguments);
  return [path] { return run_info(path); };
}

} // namespace mergel::apps
