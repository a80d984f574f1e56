/// The jobs of the program: one row here, one file in apps/ each.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace mergel::apps {

/// What the command line says about the run of a case.
struct JobOptions {
  std::filesystem::path case_file; ///< may be empty with `restart`
  std::vector<std::string> set;    ///< "Section/key=value", in the order given
  std::filesystem::path output;    ///< results folder, not yet checked
  bool overwrite = false;          ///< an earlier run there may be replaced
  std::filesystem::path restart;   ///< checkpoint or results folder; empty: a new run
  double walltime = std::numeric_limits<double>::infinity(); ///< wall-clock limit [s]
};

void help_bench(std::ostream& out); ///< every option of the job
std::function<int()> read_bench(const std::vector<std::string>& arguments);
void help_bond(std::ostream& out); ///< every key of the job
int run_bond(const JobOptions& options);
void help_compare(std::ostream& out);
std::function<int()> read_compare(const std::vector<std::string>& arguments);
void help_brazilian(std::ostream& out);
int run_brazilian(const JobOptions& options);
void help_element(std::ostream& out);
int run_element(const JobOptions& options);
void help_info(std::ostream& out);
std::function<int()> read_info(const std::vector<std::string>& arguments);
void help_pile(std::ostream& out);
int run_pile(const JobOptions& options);
void help_sample(std::ostream& out);
int run_sample(const JobOptions& options);
void help_triaxial(std::ostream& out);
int run_triaxial(const JobOptions& options);

/// Returns the exit code. @pre MPI is initialised
using RunCase = int (*)(const JobOptions&);
/// Reads the arguments of a job that has no case file and returns a function that runs it
/// once MPI is initialised. @throws InputError, or CLI::CallForHelp
using ReadArguments = std::function<int()> (*)(const std::vector<std::string>&);

struct Job {
  const char* name;
  const char* sentence;
  void (*help)(std::ostream&);
  std::variant<RunCase, ReadArguments> run;
  bool writes_checkpoints = false; ///< and can stop before a time limit

  bool reads_case() const { return std::holds_alternative<RunCase>(run); }
};

inline constexpr std::array<Job, 9> jobs{{
    {"bench", "Measure what a step costs on this machine.", help_bench, read_bench},
    {"bond", "Load one bonded pair of particles along any path.", help_bond, run_bond},
    {"compare", "Read several tests together: table, means, strength, critical states.",
     help_compare, read_compare},
    {"brazilian", "Press a disc of bonded rock across its diameter until it splits.",
     help_brazilian, run_brazilian, true},
    {"element", "Load a periodic cell of bonded rock along any path of stress and strain.",
     help_element, run_element, true},
    {"info", "Describe and check a sample, a checkpoint or a results folder.", help_info,
     read_info},
    {"pile", "Install a pile in a chamber of bonded rock.", help_pile, run_pile, true},
    {"sample", "Make a specimen and write it to a file for later runs.", help_sample,
     run_sample},
    {"triaxial", "Load a cylinder of bonded rock in a membrane under a cell pressure.",
     help_triaxial, run_triaxial, true},
}};

} // namespace mergel::apps
