#include "apps/help/pages.h"

#include "apps/case/case_forms.h"
#include "apps/case/words.h"
#include "dem/error.h"
#include "dem/version.h"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <sstream>

namespace mergel::apps {

namespace {

const char* const help_on_checkpoints =
    R"(  --restart DIR|FILE         continue a run from the newest good checkpoint of its
                             results folder, or from this checkpoint; begin a run where
                             there is none yet; take a finished run further, where the
                             case has a later end. CASE.prm may be left out
  --walltime TIME            write a checkpoint and stop before this time is over (4h,
                             30 min, 4:00:00, 1-12:00:00)
)";
const char* const help_on_signals =
    R"(SIGUSR1 makes the run write a checkpoint. SIGTERM, Ctrl-C (SIGINT) and a closed terminal
(SIGHUP) make it write one and stop, exit code 2; a second Ctrl-C ends it at once.
)";
const char* const help_on_beginning_again =
    R"(  --restart DIR              begin again in the results folder of a run that did not
                             finish; CASE.prm may be left out
)";
const char* const help_without_checkpoints =
    R"(The job writes no checkpoints: SIGTERM, SIGINT and SIGHUP end it at once, and --walltime is
refused. A repeated run gives the same results, bit for bit.
)";
const char* const help_on_forms =
    R"(  --help                     this page; with --json the keys as JSON
  --template                 a case with every key, to fill in
)";

/// The library that implements MPI, "Open MPI 4.1.4"; it may be asked before MPI_Init.
std::string mpi_library()
{
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string whole(text.data(), static_cast<std::size_t>(length));
  std::string name = whole.substr(0, whole.find_first_of(",\n"));
  if (name.starts_with("Open MPI v")) name.erase(9, 1);
  return name;
}

const Job& with_case(const Job& job, const char* option)
{
  require(job.reads_case(), "mergel " + std::string(job.name) + ": " + option +
                                " is for jobs with a case, and this one has none. See "
                                "mergel " +
                                job.name + " --help.");
  return job;
}

} // namespace

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

std::string help_of_program()
{
  std::string text =
      "mergel: coupled DEM-FEM solver for weak, porous, bonded rock.\n\n"
      "usage: mergel <job> CASE.prm [--set \"Section/key=value\"]... [--output DIR] "
      "[--overwrite]\n       mergel <job> [CASE.prm] --restart DIR [--walltime 4h]\n";
  for (const Job& job : jobs)
    if (!job.reads_case())
      text += "       mergel " + std::string(job.name) + " " + job.arguments + "\n";
  text += "\njobs:\n";
  for (const Job& job : jobs) {
    std::string name = job.name;
    name.resize(std::max<std::size_t>(name.size(), 9), ' ');
    text += "  " + name + "  " + job.sentence + "\n";
  }
  return text +
         "\nexample:\n"
         "  mergel pile apps/cases/pile_small.prm --set \"Pile/friction=0.3\" --output "
         "results/rough\n\n"
         "mergel help <job>, or mergel <job> --help, explains every key of its case;\n"
         "mergel <job> --template prints a case to fill in, mergel version what this "
         "program "
         "is,\nmergel completion bash the completion of its words for the shell.\n";
}

std::string options_of(const Job& job)
{
  std::ostringstream out;
  if (!job.reads_case()) {
    job.help(out);
    return out.str();
  }
  out << "  --set \"Section/key=value\"  override a key of the case file; may be repeated\n"
         "  --output DIR               results folder; default results/<name of the case>\n"
         "  --overwrite                replace an earlier run in that folder\n"
      << (job.writes_checkpoints ? help_on_checkpoints : help_on_beginning_again)
      << help_on_forms << '\n'
      << (job.writes_checkpoints ? help_on_signals : help_without_checkpoints);
  return out.str();
}

std::string help_of(const Job& job)
{
  std::ostringstream out;
  out << "mergel " << job.name << ": " << job.sentence << "\n\nusage: mergel " << job.name
      << ' ' << job.arguments << '\n'
      << options_of(job);
  if (!job.reads_case()) return out.str();
  out << "\nKeys of CASE.prm, by section. A value is written with its unit; any unit of "
         "its "
         "dimension is\naccepted.\n\n";
  if (job.help) job.help(out);
  job.keys([&](const CaseFile& file) { file.help(out); });
  return out.str();
}

std::string json_of(const Job& job)
{
  std::string text = "{\n  \"job\": " + in_json(with_case(job, "--json").name) +
                     ",\n  \"meaning\": " + in_json(job.sentence) +
                     ",\n  \"version\": " + in_json(dem::version().number) +
                     ",\n  \"keys\": ";
  job.keys([&](const CaseFile& file) { text += keys_as_json(file); });
  return text + "\n}\n";
}

std::string template_of(const Job& job)
{
  std::string text;
  with_case(job, "--template").keys([&](const CaseFile& file) {
    text = template_of(
        file, "A case of mergel " + std::string(job.name) + ". " + job.sentence +
                  " Replace each " + std::string(to_be_given) +
                  " by a value; a default may be left as it is, or its line left out. "
                  "Written by mergel " +
                  dem::version().number + ".");
  });
  return text;
}

std::string version_text()
{
  const dem::Version& v = dem::version();
  return std::string("mergel ") + v.number + "\ncommit     " + v.commit +
         (*v.date ? std::string(" of ") + v.date : "") +
         (v.is_changed ? ", changed since" : "") + "\ncompiler   " + v.compiler +
         "\nlibraries  " + v.libraries + ", " + mpi_library() + "\n";
}

} // namespace mergel::apps
