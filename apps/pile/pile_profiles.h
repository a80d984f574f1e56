/// Profiles along the shaft, below the tip and away from the pile, at each frame:
/// shaft_profile.csv, tip_profile.csv and radial_profile.csv.
#pragma once

#include "apps/pile/shaft_stress.h"
#include "apps/run/summary.h"
#include "dem/continuum/section_sums.h"
#include "dem/io/history.h"

#include <filesystem>

namespace mergel::apps {

/// Where the pile stands at a frame.
struct ProfileFrame {
  double time = 0.0;             ///< [s]
  double depth = 0.0;            ///< of the shoulder [m]
  double z_tip = 0.0;            ///< [m]
  double averaging_length = 0.0; ///< [m]
  double d_50 = 0.0;             ///< beside the pile [m]
};

/// Mean state of the rock at a place, where there is some.
struct RockState {
  double void_ratio = 0.0; ///< [-]; 0: no rock
  double p = 0.0, q = 0.0; ///< [Pa]
  bool is_there() const { return void_ratio > 0.0; }
};

/// What the profiles of the last frame show.
struct ProfileFindings {
  double averaging_length = 0.0, d_50 = 0.0; ///< [m]
  dem::PowerFit radial;                      ///< radial stress over h/R
  double rings = 0.0;                        ///< of that fit, its n [-]
  double icp18_exponent = 0.0;               ///< [-]
  double annulus = -1.0;                     ///< its thickness [m]; below 0: no rock there
  RockState beside_shaft, below_tip;
};

class PileProfiles {
public:
  PileProfiles(const std::filesystem::path& folder, const PileCase& c);
  /// Continue the tables of the folder `earlier`, which may be `folder`.
  /// @throws InputError when a table is another one
  PileProfiles(const std::filesystem::path& folder, const PileCase& c,
               const std::filesystem::path& earlier, const dem::State& state);
  /// @param profiles null on all ranks but the first
  static void save(dem::State& state, const PileProfiles* profiles);
  static std::string check(const std::filesystem::path& folder, const dem::State& state);
  /// @throws NumericalError when another program has touched a table
  void require_in_place() const;

  void add(const ProfileFrame& frame, const dem::SectionSums& sums,
           const ShaftStress& shaft);
  /// Figures of the last frame, and a closing line.
  void summarise(Summary& summary) const;

private:
  void add_shaft(const ProfileFrame& frame, const dem::SectionSums& sums,
                 const ShaftStress& shaft);
  void add_tip(const ProfileFrame& frame, const dem::SectionSums& sums);
  void add_radial(const ProfileFrame& frame, const dem::SectionSums& sums);

  double D_, R_, tip_height_;
  dem::History shaft_, tip_, radial_;
  ProfileFindings found_;
};

} // namespace mergel::apps
