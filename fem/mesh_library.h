/// The part of fem/ that needs deal.II (fem/dealii), a shared library that is loaded when it is
/// first used.
///
/// deal.II of Debian brings some 150 shared libraries, whose symbols take half a second of every
/// start. Help, messages, and all jobs without a mesh start without it.
#pragma once

#include <memory>

namespace mergel::fem {

class FarFieldSolid;
struct FarFieldSpec;
struct SurfaceMesh;
struct Tube;

/// Its functions. They throw what their meshes and checks throw.
struct MeshLibrary {
  std::unique_ptr<FarFieldSolid> (*make_far_field)(const FarFieldSpec& spec);
  SurfaceMesh (*tube_surface)(const Tube& tube); ///< the triangles of Tube
};

/// Loads it at the first call, from the folder of the program or, installed, from lib/mergel
/// beside bin.
/// @throws std::runtime_error when it is not found, cannot be loaded, or was compiled in another
///         way or with other headers of fem/ than the program
const MeshLibrary& mesh_library();

} // namespace mergel::fem
