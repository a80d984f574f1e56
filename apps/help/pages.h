/// The pages of the program and its jobs: what --help and its relatives print. All of them come
/// from the list of jobs and the declarations of their keys.
#pragma once

#include "apps/run/jobs.h"

#include <string>

namespace mergel::apps {

/// @throws InputError naming the nearest job
const Job& find_job(const std::string& name);

std::string help_of_program(); ///< usage, jobs, an example
std::string help_of(const Job& job);
/// Job and keys as JSON. @throws InputError for a job without a case
std::string json_of(const Job& job);
/// A case of the job to fill in. @throws InputError for a job without a case
std::string template_of(const Job& job);
/// Version, commit, compiler and libraries, a line each.
std::string version_text();

/// What follows the name of every job with a case: options and their meaning.
std::string options_of(const Job& job);

inline constexpr std::size_t columns_of_page = 92;

} // namespace mergel::apps
