/// mergel info: describes a sample, a checkpoint or a results folder, and checks that it is
/// complete.
#include "apps/brazilian/brazilian_output.h"
#include "apps/case/case_scan.h"
#include "apps/case/job_of_case.h"
#include "apps/case/words.h"
#include "apps/element/element_output.h"
#include "apps/element/element_pictures.h"
#include "apps/pile/pile_output.h"
#include "apps/run/command_line.h"
#include "apps/run/folder_lock.h"
#include "apps/run/jobs.h"
#include "apps/run/output_folder.h"
#include "apps/run/ranks.h"
#include "apps/run/results.h"
#include "apps/run/tables.h"
#include "apps/triaxial/triaxial_output.h"
#include "dem/io/readable.h"
#include "dem/io/sample_file.h"
#include "dem/io/state/checkpoint.h"
#include "dem/io/table.h"
#include "dem/text.h"

#include <boost/property_tree/json_parser.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

namespace mergel::apps {

namespace {

namespace fs = std::filesystem;

void line(const std::string& name, const std::string& value)
{
  std::string padded = name;
  padded.resize(std::max<std::size_t>(name.size(), 12), ' ');
  std::cout << "  " << padded << ' ' << printable(value) << '\n';
}

std::string megabytes(double bytes)
{
  return dem::shortest(std::floor(1e-2 * bytes) / 1e4) + " MB";
}

std::string size_text(const fs::path& file)
{
  return megabytes(static_cast<double>(fs::file_size(file)));
}

boost::property_tree::ptree read_json(const fs::path& file)
{
  dem::require_readable(file);
  boost::property_tree::ptree tree;
  boost::property_tree::read_json(file.string(), tree);
  return tree;
}

/// @throws InputError
void describe_checkpoint(const fs::path& file)
{
  const dem::Checkpoint c = dem::read_checkpoint(file);
  const auto rows = [&](const char* name) {
    const auto found = c.state.arrays().find(name);
    return found == c.state.arrays().end() ? 0 : found->second.rows();
  };
  std::cout << printable(file.string()) << ": checkpoint\n";
  line("job", "mergel " + c.label.job + ", " + c.label.phase);
  line("step", std::to_string(c.label.step));
  line("time", dem::shortest(1e3 * c.label.time) + " ms");
  line("particles", std::to_string(rows("grains")));
  line("bonds",
       std::to_string(rows("bond_pairs")) + " between particles, " +
           std::to_string(c.state.get<std::uint64_t>("bonds_broken_and_yielded")[0]) +
           " of all bonds broken");
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
  std::cout << printable(file.string()) << ": sample\n";
  line("particles", std::to_string(s.packing.particles.size()));
  line("bonds", std::to_string(s.bonding.pairs.size()) + " between particles");
  line("porosity", dem::shortest(s.packing.porosity) + " in the core, " +
                       dem::shortest(s.packing.whole_porosity) + " in the whole region");
  for (const auto& [key, value] : s.recipe) line(key, value);
  line("health", "good, checksum right, " + size_text(file));
}

/// Message on a file that cannot be used, or "".
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

/// "failure" of failed.json, which a run that became unstable leaves; nothing without the
/// file.
std::optional<std::string> failure_in(const fs::path& folder)
{
  std::error_code error;
  if (!fs::exists(folder / "failed.json", error)) return {};
  try {
    return read_json(folder / "failed.json").get<std::string>("failure");
  } catch (const InputError& e) {
    return e.what();
  } catch (const std::exception& e) {
    return std::string("failed.json cannot be read: ") + e.what();
  }
}

std::string state_of(const fs::path& folder, bool is_complete)
{
  if (const auto failure = failure_in(folder)) return "failed: " + *failure;
  std::error_code error;
  if (!fs::exists(folder / "summary.json", error)) return "not finished";
  return is_complete ? "finished" : "incomplete";
}

/// Whether a VTK file has its closing tag.
bool is_whole_vtk(const fs::path& file)
{
  constexpr std::streamoff n = 32;
  const std::string end = "</VTKFile>";
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? std::streamoff(in.tellg()) : 0;
  in.seekg(std::max<std::streamoff>(0, size - n));
  const std::string tail{std::istreambuf_iterator<char>(in), {}};
  return tail.find(end) != std::string::npos;
}

/// Lines on results before this checkpoint that the folder lacks.
/// @throws InputError when its history is another one
std::string lacks_before(const fs::path& folder, const dem::Checkpoint& c)
{
  if (c.label.job == "pile") return PileOutput::check(folder, c.state);
  if (c.label.job == "brazilian") return BrazilianOutput::check(folder, c.state);
  if (c.label.job == "triaxial") {
    CaseFile file;
    TriaxialCase own;
    declare(file, own);
    file.read_text(c.label.case_text, "its case");
    return TriaxialOutput::check(folder, own, c.state);
  }
  if (c.label.job != "element") return "";
  return ElementHistory::check(folder / "history.csv", c.state) +
         ElementPictures::check(folder, c.state);
}

/// "history.csv is cut"; "" where nothing is wrong.
std::string with_name(const std::string& name, const std::string& wrong)
{
  return wrong.empty() ? "" : name + " " + wrong;
}

/// The report on a results folder.
class FolderReport {
public:
  explicit FolderReport(const fs::path& folder)
      : folder_(folder), own_(own_files_in(folder)), job_(job_of(folder)),
        is_finished_(has("summary.json"))
  {
    if (own_.files.empty() && !FolderLock::is_known(folder))
      throw InputError("mergel info " + folder.string() +
                       ": is no results folder: it holds no file of mergel. Name the "
                       "results folder of a run, a sample or a checkpoint.");
  }

  /// False when a file in it cannot be used.
  bool print()
  {
    for (const std::string& name : missing_files()) judge_result("missing", name, "");
    if (const std::string holder = FolderLock::holder(folder_); !holder.empty())
      say("now", holder + " is writing there");
    describe_case();
    describe_history();
    describe_other_tables();
    describe_sample_file();
    describe_frames();
    describe_summary();
    describe_checkpoints();
    std::cout << printable(folder_.string()) << ": results folder, "
              << state_of(folder_, is_whole_) << '\n';
    for (const auto& [name, value] : lines_) line(name, value);
    return is_good_;
  }

private:
  bool has(const char* name) const
  {
    std::error_code error; // the folder itself can be reached: own_files_in()
    return fs::exists(folder_ / name, error);
  }
  void say(const std::string& name, const std::string& value)
  {
    lines_.emplace_back(name, value);
  }
  void judge(const std::string& name, const std::string& wrong, const std::string& good)
  {
    is_good_ = is_good_ && wrong.empty();
    say(name, wrong.empty() ? good : wrong);
  }
  /// The same of what a finished run has to hold.
  void judge_result(const std::string& name, const std::string& wrong,
                    const std::string& good)
  {
    is_whole_ = is_whole_ && wrong.empty();
    judge(name, wrong, good);
  }

  std::vector<std::string> missing_files() const
  {
    if (!is_finished_ && !has("failed.json") && own_.frames.empty() &&
        dem::checkpoints_in(folder_).empty())
      return {}; // a run that was ended while it began
    return missing_results(folder_, job_, is_finished_ ? Extent::finished : Extent::begun);
  }

  void describe_case()
  {
    if (!has("resolved.prm")) return;
    std::size_t n_keys = 0;
    const std::string wrong = fault([&] {
      n_keys = scan_case(read_case_text(folder_ / "resolved.prm"), "resolved.prm")
                   .entries.size();
    });
    judge("case", wrong, "resolved.prm, " + std::to_string(n_keys) + " keys");
  }

  /// A table of the run, or what is wrong with it.
  std::pair<dem::Table, std::string> read(const std::string& name) const
  {
    dem::Table table;
    std::string wrong;
    if (is_finished_ || has_line(folder_ / name))
      wrong = with_name(name, lost_heading(folder_ / name, job_));
    if (wrong.empty()) wrong = fault([&] { table = dem::read_table(folder_ / name); });
    if (wrong.find("holds no record") != std::string::npos) wrong.clear();
    return {std::move(table), wrong};
  }

  void describe_history()
  {
    if (!has("history.csv")) return;
    auto [table, wrong] = read("history.csv");
    if (wrong.empty()) wrong = with_name("history.csv", lost_start(table));
    if (wrong.empty() && is_finished_)
      wrong = with_name("history.csv", lost_end(table, folder_));
    std::string last;
    if (table.n_rows > 0)
      last = ", the last at " + table.columns.front().name + " " +
             dem::shortest(table.columns.front().values.back()) + " " +
             table.columns.front().unit;
    judge_result("history", wrong,
                 std::to_string(table.n_rows) + " records" + last +
                     (table.is_last_line_cut ? "; a line is cut" : "") +
                     (begins_at_checkpoint(table)
                          ? "; begins at a checkpoint, the records before it are missing"
                          : ""));
  }

  /// Only those with a fault.
  void describe_other_tables()
  {
    for (const std::string& name : tables_of(job_)) {
      if (name == "history.csv" || !has(name.c_str())) continue;
      auto [table, wrong] = read(name);
      if (wrong.empty() && is_finished_ && table.is_last_line_cut)
        wrong = name + " is cut: its last line is not whole";
      if (!wrong.empty()) judge_result("table", wrong, "");
    }
  }

  void describe_sample_file()
  {
    if (!has("sample.h5")) return;
    dem::Sample s;
    const std::string wrong = fault([&] { s = dem::read_sample(folder_ / "sample.h5"); });
    judge_result("sample", wrong.empty() ? "" : "sample.h5 " + wrong,
                 std::to_string(s.packing.particles.size()) + " particles, " +
                     std::to_string(s.bonding.pairs.size()) + " bonds, good");
  }

  void describe_frames()
  {
    if (own_.frames.empty()) return;
    std::string wrong;
    for (const fs::path& frame : own_.frames)
      if (wrong.empty())
        wrong = fault([&] {
          require(!dem::is_readable(frame) || is_whole_vtk(frame),
                  frame.string() + ": is cut");
        });
    judge_result("fields", wrong,
                 std::to_string(own_.frames.size()) + " files, none is cut");
  }

  void describe_summary()
  {
    if (!has("summary.json")) return;
    std::string wrong;
    try {
      const auto tree = read_json(folder_ / "summary.json");
      if (const auto made = tree.get_child_optional("made by"))
        say("made by", made->get("program", "?") + ", " + made->get("date", "?") + " on " +
                           made->get("host", "?") + ", ranks: " + made->get("ranks", "?"));
    } catch (const InputError& e) {
      wrong = e.what();
    } catch (const std::exception& e) {
      wrong = std::string("summary.json cannot be read: ") + e.what();
    }
    judge("summary", wrong, "summary.json, good");
  }

  void describe_checkpoints()
  {
    bool is_newest = true, has_any = false;
    for (const fs::path& file : dem::checkpoints_in(folder_)) {
      dem::Checkpoint c;
      const std::string wrong = fault([&] { c = dem::read_checkpoint(file); });
      if (!wrong.empty() && !fs::exists(fs::symlink_status(file)))
        continue; // a run has removed it meanwhile
      has_any = true;
      judge("checkpoint", wrong.empty() ? "" : file.filename().string() + " " + wrong,
            file.filename().string() + ", " + c.label.phase + ", step " +
                std::to_string(c.label.step) +
                ", t = " + dem::shortest(1e3 * c.label.time) + " ms, mergel " +
                c.label.program + ", good");
      if (!wrong.empty()) continue;
      if (is_newest) {
        std::string lacks;
        if (const std::string other = fault([&] { lacks = lacks_before(folder_, c); });
            !other.empty())
          judge_result("restart", other, "");
        std::istringstream lines(lacks);
        for (std::string text; std::getline(lines, text);) say("restart", text);
      }
      is_newest = false;
    }
    if (!has_any) say("checkpoints", "none");
    double bytes = 0.0;
    for (const fs::path& file : own_.aside) {
      std::error_code gone;
      const auto size = fs::file_size(file, gone);
      if (!gone) bytes += static_cast<double>(size);
    }
    if (!own_.aside.empty())
      say("set aside", std::to_string(own_.aside.size()) + " checkpoints (*.aside), " +
                           megabytes(bytes));
  }

  const fs::path folder_;
  const OwnFiles own_;
  const std::string job_;
  const bool is_finished_;
  std::vector<std::pair<std::string, std::string>> lines_; ///< name and value
  bool is_good_ = true;                                    ///< nothing is damaged
  bool is_whole_ = true;                                   ///< no result is missing or cut
};

int run_info(const fs::path& path)
{
  bool is_good = true;
  on_first_rank([&] {
    std::error_code error; // what cannot be reached is refused where it is read
    if (fs::is_directory(path, error)) {
      is_good = FolderReport(path).print();
      return;
    }
    std::string as_checkpoint, as_sample;
    as_checkpoint = fault([&] { describe_checkpoint(path); });
    if (as_checkpoint.empty()) return;
    as_sample = fault([&] { describe_sample(path); });
    if (as_sample.empty()) return;
    CaseScan scan;
    const bool is_text =
        fault([&] { scan = scan_case(read_case_text(path), path.string()); }).empty();
    if (is_text && !scan.sections.empty())
      throw InputError("mergel info " + path.string() + ": is a case of mergel " +
                       name_of(job_of_case(scan, {})) + ". `mergel check " +
                       in_shell(path.string()) + "` reads it.");
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
         "The report on a folder also names the run that is writing there, the failure of "
         "a run,\ncheckpoints that were set aside, and files that are missing or cut: then "
         "a run that has ended\nis called incomplete.\n"
         "Exit code 1 when a file is damaged, missing or not written by mergel.\n";
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
