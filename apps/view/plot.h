/// Curves and points in a panel whose axes fit them.
#pragma once

#include "apps/view/curve.h"
#include "apps/view/page.h"

#include <string>
#include <vector>

namespace mergel::apps {

enum class Reach {
  from_zero, ///< the axis includes 0
  of_values, ///< from the lowest to the highest value
  downwards, ///< as from_zero, with the largest value at the left or lower end
  decades ///< logarithmic, at most three decades: what lies lower, or below 0, is left out
};

struct PlotAxis {
  std::string title; ///< with its unit
  Reach reach = Reach::from_zero;
};

/// All values in the units of the axes.
struct PlotCurve {
  std::vector<double> x, y;
  Stroke stroke;
};
struct Scatter {
  std::vector<double> x, y;
  Mark mark = Mark::ring;
};

/// Between two curves.
struct PlotBand {
  std::vector<double> x, low, high;
  Colour colour;
};

struct Plot {
  PlotAxis x, y;
  std::vector<PlotBand> bands; ///< below the curves
  std::vector<PlotCurve> curves;
  std::vector<Scatter> scatters; ///< above the curves
};

/// The axis that shows the values of a plot.
Axis fitting_axis(const PlotAxis& axis, const std::vector<double>& values);

/// Axes, lines at 0 where the values lie on both sides of it, curves, points.
void draw_plot(Page& page, const Box& box, const Plot& plot);

} // namespace mergel::apps
