/// Completion of the words of a command line, from the declarations that --help prints.
#pragma once

#include <string>

namespace mergel::apps {

/// A script for bash: jobs, options, cases, folders, and after --set the keys of the job.
std::string bash_completion();

} // namespace mergel::apps
