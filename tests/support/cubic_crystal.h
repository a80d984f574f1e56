/// A simple cubic crystal of bonded particles, isotropic and with nu = 0.
#pragma once

#include "coupling/coupled_system.h"

#include <cmath>
#include <map>
#include <tuple>

namespace mergel::coupling::test {

/// With k_s = k_n its C11 = k_n/d, C12 = 0 and C44 = k_n/(2 d) (dem_crystal.cc): an isotropic
/// solid with E = k_n/d and nu = 0. The contact law is there, but as good as without stiffness.
struct CubicCrystal {
  double d;         ///< lattice constant, the diameter of its particles [m]
  double E = 1.1e9; ///< Young's modulus [Pa]
  double rho = 1e3; ///< bulk density [kg/m^3]
  dem::Particles particles = {};
  dem::Bonding bonding = {};
  /// Number of lattice cells without a particle that a particle has as neighbours, as the sum
  /// of the unit vectors from them to it; of particles beside a removed cell.
  std::map<dem::Index, dem::Vec3> faces = {};

  double wave_speed() const { return std::sqrt(E / rho); } ///< [m/s]

  dem::PairMaterials material() const
  {
    dem::DamageBond bond;
    bond.lambda_b = 1.0 / 3.0;
    bond.kappa = 1.0;
    bond.E = E * d * d / (dem::pi * std::pow(bond.lambda_b * 0.5 * d, 2));
    bond.sigma_t = bond.sigma_c = bond.C = 1e15;
    bond.u_c = bond.theta_c = 1.0;
    return {bond, dem::LinearMaterial{1e-6, 1.0, 0.0, 0.0}};
  }
  dem::ContactLaw contact() const { return material().contact; }

  /// Fill the lattice cells of these numbers, low <= k < high, whose centres
  /// ((k_x + 1/2) d, ...) are kept. Cells that are kept but removed have faces.
  /// @param wall_gap largest gap of a particle that is bonded to a wall [m]
  template <class Keep, class Remove>
  void fill(const std::array<int, 3>& low, const std::array<int, 3>& high, double wall_gap,
            Keep&& keep, Remove&& remove)
  {
    using Cell = std::array<int, 3>;
    std::map<Cell, dem::Index> at;
    const auto centre = [&](const Cell& k) {
      return dem::Vec3((k[0] + 0.5) * d, (k[1] + 0.5) * d, (k[2] + 0.5) * d);
    };
    Cell k{};
    for (k[2] = high[2] - 1; k[2] >= low[2]; --k[2])
      for (k[1] = low[1]; k[1] < high[1]; ++k[1])
        for (k[0] = low[0]; k[0] < high[0]; ++k[0]) {
          const dem::Vec3 x = centre(k);
          if (!keep(x) || remove(x)) continue;
          dem::ParticleState b;
          b.R = 0.5 * d;
          b.m = rho * d * d * d;
          b.x = x;
          at[k] = particles.add(b);
        }
    for (const auto& [cell, i] : at)
      for (int axis = 0; axis < 3; ++axis)
        for (const int to : {-1, 1}) {
          Cell next = cell;
          next[static_cast<std::size_t>(axis)] += to;
          const auto other = at.find(next);
          if (other != at.end()) {
            if (i < other->second) bonding.pairs.push_back({i, other->second});
          } else if (keep(centre(next)) && remove(centre(next))) {
            faces.try_emplace(i, dem::Vec3::Zero()).first->second -=
                to * dem::Vec3::Unit(axis);
          }
        }
    std::sort(bonding.pairs.begin(), bonding.pairs.end());
    bonding.limit = wall_gap;
  }

  /// A pressure in the removed cells [Pa].
  void apply_pressure(double p)
  {
    particles.applied_force.assign(particles.size(), dem::Vec3::Zero());
    for (const auto& [i, n] : faces) particles.applied_force[i] = p * d * d * n;
  }
};

} // namespace mergel::coupling::test
