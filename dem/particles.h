/// Grains: what each of them is, how it moves and what acts on it.
#pragma once

#include "dem/notation.h"

#include <cstddef>
#include <vector>

namespace mergel::dem {

/// What the pair loop reads of a grain, together in 96 bytes: three rows of four numbers,
/// loaded four grains at a time. Separate arrays cost 1.5 times as much here, one cache
/// miss each.
struct alignas(32) Body {
  Vec3 x = Vec3::Zero();     ///< position [m]; never wrapped into a periodic cell
  double R = 0.0;            ///< radius [m]
  Vec3 v = Vec3::Zero();     ///< velocity [m/s], half a step behind x
  double S = 1.0;            ///< upscaling ratio [-]
  Vec3 omega = Vec3::Zero(); ///< spin [rad/s], half a step behind x
  double m = 0.0;            ///< mass [kg]

  double inertia() const { return 0.4 * m * R * R; } ///< solid sphere [kg m^2]
};
static_assert(sizeof(Body) == 96);

/// What the pair loop adds to: resultant on a grain, two rows of four numbers.
struct alignas(32) Load {
  Vec3 f = Vec3::Zero(); ///< resultant force [N]
  double pad_f = 0.0;
  Vec3 t = Vec3::Zero(); ///< resultant torque about the centre [N m]
  double pad_t = 0.0;
};
static_assert(sizeof(Load) == 64);

/// Structure of arrays: index p names the same grain in every array. [0, n_owned) belong to
/// this rank, [n_owned, size()) are ghosts. Ids ascend within the owned range.
struct Particles {
  std::vector<Body> body;
  std::vector<Load> load;
  std::vector<std::uint64_t> id; ///< global, never reused
  std::vector<int> n_bonds;      ///< living bonds, those to walls and mirror image included
  std::size_t n_owned = 0;

  std::size_t size() const { return body.size(); }

  /// Append an owned grain; its id is its place. Only before ghosts exist.
  Index add(const Body& b)
  {
    const auto p = static_cast<Index>(size());
    body.push_back(b);
    load.emplace_back();
    id.push_back(p);
    n_bonds.push_back(0);
    n_owned = size();
    return p;
  }
};

/// Mass of a solid sphere [kg].
inline double sphere_mass(double R, double rho)
{
  return 4.0 / 3.0 * pi * R * R * R * rho;
}

} // namespace mergel::dem
