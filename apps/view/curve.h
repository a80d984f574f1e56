/// Curves in panels: their axes, their strokes and the key that names them.
#pragma once

#include "apps/view/page.h"

#include <string>
#include <vector>

namespace mergel::apps {

struct Range {
  double low = 0.0, high = 0.0; ///< always includes 0
};

/// Of the finite values.
Range range(const std::vector<double>& values);
Range range(const Range& a, const Range& b); ///< includes both

/// An axis from the lowest to the highest value, widened to a round number.
Axis round_axis(const Range& r, const std::string& title);

/// A unit of convenient size: SI base unit with a prefix.
struct Unit {
  double size = 1.0; ///< [SI base unit]
  std::string name;  ///< "mm"
};

/// The unit in which `largest` [base] is 0.5 to 500; the base itself for 0.
/// @param base such as "m", "N", "N m", "rad"
Unit convenient_unit(double largest, const std::string& base);

/// One curve, broken where a value is missing.
void draw_curve(Page& page, const Panel& panel, const std::vector<double>& x,
                const std::vector<double>& y, const Stroke& stroke);

/// Stroke number k of a picture with many curves; eight colours, and 40 strokes differ.
/// Colours differ in lightness and each has its dashes, so that curves can be read in grey
/// print and where they overlap.
Stroke distinct_stroke(std::size_t k);

/// The mark of a point: its outline around white, or filled.
enum class Mark {
  none,
  ring,
  square,
  triangle,
  diamond,
  nabla,
  disc,
  full_square,
  full_triangle,
  full_diamond,
  full_nabla
};

/// Mark number k of a picture with several series of points; ten differ.
Mark distinct_mark(std::size_t k);

void draw_mark(Page& page, const Pixel& at, Mark mark, const Colour& colour);

struct KeyEntry {
  std::string words;
  Stroke stroke;
  Mark mark = Mark::none; ///< on the line
};

/// Height of a key in a box of this width.
double key_height(const Page& page, const std::vector<KeyEntry>& entries, double width);

/// The key, from the upper left corner of the box, in as many columns as fit.
void draw_key(Page& page, const Box& box, const std::vector<KeyEntry>& entries);

/// Boxes of panels for the whole page, two in a row, with room for their titles; the key
/// goes above them, or into the last place of the grid if that is free and large enough.
struct Grid {
  std::vector<Box> boxes;
  Box key;
};
Grid grid(const Page& page, std::size_t n_panels, const std::vector<KeyEntry>& entries);

} // namespace mergel::apps
