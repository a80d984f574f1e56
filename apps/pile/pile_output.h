/// What a pile run leaves behind: history.csv, fields for ParaView, summary.
#pragma once

#include "apps/coupled/coupled_system.h"
#include "apps/pile/pile_case.h"
#include "apps/run/frames.h"
#include "dem/io/history.h"

namespace mergel::apps {

/// One line of history.csv. Forces are those of the full pile: the half model's, doubled.
struct PileRecord {
  double time = 0.0;       ///< since the pile began to move [s]
  double depth = 0.0;      ///< of the shoulder; negative while the cone enters [m]
  double tip_depth = 0.0;  ///< [m]
  double F_tip = 0.0;      ///< upwards, on the cone, mean since the last record [N]
  double F_shaft = 0.0;    ///< upwards, on the cylinder, mean since the last record [N]
  double q_c = 0.0;        ///< F_tip / (pi D^2/4) [Pa]
  std::size_t broken = 0;  ///< bonds so far
  double unbalanced = 0.0; ///< [-]
  double kinetic = 0.0;    ///< of the grains, half model [J]
  coupling::InterfaceBalance interface;
  double energy_error = 0.0; ///< unexplained energy over the input [-]
  /// Of the half model; pile work and losses since the pile began to move.
  dem::EnergyBook book;
};

class PileOutput {
public:
  PileOutput(const std::filesystem::path& folder, const PileCase& c);
  /// Go on with what `earlier`, which may be the same folder, held when put() wrote
  /// `state`.
  /// @throws InputError when it no longer does
  PileOutput(const std::filesystem::path& folder, const PileCase& c,
             const std::filesystem::path& earlier, const dem::State& state);

  /// Add how far the files go, all of them on the disk.
  /// @param output null on all ranks but the first
  static void put(dem::State& state, const PileOutput* output);
  /// @throws InputError when the files of `folder` do not go as far as `state` says
  static void check(const std::filesystem::path& folder, const dem::State& state);

  void record(const PileRecord& r);
  /// Particles, bonds, pile and far field at this time [s].
  /// @param rock the whole of it
  void frame(double time, const dem::Rock& rock, const CoupledRock& coupled);

private:
  double diameter_;
  dem::History history_;
  Frames frames_;
};

} // namespace mergel::apps
