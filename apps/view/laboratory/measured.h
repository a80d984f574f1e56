/// Curves measured in a laboratory, to be laid over those of runs.
#pragma once

#include "apps/view/plot.h"
#include "apps/view/quantity.h"
#include "apps/view/run_plot.h"
#include "dem/io/table.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mergel::apps {

/// A file such as
///
///     axial strain [%],q [MPa]
///     0,0
///     0.4,3.9
///
/// Headings name columns of the histories, or the ratio A/B of two, and a unit that fits; a
/// strain or a quantity that is no pure number must have one.
struct Measured {
  std::filesystem::path file;
  std::string label; ///< the name of the file
  dem::Table table;
  std::vector<std::string> text_columns; ///< names of those that held text, left out
};

/// @throws InputError naming the file: not readable, no table, fewer than two columns
Measured read_measured(const std::filesystem::path& file);

/// One panel for each pair of abscissa and other column of the files; files with the same
/// pair share it. The abscissa is the axial strain, or else the first of diametral strain,
/// depth, volumetric strain and p that there is, or else the first column. Depth is drawn
/// downwards.
/// @throws InputError naming file and heading: no column of the runs, a unit missing or of
///   another dimension
std::vector<RunPlot> panels_of(const std::vector<Measured>& measured,
                               const std::vector<Run>& runs);

/// The measured curve in the units of this panel; empty if the file has another pair.
PlotCurve curve_in(const RunPlot& panel, const Measured& measured,
                   const std::vector<Run>& runs);

/// "lab.csv: 2 values of 'q' are missing; the curve has gaps there", one for each column
/// that has some, and one for each column of text.
std::vector<std::string> gaps_in(const Measured& measured);

} // namespace mergel::apps
