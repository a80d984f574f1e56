/// What an axis shows: a column of the histories, or the ratio of two, in a
/// unit that suits.
#pragma once

#include "dem/io/table.h"

#include <array>
#include <string>
#include <vector>

namespace mergel::apps {

struct Quantity {
  std::string name;            ///< of a column, or "A/B" of two columns
  std::string unit;            ///< that is shown: "MPa", "%", "-" for a pure number
  std::string base;            ///< that the histories have it in: "Pa", "-"
  std::string words;           ///< that name it in the title of the axis
  bool is_logarithmic = false; ///< "log A"

  std::string title() const; ///< "q (MPa)"
};

/// "q", "q [MPa]" or "log p [MPa]"; no base yet, and no unit where none is written.
Quantity quantity_of(const std::string& text);

/// "X:Y", each as above.
/// @throws InputError naming the text
std::array<Quantity, 2> curve_of(const std::string& text);

/// The column of that name, or the ratio "A/B" of two: NaN where |B| is below 1e-3 of its
/// largest, as q/p means nothing without a p.
/// @throws InputError naming the file and the columns there are
dem::TableColumn column_of(const dem::Table& history, const std::string& name);

/// Give it its base and, if it has none, the unit that is usual in papers: MPa for Pa, %
/// for strains, else the base with the prefix that suits the largest value.
/// @throws InputError when a history lacks it, or its unit measures something else
void settle(Quantity& quantity, const std::vector<const dem::Table*>& histories);

/// One of this unit in units of the base: 1e6 for MPa and Pa, 0.01 for % and -.
/// @throws InputError when they do not measure the same thing
double unit_size(const std::string& unit, const std::string& base);

/// In the unit that is shown; the quantity is settled.
std::vector<double> values_of(const dem::Table& history, const Quantity& quantity);

} // namespace mergel::apps
