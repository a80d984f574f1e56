/// Surfaces of triangles in STL files, ASCII or binary.
#pragma once

#include "dem/notation.h"

#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

namespace mergel::dem {

/// The corners of one triangle, in the unit of the file; counter-clockwise seen from outside.
using StlTriangle = std::array<Vec3, 3>;

/// Read a file. The normals that it holds are not looked at: the order of the corners tells the
/// outside. A number of a binary file becomes the shortest decimal number that stands for it, as
/// an ASCII file would hold it.
/// @throws InputError naming the file, and of an ASCII file the line
std::vector<StlTriangle> read_stl(const std::filesystem::path& file);

/// The same from the content of a file. @param name of it in messages
std::vector<StlTriangle> stl_from(std::string_view bytes, const std::string& name);

} // namespace mergel::dem
