/// Stresses on the shaft of a pile, ring by ring, and how they fall with the distance to the tip.
#pragma once

#include "dem/assembly/assembly.h"

#include <cstddef>
#include <vector>

namespace mergel::dem {

/// Median diameter by mass of the particles with the smallest S, those beside the pile [m].
/// Particles with S up to 1 % above count too. @pre there are particles
double finest_d_50(const Particles& p);

/// Force of the particles on one ring of the shaft [N]: radial, towards the axis (pressure is
/// positive); around the axis; vertical, upwards.
struct RingForce {
  double radial = 0.0, around = 0.0, vertical = 0.0;
};

/// Of the rings of this height [m] that follow each other from the shoulder upwards; what acts
/// above the last one is left out. Exact sums: the same bits on any number of ranks. Collective.
/// @pre the wall is a body of revolution
std::vector<RingForce> ring_forces(const Assembly& assembly, const RigidWall& pile,
                                   double height, std::size_t n_rings);

/// y = a x^b by least squares of the logarithms, all points with the same weight.
struct PowerFit {
  double a = 0.0, b = 0.0;
  double standard_error = 0.0; ///< of b
  std::size_t n = 0;           ///< points with x > 0 and y > 0; below 3 there is no fit
  bool is_there() const { return n >= 3; }
};
PowerFit fit_power(const std::vector<double>& x, const std::vector<double>& y);

/// Radial stress on the shaft at the end of driving by Chalk ICP-18, Buckley et al. (2020) [Pa]:
/// 0.031 q_c (h/R)^(-0.481 (q_c/100 kPa)^0.145), h/R not below 6. The constants are from memory.
/// @param q_c cone resistance [Pa]; 0 gives 0
double icp18_end_of_driving(double q_c, double h_over_R);
/// Its exponent of h/R [-], negative.
double icp18_exponent(double q_c);

} // namespace mergel::dem
