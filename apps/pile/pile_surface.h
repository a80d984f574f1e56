/// A pile whose surface is read from a file.
#pragma once

#include "apps/case/material_keys.h"
#include "dem/walls/polyhedron.h"

#include <filesystem>
#include <optional>
#include <string>

namespace mergel::apps {

/// A case holds the surface itself: the file may move or change.
struct PileSurface {
  std::filesystem::path file;
  std::string unit = "mm";   ///< of length, in the file
  std::string sum, content;  ///< checksum of the file; text of the surface
  double tip_height = unset; ///< [m]; that of the largest section by default
  std::optional<dem::Polyhedron> polyhedron; ///< set by complete_surface()
};

/// Most triangles: a case of more has over half a MB.
inline constexpr std::size_t most_triangles = 15'000;

/// Declare its keys in the open section Pile; they exist with `tip = surface`.
void declare(CaseFile& file, PileSurface& s);

/// Read the surface from its file or, where a run is continued or the file is gone, from the
/// case, and set sum and content in the resolved case.
/// @throws InputError naming file, line and key
void complete_surface(CaseFile& file, PileSurface& s);

/// "0 0 0, 1 0 0; 0 1 2": points in the unit of the file, numbers of the corners.
std::string text_of(const dem::ClosedSurface& surface);
/// The surface of text_of(). @throws InputError without place and value
dem::ClosedSurface surface_from(const std::string& text);

/// A line on what was read.
std::string report(const PileSurface& s);

} // namespace mergel::apps
