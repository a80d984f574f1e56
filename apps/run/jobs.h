/// The jobs of the program: one row here, one file in apps/ each.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace mergel::apps {

/// What the command line says about the run of a case.
struct JobOptions {
  std::string job; ///< its name; empty: a case of another job is not looked for
  std::filesystem::path case_file; ///< may be empty with `restart`
  /// Of the case file, where it has been read already: a pipe can be read once only.
  std::optional<std::string> case_text;
  std::vector<std::string> set;  ///< "Section/key=value", in the order given
  std::filesystem::path output;  ///< results folder, not yet checked
  bool overwrite = false;        ///< an earlier run there may be replaced
  std::filesystem::path restart; ///< checkpoint or results folder; empty: a new run
  double walltime = std::numeric_limits<double>::infinity(); ///< wall-clock limit [s]
  std::vector<std::string> command; ///< the words of the whole command line
};

class CaseFile;
struct Plan;
using UseKeys = std::function<void(const CaseFile&)>;

void help_bench(std::ostream& out); ///< every option of the job
std::function<int()> read_bench(const std::vector<std::string>& arguments);
void keys_of_bond(const UseKeys& use); ///< calls it with every key of the job declared
int run_bond(const JobOptions& options);
void help_compare(std::ostream& out);
std::function<int()> read_compare(const std::vector<std::string>& arguments);
void keys_of_brazilian(const UseKeys& use);
int run_brazilian(const JobOptions& options);
void keys_of_element(const UseKeys& use);
int run_element(const JobOptions& options);
void help_info(std::ostream& out);
std::function<int()> read_info(const std::vector<std::string>& arguments);
void keys_of_pile(const UseKeys& use);
int run_pile(const JobOptions& options);
void help_sample(std::ostream& out); ///< which other cases serve
void keys_of_sample(const UseKeys& use);
int run_sample(const JobOptions& options);
void keys_of_triaxial(const UseKeys& use);
int run_triaxial(const JobOptions& options);

/// Returns the exit code. @pre MPI is initialised
using RunCase = int (*)(const JobOptions&);
/// Reads the arguments of a job that has no case file and returns a function that runs it
/// once MPI is initialised. @throws InputError, or CLI::CallForHelp
using ReadArguments = std::function<int()> (*)(const std::vector<std::string>&);

/// Reads and checks the case of the options, and says what would run. Nothing is written.
/// @throws InputError naming file, line and key
using PlanCase = Plan (*)(const JobOptions&);
Plan plan_bond(const JobOptions& options);
Plan plan_brazilian(const JobOptions& options);
Plan plan_element(const JobOptions& options);
Plan plan_pile(const JobOptions& options);
Plan plan_sample(const JobOptions& options);
Plan plan_triaxial(const JobOptions& options);

void help_check(std::ostream& out);
std::function<int()> read_check(const std::vector<std::string>& arguments);

struct Job {
  const char* name;
  const char* sentence;
  const char* arguments; ///< what follows the name of the job
  /// Options of a job without a case; of others remarks on their case, or null.
  void (*help)(std::ostream&);
  void (*keys)(const UseKeys&); ///< null for a job without a case
  std::variant<RunCase, ReadArguments> run;
  bool writes_checkpoints = false; ///< and can stop before a time limit
  PlanCase plan = nullptr;         ///< null for a job without a case

  bool reads_case() const { return std::holds_alternative<RunCase>(run); }
};

inline constexpr const char* case_and_options = "CASE.prm [options]";

inline constexpr std::array<Job, 10> jobs{{
    {"bench", "Measure what a step costs on this machine.", "[options]", help_bench,
     nullptr, read_bench},
    {"bond", "Load one bonded pair of particles along any path.", case_and_options, nullptr,
     keys_of_bond, run_bond, false, plan_bond},
    {"brazilian", "Press a disc of bonded rock across its diameter until it splits.",
     case_and_options, nullptr, keys_of_brazilian, run_brazilian, true, plan_brazilian},
    {"check",
     "Read and check a case of any job, and say what would run: sizes, steps, hours.",
     "CASE.prm [options]", help_check, nullptr, read_check},
    {"compare", "Read several tests together: table, means, strength, critical states.",
     "DIR... [options]", help_compare, nullptr, read_compare},
    {"element", "Load a periodic cell of bonded rock along any path of stress and strain.",
     case_and_options, nullptr, keys_of_element, run_element, true, plan_element},
    {"info", "Describe and check a sample, a checkpoint or a results folder.", "PATH",
     help_info, nullptr, read_info},
    {"pile", "Install a pile in a chamber of bonded rock.", case_and_options, nullptr,
     keys_of_pile, run_pile, true, plan_pile},
    {"sample", "Make a specimen and write it to a file for later runs.", case_and_options,
     help_sample, keys_of_sample, run_sample, false, plan_sample},
    {"triaxial", "Load a cylinder of bonded rock in a membrane under a cell pressure.",
     case_and_options, nullptr, keys_of_triaxial, run_triaxial, true, plan_triaxial},
}};

} // namespace mergel::apps
