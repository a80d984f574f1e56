/// Profiles along the shaft, below the tip and away from the pile, and the stress at points that
/// the tip passes, at each frame: shaft_profile.csv, tip_profile.csv, radial_profile.csv and
/// stress_path.csv.
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
  double minor = 0.0;      ///< principal stress, compression positive [Pa]
  double angle = 0.0; ///< of the major principal stress to the vertical [degree], 0 to 90
  bool is_there() const { return void_ratio > 0.0; }
};

/// The largest tensile principal stress of all windows outside the pile that lie more than a
/// diameter below the surface and within four of the axis. A window that is narrower than a
/// particle in it is left out.
struct Tension {
  double stress = 0.0;          ///< [Pa]; 0: all is compressed
  double r = 0.0, height = 0.0; ///< from the axis, above the tip [m]
};

/// What the profiles of the last frame show.
struct ProfileFindings {
  double averaging_length = 0.0, d_50 = 0.0; ///< [m]
  dem::PowerFit radial;                      ///< radial stress over h/R
  double rings = 0.0;                        ///< of that fit, its n [-]
  double shallowest_ring = 0.0;              ///< of that fit, depth of its middle [m]
  double icp18_exponent = 0.0;               ///< [-]
  double annulus = -1.0;                     ///< its thickness [m]; below 0: no rock there
  /// Beside the shaft a window wide over its whole length; the others a diameter high and wide:
  /// from D_p/2 above the shoulder upwards, around it, and below the tip as wide as the pile.
  RockState beside_shaft, above_shoulder, at_shoulder, below_tip;
  /// By how much the rock within a diameter below the tip is thinner than at the start [-].
  double thinning = 0.0;
  Tension tension;
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
  void add_paths(const ProfileFrame& frame, const dem::SectionSums& sums);
  void find_states(const ProfileFrame& frame, const dem::SectionSums& sums);

  double D_, R_, tip_height_;
  dem::History shaft_, tip_, radial_, path_;
  double deepest_; ///< of the tip, as far as the case goes [m]
  ProfileFindings found_;
};

} // namespace mergel::apps
