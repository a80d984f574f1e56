/// Which program this is. Its source is written by every build (dem/version.cmake): a commit
/// compiles that file and no other.
#pragma once

#include <string>

namespace mergel::dem {

struct Version {
  const char* number;    ///< "0.1.0"
  const char* commit;    ///< "4f9b963f0c1a", or "unknown" where the sources are no clone
  const char* date;      ///< of the commit, "2026-11-29"; "" where it is unknown
  bool is_changed;       ///< the sources differed from the commit
  const char* compiler;  ///< "GNU 12.2.0, Release"
  const char* libraries; ///< "deal.II 9.4.1, PETSc 3.18.5" and so on
};

const Version& version();

/// "mergel 0.1.0, commit 4f9b963f0c1a of 2026-11-29": the same in all runs of one program.
std::string program_text();

} // namespace mergel::dem
