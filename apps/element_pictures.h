/// Pictures of an element test for ParaView: its grains and bonds, as a series in time.
#pragma once

#include "apps/element_run.h"
#include "dem/io/vtk.h"

#include <filesystem>
#include <vector>

namespace mergel::apps {

/// fields/particles_0000.vtp and fields/bonds_0000.vtp, and so on, with particles.pvd and
/// bonds.pvd. Displacements count from the first picture.
class ElementPictures {
public:
  /// The rock before the first leg is the first picture. Collective, as is look().
  ElementPictures(std::filesystem::path folder, const ElementCase& c, ElementRun& run);

  /// Take a picture where one is due: a leg ends, or an edge was strained by so much.
  void look(bool leg_ends);

private:
  void take();

  std::filesystem::path folder_;
  ElementCase::Pictures when_;
  double every_;
  ElementRun& run_;
  std::vector<dem::Vec3> x_0_; ///< of the first picture [m]
  dem::Vec3 size_taken_;       ///< of the cell in the last one [m]
  dem::Series particles_, bonds_;
};

} // namespace mergel::apps
