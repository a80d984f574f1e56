/// The curves of element and triaxial runs over each other, and curves of any run.
#pragma once

#include "apps/laboratory/stages.h"
#include "apps/view/options.h"
#include "apps/view/run_plot.h"
#include "dem/io/table.h"

#include <filesystem>
#include <vector>

namespace mergel::apps {

/// As apps/laboratory/test_reading.h has it, where the folder holds its case: without that the
/// stages have the numbers of the history.
void require_numbers_of_case(const std::filesystem::path& folder,
                             const dem::Table& history);

/// The chosen stages of runs, with their names.
std::vector<Run> runs_of(const Options& options, const Stages& stages,
                         const std::vector<dem::Table>& histories);

/// Draws runs over each other in these panels.
void draw_panels(const Options& options, const std::vector<RunPlot>& plots,
                 const std::vector<Run>& runs, const char* name);

/// isotropic.png, or where q matters the picture of this name.
void draw_stages(const Options& options, const Stages& stages,
                 const std::vector<dem::Table>& histories, const char* sheared);

/// The panels, and of one test the specimen at a time of its pictures.
void draw_triaxial(const Options& options, const Stages& stages,
                   const std::vector<dem::Table>& histories);

/// The panels, and of one test the disc at a time of its pictures.
void draw_brazilian(const Options& options, const std::vector<dem::Table>& histories);

/// curve.png.
void draw_curves(const Options& options, const Stages& stages,
                 const std::vector<dem::Table>& histories);

} // namespace mergel::apps
