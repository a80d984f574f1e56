/// Periodic cell: the offsets between a particle and its images, and its homogeneous strain.
#pragma once

#include "dem/notation.h"

#include <array>

namespace mergel::dem {

struct Particles;

/// Integer periodic shift of the second particle of a pair, part of the pair's key.
using Shift = std::array<std::int16_t, 3>;

/// Box of edges `size`; an edge of 0 is not periodic. Positions are never wrapped: the
/// image of x under a shift is x + offset(shift).
///
/// A driven cell is strained along its edges. Each step moves the grains by their own
/// velocity and then carries everything along with the edges,
///
///   H <- g H,   x <- g (x + dt v),   g = 1/(1 - dt rate)
///
/// so v is the motion of a grain against the cell (peculiar velocity), and the pair's motion
/// over the step is exactly dt (v_j - v_i + rate r) with r the branch at its end. That holds
/// for every image alike, for a place is nowhere in it: a shift of the cell changes
/// nothing. Forces change v alone, m dv/dt = f: the inertia of the affine motion is left
/// out, its terms are the square of the inertial number times the pair forces. So damping
/// and kinetic energy are those of the fluctuation, a regular lattice moves affinely and
/// stays at rest, sum m v is conserved, and the work of the cell is sigma : D V with the
/// stress of Love and Weber, without a kinetic part.
struct PeriodicCell {
  Vec3 size = Vec3::Zero(); ///< [m]
  Vec3 rate =
      Vec3::Zero(); ///< growth of an edge over its length at the end of the step [1/s]
  bool is_driven = false; ///< may be strained, and its virial is summed

  bool is_periodic() const { return size.any(); }
  double volume() const { return size.prod(); } ///< [m^3]; of a cell periodic in all axes
  Vec3 offset(const Shift& s) const
  {
    return {s[0] * size.x(), s[1] * size.y(), s[2] * size.z()};
  }
};

/// Strain a driven cell over dt [s] and carry the owned grains along, after their own
/// motion. Returns the growth g of the edges.
/// @throws Unstable when an edge changes by more than 1e-3 in the step
Vec3 strain(PeriodicCell& cell, double dt, Particles& p);

} // namespace mergel::dem
