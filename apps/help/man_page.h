/// Manual pages in the language of man, from the declarations that --help prints.
#pragma once

#include "apps/run/jobs.h"

#include <string>

namespace mergel::apps {

std::string man_page();               ///< mergel(1)
std::string man_page(const Job& job); ///< mergel-<job>(1)

} // namespace mergel::apps
