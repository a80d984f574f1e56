/// What an axis shows: a column of the histories, or the ratio of two, in a suitable unit.
#pragma once

#include "dem/io/table.h"

#include <array>
#include <string>
#include <vector>

namespace mergel::apps {

struct PlotQuantity {
  std::string name;            ///< of a column, or "A/B" of two columns
  std::string unit;            ///< of the axis: "MPa", "%", "-" for a pure number
  std::string base;            ///< unit of the histories: "Pa", "-"
  std::string words;           ///< name in the title of the axis
  bool is_logarithmic = false; ///< "log A"

  std::string title() const; ///< "q (MPa)"
};

/// "q", "q [MPa]" or "log p [MPa]"; no base yet, and no unit where none is written.
PlotQuantity quantity_of(const std::string& text);

/// "X:Y", each as above.
/// @throws InputError naming the text
std::array<PlotQuantity, 2> curve_of(const std::string& text);

/// The column of that name, or the ratio "A/B" of two: NaN where |B| is below 1e-3 of its
/// largest, because q/p has no meaning at p = 0.
/// @throws InputError naming the file and its columns
dem::TableColumn column_of(const dem::Table& history, const std::string& name);

/// Sets the base and, if there is no unit, the usual one: MPa for Pa, % for strains,
/// otherwise the base with the prefix that suits the largest value.
/// @throws InputError when a history lacks it, or its unit has another dimension
void settle(PlotQuantity& quantity, const std::vector<const dem::Table*>& histories);

/// In the unit that is shown; the quantity is settled.
std::vector<double> values_of(const dem::Table& history, const PlotQuantity& quantity);

} // namespace mergel::apps
