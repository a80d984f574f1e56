/// Cross-sections of a polyhedron along its axis z.
#pragma once

#include "dem/walls/closed_surface.h"

namespace mergel::dem {

/// The circle that has the area of a cross-section.
struct SectionCircle {
  double z = 0.0; ///< height [m]
  double R = 0.0; ///< radius [m]
};

/// Two for each interval between heights of corners, from below: at its start and at its end.
/// Where a face is horizontal two of one height differ.
/// @pre require_closed(surface) holds
std::vector<SectionCircle> cross_sections(const ClosedSurface& surface);

/// The largest one, and the lowest height at which it is reached, to a millionth of the area.
SectionCircle largest(const std::vector<SectionCircle>& sections);

/// Radius at a height, linear between two circles; 0 below and above the polyhedron.
double radius_at(const std::vector<SectionCircle>& sections, double z);

} // namespace mergel::dem
