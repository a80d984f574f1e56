/// Points that are drawn over the curves of runs: measured, digitised or computed
/// elsewhere.
#pragma once

#include "apps/view/plot.h"
#include "apps/view/quantity.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace mergel::apps {

/// A file such as
///
///     # critical states
///     p [MPa],q [MPa]
///     1.2,1.5
///
/// Names as in history.csv, in any order; without a unit it is that of the axis. A first
/// line with # is the name in the key, otherwise it is the name of the file.
struct Points {
  std::filesystem::path file;
  std::string label;
  Mark mark = Mark::ring;
  std::array<PlotQuantity, 2> names; ///< not settled
  std::array<std::vector<double>, 2> values;
};

/// @throws InputError naming the file: unreadable, or not two columns with names
Points read_points(const std::filesystem::path& file, Mark mark);

/// The points in the units of these axes; none if they have other names.
/// @throws InputError naming the file when a unit does not fit its axis
std::optional<Scatter> on_axes(const Points& points, const PlotQuantity& x,
                               const PlotQuantity& y);

} // namespace mergel::apps
