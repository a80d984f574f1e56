/// The two symbols that the program looks for in this library (fem/mesh_library.cc).
#include "fem/dealii/far_field_solid.h"
#include "fem/dealii/surface_mesh.h"
#include "fem/mesh_library.h"

#include <deal.II/base/multithread_info.h>

#define MERGEL_SHOWN extern "C" [[gnu::visibility("default")]]

MERGEL_SHOWN const char* mergel_build()
{
  return MERGEL_BUILD;
}

MERGEL_SHOWN mergel::fem::MeshLibrary mergel_mesh_library()
{
  // The processors belong to the ranks.
  dealii::MultithreadInfo::set_thread_limit(1);
  return {mergel::fem::make_far_field_solid, mergel::fem::tube_surface};
}
