/// Results of a pile run: history.csv, the profiles and the frames for ParaView.
#pragma once

#include "apps/coupled/system_of_case.h"
#include "apps/pile/pile_case.h"
#include "apps/pile/pile_continuum.h"
#include "apps/pile/pile_profiles.h"
#include "apps/run/frames.h"
#include "dem/assembly/overlaps.h"
#include "dem/io/history.h"

namespace mergel::apps {

/// One line of history.csv. Forces are those of the full pile: twice those of a half
/// model.
struct PileRecord {
  double time = 0.0;       ///< since the pile began to move [s]
  double depth = 0.0;      ///< of the shoulder; negative while the cone enters [m]
  double tip_depth = 0.0;  ///< [m]
  double F_tip = 0.0;      ///< upwards, on the cone, mean since the last record [N]
  double F_shaft = 0.0;    ///< upwards, on the cylinder, mean since the last record [N]
  double q_c = 0.0;        ///< F_tip / (pi D^2/4) [Pa]
  std::size_t broken = 0;  ///< bonds so far
  double unbalanced = 0.0; ///< [-]
  double kinetic = 0.0;    ///< of the particles in the model [J]
  coupling::InterfaceBalance interface;
  double energy_error = 0.0;                 ///< unexplained energy over the input [-]
  double time_step = 0.0, stable_step = 0.0; ///< [s]
  /// Of the half or full model; pile work, slip, damping and bond losses since the pile began to
  /// move.
  dem::EnergyBalance balance;
  std::uint64_t stage = 1; ///< from 1
  double F_head = 0.0;     ///< of the head, downwards, mean since the last record [N]
  double F_lateral = 0.0;  ///< of the head along x, the same [N]
  double displacement = 0.0, rotation = 0.0; ///< of the pushed point along x [m]; [rad]
  coupling::StructureEnergies head;          ///< of the head and its pile, as modelled
  dem::Overlaps overlaps;                    ///< largest since the last record
};

/// Size of the section and of its windows, `averaging length` in d_50 of the finest particles.
ContinuumSpec continuum_spec(const PileCase& c, const dem::Particles& p);

class PileOutput {
public:
  /// @param c must outlive the object
  PileOutput(const std::filesystem::path& folder, const PileCase& c);
  /// Continue the files that the folder `earlier`, which may be `folder`, held when save()
  /// wrote `state`.
  /// @throws InputError when the history is another one
  PileOutput(const std::filesystem::path& folder, const PileCase& c,
             const std::filesystem::path& earlier, const dem::State& state);

  /// Add the length of the history and the times of the frames, all of them on the disk.
  /// @param output null on all ranks but the first
  static void save(dem::State& state, const PileOutput* output);
  /// Lines on what `folder` lacks of the results before `state`; "" when it lacks nothing.
  /// @throws InputError when its history is another one
  static std::string check(const std::filesystem::path& folder, const dem::State& state);

  /// @param rings those of the shaft, and the forces on them now
  void record(const PileRecord& r, const ShaftRings& rings,
              const std::vector<dem::RingForce>& forces);
  /// @throws NumericalError when another program has touched the history
  void require_in_place() const
  {
    history_.require_in_place();
    profiles_.require_in_place();
  }
  /// The next frame consists of particles, bonds and contacts, which any rank may write into these
  /// files,
  dem::AssemblyFiles files() const;
  /// of pile, far field and continuum fields,
  void write_fields(const PileContinuum& continuum,
                    const coupling::CoupledSystem& coupled) const;
  /// and of a line in each profile and series, when all files are there. @param time [s]
  void add_frame(double time, const PileContinuum& continuum,
                 const dem::Assembly& assembly);
  /// Positions of all particles at the last frame [m]; empty before the first.
  const std::vector<dem::Vec3>& x_last() const { return x_last_; }

  /// Add what the profiles show.
  void summarise(Summary& summary) const { profiles_.summarise(summary); }

private:
  const PileCase& case_;
  dem::History history_;
  Frames frames_;
  PileProfiles profiles_;
  ShaftStress shaft_;
  std::vector<dem::Vec3> x_last_;
};

} // namespace mergel::apps
