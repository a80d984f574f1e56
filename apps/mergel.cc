/// The program: reads the command line, starts MPI, runs one job.

#include "apps/case/walltime.h"
#include "apps/case/words.h"
#include "apps/run/checkpoint_scheduler.h"
#include "apps/run/command_line.h"
#include "apps/run/jobs.h"
#include "apps/run/ranks.h"
#include "apps/run/restart.h"
#include "apps/run/run_guard.h"
#include "apps/run/signals.h"
#include "apps/run/standard_output.h"
#include "dem/error.h"
#include "fem/runtime.h"

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

void print_help(std::ostream& out)
{
  out << "mergel: coupled DEM-FEM solver for weak, porous, bonded rock.\n\n"
         "usage: mergel <job> CASE.prm [--set \"Section/key=value\"]... [--output DIR] "
         "[--overwrite]\n       mergel <job> [CASE.prm] --restart DIR [--walltime 4h]\n"
         "       mergel bench [options]\n       mergel compare DIR...\n       mergel info "
         "PATH\n\njobs:\n";
  for (const Job& job : jobs) {
    std::string name = job.name;
    name.resize(std::max<std::size_t>(name.size(), 9), ' ');
    out << "  " << name << "  " << job.sentence << "\n";
  }
  out << "\nexample:\n"
         "  mergel pile apps/cases/pile_small.prm --set \"Pile/friction=0.3\" --output "
         "results/rough\n\n"
         "mergel <job> --help prints every key of its case; mergel --version the "
         "version.\n";
}

const char* const help_on_checkpoints =
    R"(  --restart DIR|FILE         continue a run from the newest good checkpoint of its
                             results folder, or from this checkpoint; begin a run where
                             there is none yet; take a finished run further, where the
                             case has a later end. CASE.prm may be left out
  --walltime TIME            write a checkpoint and stop before this time is over (4h,
                             30 min, 4:00:00, 1-12:00:00)

SIGUSR1 makes the run write a checkpoint. SIGTERM, Ctrl-C (SIGINT) and a closed terminal
(SIGHUP) make it write one and stop, exit code 2; a second Ctrl-C ends it at once.

)";
const char* const help_without_checkpoints =
    R"(  --restart DIR              begin again in the results folder of a run that did not
                             finish; CASE.prm may be left out

The job writes no checkpoints: SIGTERM, SIGINT and SIGHUP end it at once, and --walltime is
refused. A repeated run gives the same results, bit for bit.

)";

void print_job_help(const Job& job, std::ostream& out)
{
  out << "mergel " << job.name << ": " << job.sentence << "\n\nusage: mergel " << job.name;
  if (!job.reads_case()) {
    out << " [options]\n";
    job.help(out);
    return;
  }
  out << " CASE.prm [options]\n"
         "  --set \"Section/key=value\"  override a key of the case file; may be repeated\n"
         "  --output DIR               results folder; default results/<name of the case>\n"
         "  --overwrite                replace an earlier run in that folder\n";
  out << (job.writes_checkpoints ? help_on_checkpoints : help_without_checkpoints);
  out << "Keys of CASE.prm, by section. A value is written with its unit; any unit of its "
         "dimension is\naccepted.\n\n";
  job.help(out);
}

const Job& find_job(const std::string& name)
{
  std::vector<std::string> names;
  for (const Job& job : jobs) {
    if (name == job.name) return job;
    names.push_back(job.name);
  }
  const std::string meant = nearest(name, names);
  throw InputError("mergel: unknown job \"" + name + "\". " +
                   (meant.empty() ? "Jobs are " + joined(names, ", ") + "."
                                  : "Did you mean \"" + meant + "\"?"));
}

std::vector<std::string> jobs_with_checkpoints()
{
  std::vector<std::string> names;
  for (const Job& job : jobs)
    if (job.writes_checkpoints) names.push_back(job.name);
  return names;
}

/// @throws InputError, or CLI::CallForHelp
JobOptions parse_case(const Job& job, std::vector<std::string> arguments)
{
  JobOptions options;
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

int run(int argc, char** argv)
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const std::string first = arguments.empty() ? "" : arguments.front();
  if (first == "--help" || first == "-h") {
    print_help(std::cout);
    if (launched_rank() <= 0) require_printed();
    return exit_done;
  }
  if (first == "--version") {
    std::cout << "mergel " MERGEL_VERSION "\n";
    if (launched_rank() <= 0) require_printed();
    return exit_done;
  }
  if (first.empty()) throw InputError("mergel: no job is given. See mergel --help.");
  if (first.starts_with('-'))
    throw InputError("mergel: \"" + first +
                     "\" comes before the name of the job. See mergel --help.");

  const Job& job = find_job(first);
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  std::function<int()> start;
  try {
    if (job.reads_case())
      start = [run = std::get<RunCase>(job.run), options = parse_case(job, rest)] {
        JobOptions agreed = options;
        std::string output = options.output.string(); // as found by the first rank
        share(output);
        agreed.output = output;
        return run(agreed);
      };
    else
      start = [run = std::get<ReadArguments>(job.run)(rest)] {
        const int code = run();
        on_first_rank([] { require_printed(); });
        return code;
      };
  } catch (const CLI::CallForHelp&) {
    print_job_help(job, std::cout);
    if (launched_rank() <= 0) require_printed();
    return exit_done;
  }

  fem::Runtime runtime(argc, argv);
  ignore_signals_again();
  return run_guarded(start);
}

} // namespace

int main(int argc, char** argv)
{
  hold_standard_descriptors();
  ignore_signals();
  // Only the first rank prints to the user.
  if (launched_rank() > 0) std::cout.setstate(std::ios::badbit);
  return run_guarded([&] { return run(argc, argv); });
}
