/// Pictures of an element test for ParaView: its particles, bonds and contacts as series in time.
#pragma once

#include "apps/element/element_case.h"
#include "apps/run/frames.h"
#include "dem/element/element_test.h"
#include "dem/io/state/state_file.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace mergel::apps {

/// fields/particles_0000.vtp, fields/bonds_0000.vtp and fields/contacts_0000.vtp, and so on, with
/// particles.pvd, bonds.pvd and contacts.pvd. Displacements count from the first picture.
class ElementPictures {
public:
  /// Takes the first picture, of the assembly before the first stage. Collective, as is
  /// update().
  ElementPictures(const std::filesystem::path& folder, const ElementCase& c,
                  dem::ElementTest& run);
  /// Continue the pictures that the folder `earlier`, which may be `folder`, held when
  /// save() wrote `state`.
  ElementPictures(const std::filesystem::path& folder, const ElementCase& c,
                  dem::ElementTest& run, const std::filesystem::path& earlier,
                  const dem::State& state);

  /// Take a picture where one is due: at the end of a stage, or after an edge was strained
  /// by `picture every`. @return whether one was taken
  bool update(bool stage_ends);

  void save(dem::State& state) const;
  /// A line on pictures before `state` that `folder` lacks; "" when it lacks none.
  static std::string check(const std::filesystem::path& folder, const dem::State& state);

private:
  void take_picture();

  ElementCase::Pictures when_;
  double every_;
  dem::ElementTest& run_;
  std::vector<dem::Vec3> x_0_;   ///< of the first picture [m]
  dem::Vec3 size_last_;          ///< edges of the cell in the last picture [m]
  std::optional<Frames> frames_; ///< on the first rank
};

} // namespace mergel::apps
