/// The assembly cut open along the axis of the pile: particles, pile, a section of the far
/// field.
#pragma once

#include "apps/view/page.h"
#include "apps/view/results.h"

#include <string>
#include <vector>

namespace mergel::apps {

/// Colours of the assembly, and the texts of the picture.
struct AssemblyPicture {
  std::string array;                  ///< point array of the particles, one component
  double low = 0.0, high = 1.0;       ///< values at the ends of the colours
  bool is_logarithmic = false;        ///< then 0 < low < high, powers of ten
  std::vector<Colour> colours;        ///< from low to high, blended in CIELAB
  bool is_far_field_coloured = false; ///< the far field has that array too
  std::string legend;                 ///< title of the colour bar, with its unit
  std::string caption;                ///< above the picture
};

/// Light beige to dark red, lightness decreasing evenly.
std::vector<Colour> damage_colours();

/// Light to dark blue, lightness decreasing evenly.
std::vector<Colour> displacement_colours();

/// Draws the half y >= 0 as seen along +y, the full pile, axes in mm; with a close-up of
/// the tip beside it if the DEM region is slender enough to leave room.
void draw_assembly(Page& page, const ResultFrame& frame, const AssemblyPicture& picture);

} // namespace mergel::apps
