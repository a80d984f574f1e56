/// Symbols, signs, units and words of the whole code: read this first.
///
/// SI inside, radians, double precision.
///
///   x v omega          position [m], velocity [m/s], spin [rad/s] of a particle
///   R m I_p            radius [m], mass [kg], moment of inertia 2/5 m R^2 [kg m^2]
///   S                  upscaling ratio [-]: particle size over the size of its grains
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
/// Words:
///
///   particle                DEM sphere, S times as large as the grains that it represents
///   assembly                simulated particles with their bonds, contacts and walls
///   specimen                what is tested: particles and bonds, made before loading
///   sample                  file of a specimen (sample.h5)
///   loading stage           part of an element test: a rule for each axis, and a target
///   target                  stress or strain at which a loading stage ends
///   strain-controlled       axis or cell with a given strain rate
///   stress-controlled       axis whose stress a servo brings to a given value
///   contact geometry        closest point of a wall, with normal, gap and velocity
///   patch                   wall triangles joined by folds of at most 30 degrees
///   bond, intact bond       cement between two particles; intact until it breaks
///   far-field contact       spring with friction between particles, where gap < g_a
///   far field               continuum around the assembly, of finite elements
///   ghost                   particle of another rank that acts on one of this rank
///   distribute, gather      give each rank its part of an assembly, and the reverse
///   collective              to be called on all ranks, at the same point of a run
///   energy balance          growth of the stored energy = input - loss, but for an error
///   stored energy           kinetic, of bonds, contacts, walls and mirror images
///   input                   work of gravity, walls, strain-controlled cell
///   loss                    friction, plasticity and damage, the next two, local damping
///   breakage release        energy released at bond breakage, still stored until then
///   rotation constraint     no spin without an intact bond; the spin energy is lost
///   unbalanced-force ratio  sum of the resultants on particles over sum of pair forces
///   penetration rate        velocity of the pile, downwards [m/s]
///   collar                  part of the wall above the surface; keeps debris inside
///   symmetry plane          y = 0 of a half model; a particle acts on its mirror image
///   interface               faces of the far field that are a wall of the assembly
///   structure               finite elements that the assembly acts on
///
/// "The paper" is "An Efficient Damage-Plasticity DEM Contact Model for Highly Porous
/// Rocks" (2025). Equation, table and figure numbers without another source are the
/// paper's. The theory is in dem/README.md and dem/laws/README.md.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstdint>
#include <numbers>

namespace mergel::dem {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using std::numbers::pi;

/// Acceleration of gravity at the surface of the earth [m/s^2].
inline constexpr double standard_gravity = 9.81;

/// Position of a particle in the local arrays. Not an id: ids are global and never change.
using Index = std::uint32_t;

} // namespace mergel::dem
