/// The rock cut open along the pile's axis: particles as spheres, pile, a section of the
/// far field.
#pragma once

#include "apps/view/page.h"
#include "apps/view/results.h"

#include <string>
#include <vector>

namespace mergel::apps {

/// What colours the rock, and the words around it.
struct RockPicture {
  std::string array;                  ///< point array of the particles, one component
  double low = 0.0, high = 1.0;       ///< values at the ends of the colours
  bool is_logarithmic = false;        ///< then 0 < low < high, powers of ten
  std::vector<Colour> colours;        ///< from low to high, blended in CIELAB
  bool is_far_field_coloured = false; ///< the far field has that array too
  std::string legend;                 ///< title of the colour bar, with its unit
  std::string caption;                ///< above the picture
};

/// Light rock to dark red, lightness falling evenly.
std::vector<Colour> damage_colours();

/// Light to dark blue, lightness falling evenly.
std::vector<Colour> displacement_colours();

/// Draw the half y >= 0 as seen along +y, the pile whole, axes in mm; with a close-up
/// around the tip beside it if the DEM region is slender enough to leave room.
void draw_rock(Page& page, const ResultFrame& frame, const RockPicture& picture);

} // namespace mergel::apps
