/// mergel compare: several element and triaxial tests in one table, with the lines through
/// them.
#include "apps/case/words.h"
#include "apps/compare/tests_table.h"
#include "apps/run/command_line.h"
#include "apps/run/jobs.h"
#include "apps/run/provenance.h"
#include "apps/run/ranks.h"
#include "dem/error.h"
#include "dem/io/atomic_file.h"
#include "dem/io/readable.h"

#include <algorithm>
#include <cerrno>
#include <iostream>
#include <ostream>
#include <set>
#include <system_error>

#include <unistd.h>

namespace mergel::apps {

namespace {

namespace fs = std::filesystem;

struct CompareOptions {
  std::vector<std::string> folders, labels;
  fs::path output; ///< empty: the table is printed only
  bool overwrite = false;
  std::vector<std::string> command; ///< its words
};

const std::vector<std::string> files{"tests.csv", "tests.json"};
/// With which each of them begins, in every version.
const std::vector<std::string> first_words{"test,kind,", "{\n  \"tests\": ["};

/// Refuse a file that is there, unless mergel compare has written it and it may be replaced.
void check_place(const fs::path& file, const std::string& first, bool overwrite)
{
  std::error_code error;
  if (!fs::exists(fs::symlink_status(file, error))) return;
  const std::string at = "mergel compare: " + file.string() + ": exists";
  require(dem::begins_with(file, first),
          at + ", and mergel compare has not written it. Move it away, or take another "
               "--output.");
  require(overwrite, at + ". Take --overwrite to replace it, or another --output.");
}

/// Nothing is written before all that is wrong has been found.
void check_output(const CompareOptions& o)
{
  if (o.output.empty()) return;
  std::error_code error;
  for (std::size_t k = 0; k < files.size(); ++k)
    check_place(o.output / files[k], first_words[k], o.overwrite);
  fs::create_directories(o.output, error);
  std::error_code ignored;
  require(fs::is_directory(o.output, ignored),
          "mergel compare: --output " + o.output.string() + ": cannot be made a folder" +
              (error ? " (" + error.message() + ")" : "") + ". Choose another.");
  if (::access(o.output.c_str(), W_OK | X_OK) != 0)
    throw InputError("mergel compare: --output " + o.output.string() +
                     ": cannot be written: " + std::generic_category().message(errno) +
                     ". Choose another.");
}

std::vector<std::string> checked_labels(const CompareOptions& o)
{
  std::set<fs::path> seen;
  std::error_code error; // a folder that cannot be reached is refused where it is read
  for (const std::string& folder : o.folders)
    require(!fs::is_directory(folder, error) || seen.insert(fs::canonical(folder)).second,
            "mergel compare: " + folder + ": is given twice. Leave one out.");
  if (o.labels.empty()) return folder_labels(o.folders);
  require(o.labels.size() == o.folders.size(),
          "mergel compare: --label: given " + std::to_string(o.labels.size()) +
              " times for " + std::to_string(o.folders.size()) +
              " folder(s): must be given once for each, in their order, or not at all.");
  return o.labels;
}

int run_compare(const CompareOptions& o)
{
  const Provenance made = provenance(o.command);
  on_first_rank([&] {
    const auto labels = checked_labels(o);
    const TestSeries series = read_series_of_tests(o.folders, labels);
    check_output(o);
    print(std::cout, series);
    if (o.output.empty()) return;
    // Its remark stands last: a reader takes the first line for the heading.
    dem::replace_file(o.output / files[0], csv_of(series) + made.remark());
    dem::replace_file(o.output / files[1], json_of(series, made.json()));
    std::cout << (o.output / files[0]).string() << '\n'
              << (o.output / files[1]).string() << '\n';
  });
  return 0;
}

} // namespace

void help_compare(std::ostream& out)
{
  out << "  DIR...         results folders of mergel element and mergel triaxial\n"
         "  --output DIR   folder for tests.csv and tests.json; without it the table is "
         "printed only\n"
         "  --overwrite    replace these files there, if mergel compare has written them\n"
         "  --label TEXT   name of a test, once for each DIR in their order; default the "
         "names of the folders\n\n"
         "A row for each test: confining pressure, moduli, yield, peak and the minimum "
         "after "
         "it, the state at\nthe end. Runs that differ only by seed have their mean and its "
         "standard error below. Then cohesion\nand friction angle at the peak and in the "
         "critical state, and the critical state line; where they\nmean nothing, the "
         "reason. "
         "mergel-view DIR... draws them.\n";
}

std::function<int()> read_compare(const std::vector<std::string>& arguments)
{
  CLI::App app;
  CompareOptions o;
  o.command = {"mergel", "compare"};
  o.command.insert(o.command.end(), arguments.begin(), arguments.end());
  app.add_option("DIR", o.folders)->required();
  app.add_option("--output", o.output);
  app.add_flag("--overwrite", o.overwrite);
  app.add_option("--label", o.labels)->allow_extra_args(false);
  parse(app, "mergel compare", arguments);
  return [o] { return run_compare(o); };
}

} // namespace mergel::apps
