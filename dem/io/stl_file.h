/// Surfaces of triangles in STL files, ASCII or binary.
#pragma once

#include "dem/notation.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace mergel::dem {

/// The corners of one triangle, in the unit of the file; counter-clockwise seen from outside.
using StlTriangle = std::array<Vec3, 3>;

/// From the content of a file. The normals that it holds are not looked at: the order of the
/// corners tells the outside. A number of a binary file becomes the shortest decimal number that
/// stands for it, as an ASCII file would hold it.
/// @param name of the file in messages
/// @throws InputError naming the file, and of an ASCII file the line
std::vector<StlTriangle> stl_from(std::string_view bytes, const std::string& name);

} // namespace mergel::dem
