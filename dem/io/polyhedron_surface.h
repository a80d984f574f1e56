/// The surface of a polyhedron for ParaView.
#pragma once

#include "dem/walls/polyhedron.h"

#include <Eigen/Geometry>

#include <filesystem>
#include <vector>

namespace mergel::dem {

/// Triangles by their corners.
using TriangleSoup = std::vector<std::array<Vec3, 3>>;

/// The part of a polyhedron at side * x[axis] >= side * at, with the face that cuts it.
/// @param side 1 or -1
TriangleSoup cut_off(const TriangleSoup& polyhedron, Eigen::Index axis, double at,
                     double side);

/// A polyhedron at x, rotated about x, up to z_top [m] where it stands upright: its half at y >= 0
/// and the face that cuts it.
void write_half_polyhedron(const std::filesystem::path& file, const Polyhedron& polyhedron,
                           const Vec3& x, const Eigen::Quaterniond& rotation, double z_top);
/// The whole of it.
void write_polyhedron(const std::filesystem::path& file, const Polyhedron& polyhedron,
                      const Vec3& x, const Eigen::Quaterniond& rotation, double z_top);

} // namespace mergel::dem
