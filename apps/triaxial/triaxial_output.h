/// Results of `mergel triaxial`: history.csv, localisation.csv and the frames for ParaView.
#pragma once

#include "apps/run/frames.h"
#include "apps/triaxial/triaxial_case.h"
#include "coupling/triaxial/specimen_bands.h"
#include "dem/io/history.h"

namespace mergel::apps {

class TriaxialOutput {
public:
  TriaxialOutput(const std::filesystem::path& folder, const TriaxialCase& c);
  /// Continue the files that the folder `earlier`, which may be `folder`, held when save()
  /// wrote `state`. @throws InputError when a table is another one
  TriaxialOutput(const std::filesystem::path& folder, const TriaxialCase& c,
                 const std::filesystem::path& earlier, const dem::State& state);

  /// @param output null on all ranks but the first
  static void save(dem::State& state, const TriaxialOutput* output);
  /// Lines on what `folder` lacks of the results before `state`; "" when it lacks nothing.
  /// @throws InputError when a table is another one
  static std::string check(const std::filesystem::path& folder, const TriaxialCase& c,
                           const dem::State& state);

  void record(const coupling::TriaxialRecord& r, const StageLabel& stage);
  /// @param d_50 [m]
  void record(const coupling::BandRecord& r, double d_50, const StageLabel& stage);
  /// @throws NumericalError when another program has touched a table
  void require_in_place() const
  {
    history_.require_in_place();
    bands_.require_in_place();
  }
  /// Particles, bonds, contacts, platens and membrane at this time [s].
  /// @param assembly gathered: all particles
  /// @param at_walls dem::gather_wall_forces()
  /// @param porosity of the core before the test, for the stress of the particles [-]
  void frame(double time, const dem::Assembly& assembly,
             const std::vector<dem::WallContactForce>& at_walls,
             const coupling::CoupledSystem& system, const coupling::LocalStrains& strains,
             double porosity);

private:
  dem::History history_, bands_;
  Frames frames_;
};

} // namespace mergel::apps
