/// What a results folder lacks of what its run has written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mergel::apps {

/// The job that wrote a results folder, by its resolved case, its summary and the heading of
/// its history; "" where these do not tell.
std::string job_of(const std::filesystem::path& folder);

/// How far a run came.
enum class Extent {
  begun,   ///< it owes its case, its history, and the files that its series name
  finished ///< and its specimen and every series
};

/// The files that a results folder lacks, relative to it: those that the job owes, with its
/// tables and, of a finished run, its specimen, and those that a series (.pvd) names. A series
/// that cannot be read counts as missing.
/// @param job as of job_of(); with "" no series is owed
std::vector<std::string> missing_results(const std::filesystem::path& folder,
                                         const std::string& job, Extent extent);

/// What a finished run has lost, in one sentence that names the first file and how many more;
/// "" for nothing. A specimen that is gone is no loss then: the folder of a run that is continued
/// may have come without it.
std::string lost_results(const std::filesystem::path& folder, const std::string& job);

/// Call it at the end of a run, on the first rank.
/// @throws NumericalError with lost_results()
void require_results(const std::filesystem::path& folder, const std::string& job);

} // namespace mergel::apps
