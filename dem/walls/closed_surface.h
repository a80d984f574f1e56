/// A closed surface of triangles, and whether it bounds one polyhedron.
#pragma once

#include "dem/walls/triangulated.h"

#include <string>

namespace mergel::dem {

/// Corners that several triangles share are one point.
struct ClosedSurface {
  std::vector<Vec3> x;             ///< [m], or the unit of a file
  std::vector<Triangle> triangles; ///< normals by the right-hand rule point outwards
};

/// The surface of triangles that are given by their corners one by one: those with the same
/// coordinates become one point.
/// @throws InputError for a triangle without area, as far as round-off tells
ClosedSurface join_corners(const std::vector<std::array<Vec3, 3>>& triangles);

/// Whether the surface bounds one polyhedron: each edge has two triangles, which run along it in
/// opposite directions; the triangles around each point follow each other; all hang together;
/// the normals point outwards. That it does not cut itself is not looked at.
/// @throws InputError naming a triangle, counted from 1, or a point, and a remedy
void require_closed(const ClosedSurface& surface);

/// Volume that it encloses; negative where the normals point inwards.
double volume(const ClosedSurface& surface);
/// Centre of that volume. @pre volume() is not 0
Vec3 centre_of_volume(const ClosedSurface& surface);

} // namespace mergel::dem
