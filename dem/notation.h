/// Symbols, signs and units of the whole code: read this first.
///
/// SI inside, radians, double precision.
///
///   x v omega          position [m], velocity [m/s], spin [rad/s] of a particle
///   R m I_p S          radius [m], mass [kg], inertia 2/5 m R^2 [kg m^2], upscaling ratio [-]
///   n                  unit normal from i to j, i < j by global id
///   gap                |x_j - x_i| - R_i - R_j [m]; negative in overlap
///   a_i = R_i + gap/2  arm from the centre of i to the contact, a_i + a_j = |x_j - x_i|
///   R_b A I l          bond radius lambda_b min(R_i, R_j), area, second moment, R_i + R_j
///   k_n0 k_s0 k_b0     bond stiffnesses E/l [Pa/m], k_n0/kappa [Pa/m], k_n0 I [N m]
///   N V M              bond force (tension positive), shear force, moment, acting on i
///   D                  damage, 0 intact to 1
///   sigma_t sigma_c C  tensile, compressive and shear strength of the bond [Pa]
///   u_c theta_c        softening displacement [m] and rotation [rad] of the bond
///   g_a g_b            activation gap of the far-field contact, largest bonded gap [m]
///   f_n f_s            far-field contact force, compression positive, and its shear force
///   mu                 friction coefficient [-]
///   d00                smallest particle diameter at S = 1 [m]
///
/// Signs: contact f_n > 0 in compression; bond N > 0 in tension, as in the paper; a pair
/// force f acts on i and -f on j; relative quantities are j minus i; continuum stress is
/// tension positive. Soil-mechanics p, q (compression positive) exist in output only.
///
/// "The paper" is "An Efficient Damage-Plasticity DEM Contact Model for Highly Porous
/// Rocks" (2025). Equation, table and figure numbers without another name are its.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstdint>
#include <numbers>

namespace mergel::dem {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using std::numbers::pi;

/// Position of a particle in the local arrays. Not an id: ids are global and never change.
using Index = std::uint32_t;

} // namespace mergel::dem
