/// The linear elastic far field around a DEM region: the interface of fem/ to coupling/ and
/// apps/. Theory: fem/README.md.
#pragma once

#include "fem/solid/leapfrog.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <mpi.h>
#include <span>
#include <string>
#include <vector>

namespace mergel::fem {

/// How much of a cylinder about the axis z a far field is.
enum class Extent {
  half, ///< y >= 0, cut at the symmetry plane y = 0
  full
};

/// Cylinder of rock, or half of one, around a DEM region of the same shape with its top at
/// the ground surface. Axis z up, surface z = 0. What has no default must be set.
struct FarFieldSpec {
  static constexpr double unset = std::numeric_limits<double>::quiet_NaN();

  Extent extent = Extent::half;
  double chamber_diameter = unset, chamber_height = unset; ///< [m]
  double region_diameter = unset, region_height = unset;   ///< [m], less than the chamber's
  double cell_size = unset; ///< edge of the cells at the interface [m]
  double growth = 1.4; ///< mesh growth ratio: of neighbouring cells, outwards [-], >= 1

  double E = unset;   ///< Young's modulus [Pa]
  double nu = unset;  ///< Poisson's ratio [-]
  double rho = unset; ///< bulk density, pores included [kg/m^3]
  double K0 = unset; ///< initial sigma_h/sigma_v [-], >= 0; nu/(1-nu) at rest under rollers
  double gravity = 9.81; ///< downwards, [m/s^2], >= 0
  double damping = 0.7;  ///< local non-viscous damping [-], 0 <= damping < 1

  enum class Outer {
    roller,   ///< no radial displacement at r = R_c
    fixed,    ///< no displacement at r = R_c
    pressure, ///< r = R_c under the side pressure
  } outer = Outer::roller;
  double side_pressure = 0.0; ///< [Pa], >= 0; 0 but for Outer::pressure
  double surcharge = 0.0;     ///< pressure on the ground surface [Pa], >= 0

  /// Throws std::invalid_argument naming the value, what is allowed and a remedy.
  void check() const;
};

/// The interface to the DEM region as triangles: an open surface whose rim lies in z = 0
/// and, of a half model, in y = 0.
struct InterfaceMesh {
  std::vector<Eigen::Vector3d> x; ///< reference positions of its nodes [m]
  /// Indices into x; normals (right-hand rule) point into the DEM region.
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> boundary; ///< per triangle: an interface id of boundary_ids.h
};

/// Linear elastic, small strain; geostatic initial stress sigma_v = rho g z, sigma_h = K0
/// sigma_v (tension positive); base fixed, cut plane of a half model and (by default) chamber
/// wall on rollers, top free. Every rank holds the complete far field and gets the same bits; the
/// product with the stiffness, most of the cost of a step, is distributed over the ranks.
/// Its mesh is made by mesh_library().
class FarField {
public:
  /// Builds the mesh and assembles. Throws as FarFieldSpec::check and mesh_library() do.
  /// @param comm ranks that hold it and call step() together; it must outlive the object
  explicit FarField(const FarFieldSpec& spec, MPI_Comm comm = MPI_COMM_NULL);
  ~FarField();
  FarField(FarField&&) noexcept;
  FarField& operator=(FarField&&) noexcept;

  const InterfaceMesh& interface() const;

  /// v^{n+1/2} [m/s] and u^{n+1} [m] of the interface nodes, in the order of interface().x.
  /// Resizes its argument; no allocation once the size fits.
  void interface_velocity(std::vector<Eigen::Vector3d>& v) const;
  void interface_displacement(std::vector<Eigen::Vector3d>& u) const;

  /// Forces [N] on the interface nodes under which the initial stress is in equilibrium
  /// with u = 0: those that a DEM region with the same stress would exert.
  std::vector<Eigen::Vector3d> initial_interface_forces() const;

  /// Static equilibrium under forces [N] on the interface nodes: sets u, and v = 0; the
  /// work sums start from zero. Collective. Throws std::runtime_error when the solver does
  /// not converge.
  void solve_static(std::span<const Eigen::Vector3d> f_interface);

  /// One leapfrog step: kick with the forces [N] on the interface nodes at the present u =
  /// u^n, which sets v^{n+1/2}, then drift, which sets u^{n+1}. See fem/solid/leapfrog.h.
  void step(double dt, std::span<const Eigen::Vector3d> f_interface);

  /// 2/omega_max of the far field alone [s], without any factor of safety (none for damping
  /// either).
  double stable_time_step() const;

  /// Its linear system M a + K u = f in the amplitudes y = M^1/2 u, three for each node, for
  /// the largest frequency of all that it is coupled to; y has the length n_amplitudes().
  std::size_t n_amplitudes() const { return 3 * n_nodes(); }
  /// M^-1/2 y of the interface nodes, projected to their supports [kg^-1/2].
  void interface_motion(std::span<const double> y, std::vector<Eigen::Vector3d>& u) const;
  /// M^-1/2 (K M^-1/2 y + f) into `to`, f on the interface nodes, projected to the supports.
  /// Collective.
  void multiply(std::span<const double> y, std::span<const Eigen::Vector3d> f_interface,
                std::span<double> to) const;

  double unbalanced_ratio() const; ///< see Leapfrog::unbalanced_ratio
  Energies energies() const;       ///< see Energies in fem/solid/leapfrog.h

  /// For settling: each node gets the mass with which its squared frequency is at most omega2
  /// [1/s^2], by a bound, and is at rest. Weights stay what they are.
  /// @param stiffness of what is coupled to each interface node [N/m]
  void equalise_frequencies(double omega2, std::span<const double> stiffness);
  void restore_masses(); ///< the true ones again, at rest

  /// Its largest frequency with springs from its interface nodes to ground [1/s].
  /// @param stiffness of these springs by interface node [N/m]
  double largest_frequency(std::span<const double> stiffness) const;
  /// Kick by its own forces at every s-th step only, s >= 1, from the next window on (see
  /// Leapfrog).
  void set_subcycle(std::size_t s);

  const NodalMotion& motion() const; ///< the state that a restart needs
  void restore(NodalMotion state);   ///< throws std::invalid_argument for another mesh

  std::size_t n_cells() const;
  std::size_t n_nodes() const;
  double mass() const;    ///< of the modelled half or whole [kg]
  double damping() const; ///< local non-viscous damping [-]

  /// One sentence with counts and sizes, for the log.
  std::string summary() const;

  /// Displacement, velocity and stress (initial stress included); see fem/dealii/output.h.
  void write_vtu(const std::string& path, const std::string& made_by = "") const;

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

} // namespace mergel::fem
