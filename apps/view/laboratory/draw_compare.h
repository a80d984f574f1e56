/// Runs beside measured curves.
#pragma once

#include "apps/view/options.h"
#include "dem/io/table.h"

#include <vector>

namespace mergel::apps {

/// compare.png, with a panel for each quantity that the files of --compare hold. Strains of
/// an element or triaxial run count from the stage that is read (apps/laboratory) unless
/// --stage says otherwise.
void draw_compare(const Options& options, const std::vector<dem::Table>& histories);

} // namespace mergel::apps
