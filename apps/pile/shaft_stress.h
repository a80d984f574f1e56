/// Radial and shear stress on the shaft of a pile, by rings, averaged over the last half diameter
/// of travel.
#pragma once

#include "apps/pile/pile_case.h"
#include "dem/continuum/shaft_profile.h"
#include "dem/io/state/state_file.h"

#include <deque>

namespace mergel::apps {

/// The rings of a shaft: each a radius high, but at least four d50: a stress of 50 kPa on a lower
/// ring is less than one contact.
struct ShaftRings {
  double height = 0.0; ///< [m]
  std::size_t n = 0;   ///< that the shaft has where it is deepest

  ShaftRings() = default;
  /// @param d_50 of the particles beside the pile [m]
  ShaftRings(const PileCase& c, double d_50);
};

/// Stresses on one ring, of the full pile, means over the travel.
struct RingStress {
  double h = 0.0;      ///< of its middle above the shoulder [m]
  double radial = 0.0; ///< compression positive [Pa]
  double shear = 0.0;  ///< upwards on the pile [Pa]
};

/// Ring forces at the records of the last half diameter of travel of a loading stage.
class ShaftStress {
public:
  explicit ShaftStress(const PileCase& c);
  /// As save() wrote it. @throws InputError when the state is damaged
  ShaftStress(const PileCase& c, const dem::State& state);
  /// @param stress null on all ranks but the first
  static void save(dem::State& state, const ShaftStress* stress);

  /// @param stage number of the loading stage: those before it are left out
  /// @param tip_depth [m]; @param q_c [Pa]
  void add(std::uint64_t stage, double tip_depth, double q_c, const ShaftRings& rings,
           const std::vector<dem::RingForce>& forces);

  /// Of the rings that are whole below the surface, from the shoulder upwards; each is the mean
  /// over that part of the travel in which it is whole.
  std::vector<RingStress> mean() const;
  double mean_q_c() const;                        ///< over the same travel [Pa]
  double height() const { return rings_.height; } ///< of a ring [m]

private:
  struct Record {
    double tip_depth = 0.0, q_c = 0.0;
    std::vector<dem::RingForce> forces;
  };

  double R_, share_, tip_height_, travel_; // share_ of the pile that is modelled
  std::uint64_t stage_ = 0;
  ShaftRings rings_;
  std::deque<Record> records_;
};

} // namespace mergel::apps
