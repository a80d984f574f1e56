/// Points that are laid over the curves of runs: measured, digitised or computed elsewhere.
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
/// Names as in history.csv, in any order; a unit may be left out, then it is that of the
/// axis. A first line with # is the name in the key, else the file is.
struct Points {
  std::filesystem::path file;
  std::string label;
  Mark mark = Mark::ring;
  std::array<Quantity, 2> names; ///< not settled
  std::array<std::vector<double>, 2> values;
};

/// @throws InputError naming the file: unreadable, or not two columns with names
Points read_points(const std::filesystem::path& file, Mark mark);

/// The points in the units of these axes; none if they measure something else.
/// @throws InputError naming the file when a unit does not fit its axis
std::optional<Scatter> on_axes(const Points& points, const Quantity& x, const Quantity& y);

} // namespace mergel::apps
