/// The specimen of a triaxial test between its platens: seen through its membrane, and cut
/// open.
#pragma once

#include "apps/view/page.h"
#include "apps/view/results.h"
#include "dem/io/table.h"

namespace mergel::apps {

/// Two views along +y, axes in mm: all particles behind the membrane, and the half y >= 0
/// without it; above them strain, q and broken bonds of the history at this time.
/// @throws InputError when the history lacks one of these
void draw_specimen(Page& page, const SpecimenFrame& frame, const dem::Table& history);

/// Thickness with which a platen is drawn, over the height of the specimen; the results have none.
inline constexpr double thickness_of_platens = 0.06;

/// The line of a level or tilted face [mm].
struct PlatenFace {
  double x_0, z_0, x_1, z_1;
  double at(double x) const // x_1 > x_0: a platen has a width
  {
    return z_0 + (z_1 - z_0) * (x - x_0) / (x_1 - x_0);
  }
};

/// The face of the upper platen, or of the lower one.
PlatenFace platen_face(vtkPolyData* platens, bool is_upper);

/// @param thickness upwards, negative: downwards [mm]
void draw_platen(Page& page, const Panel& panel, const PlatenFace& face, double thickness);

} // namespace mergel::apps
