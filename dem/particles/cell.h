/// Periodic cell: offsets between a particle and its images, and homogeneous strain.
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
/// A strain-controlled cell is strained along its edges (dem/README.md, Element tests).
/// Each step moves the particles by their own velocity and then scales all positions with
/// the edges H of the cell:
///
///   H <- g H,   x <- g (x + dt v),   g = 1/(1 - dt rate)
///
/// So v is the velocity of a particle relative to the cell (peculiar velocity). The motion
/// of a pair over the step is exactly dt (v_j - v_i + rate r), r the branch vector at its
/// end. This holds for every image, because no absolute position enters: a shift of the
/// cell changes nothing.
///
/// Forces change v alone, m dv/dt = f. The inertia of the affine motion is left out: its
/// terms are the pair forces times the square of the inertial number. So damping and
/// kinetic energy are those of the fluctuation, a regular lattice moves affinely and stays
/// at rest, sum m v is conserved, and the work of the cell is sigma : D V with the stress
/// of Love and Weber, without a kinetic part.
struct PeriodicCell {
  Vec3 size = Vec3::Zero(); ///< [m]
  Vec3 rate =
      Vec3::Zero(); ///< strain rate, referred to the edges at the end of the step [1/s]
  bool is_strain_controlled = false; ///< may be strained; its virial is summed

  bool is_periodic() const { return size.any(); }
  double volume() const { return size.prod(); } ///< [m^3]; of a cell periodic in all axes
  Vec3 offset(const Shift& s) const
  {
    return {s[0] * size.x(), s[1] * size.y(), s[2] * size.z()};
  }
};

/// Strain a strain-controlled cell over dt [s] and scale the positions of the owned
/// particles with it, after their own motion. Returns the factors g of the edges [-].
/// @throws Unstable when an edge changes by more than 1e-3 in the step
Vec3 strain(PeriodicCell& cell, double dt, Particles& p);

} // namespace mergel::dem
