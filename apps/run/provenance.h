/// By what and how the results of a run were made: program, date, host, ranks, command, case.
#pragma once

#include "apps/run/jobs.h"

#include <string>

namespace mergel::apps {

/// One start of the program, as summary.json and resolved.prm name it. It differs from run to
/// run: what has the same bits in every run has none of it.
struct Provenance {
  std::string program; ///< dem/version.h
  std::string date;    ///< when the run began, UTC: "2026-11-29T17:05:00Z"
  std::string host;    ///< of the first rank
  int n_ranks = 1;
  std::string command;   ///< as a shell reads it
  std::string case_name; ///< file of the case, absolute; or what was restarted; "": none

  /// A JSON object in one line.
  std::string json() const;
  /// A line for the head of a case: begins with first_words_of_start, ends in a newline.
  std::string remark() const;
};

inline constexpr std::string_view first_words_of_start = "# made on ";

/// Of the run that begins. @pre MPI is initialised
Provenance provenance(const JobOptions& options);
/// Of a job without a case. @param command its words @pre MPI is initialised
Provenance provenance(const std::vector<std::string>& command);

/// The lines by remark() at the head of the resolved case of an earlier start; "" without one.
std::string earlier_starts(const std::filesystem::path& resolved);

/// The words of a command line as a shell reads them.
std::string in_shell(const std::vector<std::string>& words);

} // namespace mergel::apps
