/// Profiles along the shaft, below the tip and away from the pile, at each frame:
/// shaft_profile.csv, tip_profile.csv and radial_profile.csv.
#pragma once

#include "apps/pile/shaft_stress.h"
#include "apps/run/summary.h"
#include "dem/continuum/section_sums.h"
#include "dem/io/history.h"

#include <filesystem>
#include <optional>

namespace mergel::apps {

/// Where the pile stands at a frame.
struct ProfileFrame {
  double time = 0.0;             ///< [s]
  double depth = 0.0;            ///< of the shoulder [m]
  double z_tip = 0.0;            ///< [m]
  double averaging_length = 0.0; ///< [m]
  double d_50 = 0.0;             ///< beside the pile [m]
};

/// What the profiles of the last frame show; a member is empty where there is no rock to show it.
struct ProfileFindings {
  double averaging_length = 0.0, d_50 = 0.0; ///< [m]
  dem::PowerFit radial;                      ///< radial stress over h/R
  double icp18_exponent = 0.0;               ///< [-]
  std::optional<double> annulus;             ///< its thickness [m]
  std::optional<dem::SectionAverage> beside_shaft, below_tip;
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
