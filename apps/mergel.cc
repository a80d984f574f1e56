/// The program: reads the command line, starts MPI, runs one job.

#include "apps/case/walltime.h"
#include "apps/case/words.h"
#include "apps/help/completion.h"
#include "apps/help/man_page.h"
#include "apps/help/pager.h"
#include "apps/help/pages.h"
#include "apps/run/checkpoint_scheduler.h"
#include "apps/run/command_line.h"
#include "apps/run/jobs.h"
#include "apps/run/ranks.h"
#include "apps/run/restart.h"
#include "apps/run/run_guard.h"
#include "apps/run/signals.h"
#include "dem/error.h"
#include "dem/io/standard_output.h"
#include "dem/parallel/mpi_session.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace mergel;
using namespace mergel::apps;

std::vector<std::string> jobs_with_checkpoints()
{
  std::vector<std::string> names;
  for (const Job& job : jobs)
    if (job.writes_checkpoints) names.push_back(job.name);
  return names;
}

/// @param command_line whole, with the name of program and job @throws InputError
JobOptions parse_case(const Job& job, const std::vector<std::string>& command_line)
{
  JobOptions options;
  options.job = job.name;
  options.command = command_line;
  std::vector<std::string> arguments(command_line.begin() + 2, command_line.end());
  CLI::App app;
  app.add_option("CASE.prm", options.case_file);
  app.add_option("--set", options.set)->expected(1)->take_all();
  app.add_option("--output", options.output);
  app.add_flag("--overwrite", options.overwrite);
  app.add_option("--restart", options.restart);
  std::string walltime;
  app.add_option("--walltime", walltime);
  const std::string command = "mergel " + std::string(job.name);
  parse(app, command, std::move(arguments));
  require(!options.case_file.empty() || !options.restart.empty(),
          command + ": no case file is given. See " + command + " --help.");
  if (!walltime.empty()) {
    require(job.writes_checkpoints,
            command + ": --walltime " + walltime + ": the job writes no checkpoints and " +
                "cannot stop in time; jobs that can are " +
                joined(jobs_with_checkpoints(), ", ") +
                ". Leave the option out; --restart begins the job again.");
    options.walltime = to_walltime(walltime);
  }
  if (options.output.empty() && !options.restart.empty())
    options.output = folder_to_restart(options.restart);
  if (options.output.empty())
    options.output = std::filesystem::path("results") / options.case_file.stem();
  return options;
}

bool has(const std::vector<std::string>& words, const std::string& word)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// What is no job: `help`, `version` and their relatives. @return whether it was one
bool show_page(const std::string& first, const std::vector<std::string>& rest)
{
  const auto at_most = [&](std::size_t n) {
    require(rest.size() <= n, "mergel " + first + ": \"" +
                                  (rest.empty() ? "" : rest.back()) +
                                  "\" is one word too many. See mergel --help.");
  };
  if (first == "help" && !rest.empty()) {
    at_most(1);
    show(help_of(find_job(rest.front())));
  } else if (first == "help" || first == "--help" || first == "-h") {
    at_most(0);
    show(help_of_program());
  } else if (first == "version" || first == "--version" || first == "-V") {
    at_most(0);
    show(version_text());
  } else if (first == "man") {
    at_most(1);
    show(rest.empty() ? man_page() : man_page(find_job(rest.front())));
  } else if (first == "completion") {
    at_most(1);
    require(!rest.empty() && rest.front() == "bash",
            "mergel completion: the shell must be given, and is bash: mergel completion "
            "bash.");
    show(bash_completion());
  } else
    return false;
  return true;
}

/// --help, --help --json and --template. @return whether one was given
bool show_page(const Job& job, const std::vector<std::string>& arguments)
{
  const bool asks_help = has(arguments, "--help") || has(arguments, "-h");
  if (asks_help)
    show(has(arguments, "--json") ? json_of(job) : help_of(job));
  else if (has(arguments, "--template"))
    show(template_of(job));
  else if (has(arguments, "--json"))
    throw InputError("mergel " + std::string(job.name) +
                     ": --json belongs to --help: mergel " + job.name + " --help --json.");
  else
    return false;
  return true;
}

int run(int argc, char** argv)
{
  const std::vector<std::string> command_line(argv, argv + argc);
  const std::string first = argc < 2 ? "" : command_line[1];
  if (first.empty()) {
    if (launched_rank() <= 0) std::cerr << help_of_program() << '\n';
    throw InputError("mergel: no job is given. See mergel --help.");
  }
  const std::vector<std::string> rest(command_line.begin() + 2, command_line.end());
  if (show_page(first, rest)) return exit_done;
  if (first.starts_with('-'))
    throw InputError("mergel: \"" + first +
                     "\" comes before the name of the job. See mergel --help.");

  const Job& job = find_job(first);
  if (show_page(job, rest)) return exit_done;
  std::function<int()> start;
  if (job.reads_case())
    start = [run = std::get<RunCase>(job.run), options = parse_case(job, command_line)] {
      JobOptions agreed = options;
      std::string output = options.output.string(); // as found by the first rank
      share(output);
      agreed.output = output;
      return run(agreed);
    };
  else
    start = [run = std::get<ReadArguments>(job.run)(rest)] {
      const int code = run();
      on_first_rank([] { dem::require_printed(); });
      return code;
    };

  const dem::MpiSession mpi;
  ignore_signals_again();
  return run_guarded(start);
}

} // namespace

int main(int argc, char** argv)
{
  dem::hold_standard_descriptors();
  ignore_signals();
  // Only the first rank prints to the user.
  if (launched_rank() > 0) std::cout.setstate(std::ios::badbit);
  return run_guarded([&] { return run(argc, argv); });
}
