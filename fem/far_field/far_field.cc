#include "fem/far_field/far_field.h"

#include "fem/far_field/far_field_geometry.h"
#include "fem/far_field/far_field_solid.h"
#include "fem/mesh_library.h"
#include "fem/solid/shared_product.h"
#include "fem/solver/linear_solver.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>

namespace mergel::fem {
namespace {

void require(bool holds, const char* what, double value, const char* allowed_and_remedy)
{
  if (holds) return;
  std::ostringstream message;
  message << "far field: " << what << " = " << value << ": " << allowed_and_remedy;
  throw std::invalid_argument(message.str());
}

} // namespace

void FarFieldSpec::check() const
{
  // An unset value is NaN and fails each of these comparisons.
  require(region_diameter > 0.0, "region diameter", region_diameter,
          "must be set, in m, > 0");
  require(region_height > 0.0, "region height", region_height, "must be set, in m, > 0");
  require(chamber_diameter > region_diameter, "chamber diameter", chamber_diameter,
          "must exceed the region diameter; enlarge the chamber or shrink the DEM region");
  require(chamber_height > region_height, "chamber height", chamber_height,
          "must exceed the region height; enlarge the chamber or shrink the DEM region");
  require(cell_size > 0.0 && cell_size <= region_diameter / 2.0, "cell size", cell_size,
          "must be > 0 and at most the radius of the DEM region, in m");
  require(growth >= 1.0 && growth <= 3.0, "mesh growth ratio", growth,
          "must lie in [1, 3]; 1.4 is a good choice");
  require(E > 0.0 && std::isfinite(E), "Young's modulus", E, "must be set, in Pa, > 0");
  require(nu > -1.0 && nu < 0.5, "Poisson's ratio", nu,
          "must satisfy -1 < nu < 0.5; use 0.49 for a nearly incompressible rock");
  require(rho > 0.0 && std::isfinite(rho), "bulk density", rho,
          "must be set, in kg/m^3, > 0");
  require(K0 >= 0.0 && std::isfinite(K0), "K0", K0,
          "must be set, >= 0; nu/(1-nu) is the state at rest of this material");
  require(gravity >= 0.0 && std::isfinite(gravity), "gravity", gravity,
          "must be >= 0, in m/s^2; it points downwards");
  require(damping >= 0.0 && damping < 1.0, "damping", damping,
          "must satisfy 0 <= damping < 1");
  require(surcharge >= 0.0 && std::isfinite(surcharge), "surcharge", surcharge,
          "must be >= 0, in Pa; it presses on the ground surface");
  require(side_pressure >= 0.0 && std::isfinite(side_pressure), "side pressure",
          side_pressure, "must be >= 0, in Pa; it presses on the wall of the chamber");
  require(side_pressure == 0.0 || outer == Outer::pressure, "side pressure", side_pressure,
          "must be 0 where the wall of the chamber is held; choose the outer boundary "
          "under pressure");
  constexpr double max_cells = 2e6;
  const double n = layers(geometry(*this)).n_cells(extent);
  require(n <= max_cells, "number of cells for this cell size", n,
          "must be at most 2e6; is the cell size in the right unit?");
}

struct FarField::Parts {
  Parts(const FarFieldSpec& spec, MPI_Comm comm)
      : count(layers(geometry(spec))), solid(mesh_library().make_far_field(spec)),
        product(solid->discrete().K, comm),
        motion(solid->discrete(), spec.damping, solid->interface_nodes(), comm)
  {
  }

  const DiscreteSolid& discrete() const { return solid->discrete(); }
  const std::vector<std::uint32_t>& nodes() const { return solid->interface_nodes(); }

  FarFieldLayers count;
  std::unique_ptr<FarFieldSolid> solid;
  SharedProduct product; // with the stiffness
  Leapfrog motion;
};

FarField::FarField(const FarFieldSpec& spec, MPI_Comm comm)
{
  spec.check();
  parts_ = std::make_unique<Parts>(spec, comm);
}
FarField::~FarField() = default;
FarField::FarField(FarField&&) noexcept = default;
FarField& FarField::operator=(FarField&&) noexcept = default;

const InterfaceMesh& FarField::interface() const
{
  return parts_->solid->interface();
}

void FarField::interface_velocity(std::vector<Eigen::Vector3d>& v) const
{
  v.resize(parts_->nodes().size());
  for (std::size_t k = 0; k < v.size(); ++k) v[k] = at(motion().v, parts_->nodes()[k]);
}

void FarField::interface_displacement(std::vector<Eigen::Vector3d>& u) const
{
  u.resize(parts_->nodes().size());
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = at(motion().u, parts_->nodes()[k]);
}

std::vector<Eigen::Vector3d> FarField::initial_interface_forces() const
{
  const DiscreteSolid& s = parts_->discrete();
  std::vector<Eigen::Vector3d> f;
  f.reserve(parts_->nodes().size());
  for (const auto a : parts_->nodes()) f.push_back(at(s.f_initial, a) - at(s.f_gravity, a));
  return f;
}

void FarField::solve_static(std::span<const Eigen::Vector3d> f_interface)
{
  const DiscreteSolid& s = parts_->discrete();
  NodalField f = s.f_gravity - s.f_initial;
  for (std::size_t k = 0; k < std::min(f_interface.size(), parts_->nodes().size()); ++k)
    f.col(parts_->nodes()[k]).head<3>() += f_interface[k].array();
  parts_->motion.rest_at(fem::solve_static(s, parts_->product, f).u, f_interface);
}

void FarField::step(double dt, std::span<const Eigen::Vector3d> f_interface)
{
  parts_->motion.step(dt, f_interface);
}

double FarField::stable_time_step() const
{
  return 2.0 / fem::largest_frequency(parts_->discrete()); // > 0: the interface can move
}

namespace {

/// M^-1/2 y of one node, in its supports.
/// @param m masses of the nodes [kg]
Vec3 motion_of(const DiscreteSolid& s, const Eigen::ArrayXd& m, std::span<const double> y,
               std::size_t a)
{
  return s.P[a] * Vec3(y[3 * a], y[3 * a + 1], y[3 * a + 2]) /
         std::sqrt(m(static_cast<Eigen::Index>(a)));
}

} // namespace

void FarField::interface_motion(std::span<const double> y,
                                std::vector<Eigen::Vector3d>& u) const
{
  u.clear();
  for (const auto a : parts_->nodes())
    u.push_back(motion_of(parts_->discrete(), motion().m, y, a));
}

void FarField::multiply(std::span<const double> y,
                        std::span<const Eigen::Vector3d> f_interface,
                        std::span<double> to) const
{
  const DiscreteSolid& s = parts_->discrete();
  const auto column = [](std::size_t a) { return static_cast<Eigen::Index>(a); };
  NodalField u = NodalField::Zero(4, column(s.n_nodes())), Ku = u;
  for (std::size_t a = 0; a < s.n_nodes(); ++a)
    u.col(column(a)).head<3>() = motion_of(s, motion().m, y, a).array();
  parts_->product.multiply(u, Ku);
  for (std::size_t k = 0; k < f_interface.size(); ++k)
    Ku.col(parts_->nodes()[k]).head<3>() += f_interface[k].array();
  for (std::size_t a = 0; a < s.n_nodes(); ++a) {
    const Vec3 f = s.P[a] * at(Ku, column(a)) / std::sqrt(motion().m(column(a)));
    for (int c = 0; c < 3; ++c) to[3 * a + static_cast<std::size_t>(c)] = f[c];
  }
}

double FarField::unbalanced_ratio() const
{
  return parts_->motion.unbalanced_ratio();
}
Energies FarField::energies() const
{
  return parts_->motion.energies();
}
void FarField::equalise_frequencies(double omega2, std::span<const double> stiffness)
{
  // Gershgorin: no frequency is above the largest row sum over the mass.
  const DiscreteSolid& s = parts_->discrete();
  NodalField rows = NodalField::Zero(4, static_cast<Eigen::Index>(s.n_nodes()));
  s.K.for_each([&](std::uint32_t i, std::uint32_t j, const Mat3& block) {
    rows.col(i).head<3>() += block.cwiseAbs().rowwise().sum().array();
    if (i != j)
      rows.col(j).head<3>() += block.cwiseAbs().colwise().sum().transpose().array();
  });
  Eigen::ArrayXd k = rows.colwise().maxCoeff();
  for (std::size_t n = 0; n < parts_->nodes().size(); ++n)
    k(parts_->nodes()[n]) += stiffness[n];
  parts_->motion.set_masses(k / omega2);
}

double FarField::largest_frequency(std::span<const double> stiffness) const
{
  const DiscreteSolid& s = parts_->discrete();
  Eigen::ArrayXd to_ground = Eigen::ArrayXd::Zero(s.m.size());
  for (std::size_t n = 0; n < parts_->nodes().size(); ++n)
    to_ground(parts_->nodes()[n]) = stiffness[n];
  return fem::largest_frequency(s, motion().m, to_ground);
}

void FarField::set_subcycle(std::size_t s)
{
  parts_->motion.set_subcycle(s);
}

void FarField::restore_masses()
{
  parts_->motion.set_masses(parts_->discrete().m);
}

const NodalMotion& FarField::motion() const
{
  return parts_->motion.motion();
}
void FarField::restore(NodalMotion state)
{
  parts_->motion.restore(std::move(state));
}

std::size_t FarField::n_cells() const
{
  return parts_->solid->n_cells();
}
std::size_t FarField::n_nodes() const
{
  return parts_->discrete().n_nodes();
}
double FarField::mass() const
{
  return parts_->discrete().m.sum();
}
double FarField::damping() const
{
  return parts_->motion.damping();
}

std::string FarField::summary() const
{
  const FarFieldLayers& n = parts_->count;
  std::ostringstream s;
  s << "far field: " << n_cells() << " cells, " << n_nodes() << " nodes, "
    << parts_->solid->interface().triangles.size() << " interface triangles (" << n.n_around
    << " around 180 degrees, " << n.n_ring << " + " << n.n_radial << " rings, " << n.n_upper
    << " + " << n.n_lower << " layers)";
  return s.str();
}

void FarField::write_vtu(const std::string& path, const std::string& made_by) const
{
  parts_->solid->write_vtu(motion().u, motion().v, path, made_by);
}

} // namespace mergel::fem
