/// Pictures of an element test for ParaView: its grains and bonds, as a series in time.
#pragma once

#include "apps/element/element_case.h"
#include "apps/run/frames.h"
#include "dem/element/element_test.h"
#include "dem/io/state/state_file.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace mergel::apps {

/// fields/particles_0000.vtp and fields/bonds_0000.vtp, and so on, with particles.pvd and
/// bonds.pvd. Displacements count from the first picture.
class ElementPictures {
public:
  /// The rock before the first leg is the first picture. Collective, as is look().
  ElementPictures(const std::filesystem::path& folder, const ElementCase& c,
                  dem::ElementTest& run);
  /// Go on with those that `earlier`, which may be the same folder, held when put() wrote
  /// `state`.
  ElementPictures(const std::filesystem::path& folder, const ElementCase& c,
                  dem::ElementTest& run, const std::filesystem::path& earlier,
                  const dem::State& state);

  /// Take a picture where one is due: a leg ends, or an edge was strained by so much.
  void look(bool leg_ends);

  void put(dem::State& state) const;
  /// @throws InputError when the files of `folder` do not go as far as `state` says
  static void check(const std::filesystem::path& folder, const dem::State& state);

private:
  void take();

  ElementCase::Pictures when_;
  double every_;
  dem::ElementTest& run_;
  std::vector<dem::Vec3> x_0_;   ///< of the first picture [m]
  dem::Vec3 size_taken_;         ///< of the cell in the last one [m]
  std::optional<Frames> frames_; ///< on the first rank
};

} // namespace mergel::apps
