/// The jobs of the program: one row here, one file in apps/ each.
#pragma once

#include <array>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace mergel::apps {

/// What the command line says about a run.
struct JobOptions {
  std::filesystem::path case_file;
  std::vector<std::string> set; ///< "Section/key=value", in the order given
  std::filesystem::path output; ///< results folder, not yet looked at
  bool overwrite = false;       ///< an earlier run there may be replaced
};

void help_bond(std::ostream& out); ///< every key of the job
int run_bond(const JobOptions& options);
void help_pile(std::ostream& out);
int run_pile(const JobOptions& options);
void help_sample(std::ostream& out);
int run_sample(const JobOptions& options);

struct Job {
  const char* name;
  const char* sentence;
  void (*help)(std::ostream&);
  int (*run)(const JobOptions&); ///< returns the exit code; MPI is up
};

inline constexpr std::array<Job, 3> jobs{{
    {"bond", "Drive one bonded pair of spheres along any path.", help_bond, run_bond},
    {"pile", "Install a pile in a coupled chamber of rock.", help_pile, run_pile},
    {"sample", "Make a specimen and write it to a file for later runs.", help_sample,
     run_sample},
}};

} // namespace mergel::apps
