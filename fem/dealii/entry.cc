/// The one symbol by which the program finds this library (fem/mesh_library.h).
#include "fem/dealii/far_field_solid.h"
#include "fem/dealii/surface_mesh.h"
#include "fem/mesh_library.h"

#include <deal.II/base/multithread_info.h>

extern "C" mergel::fem::MeshLibrary mergel_mesh_library()
{
  // The processors belong to the ranks.
  dealii::MultithreadInfo::set_thread_limit(1);
  return {MERGEL_BUILD, mergel::fem::make_far_field_solid, mergel::fem::tube_surface};
}
