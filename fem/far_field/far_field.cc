#include "fem/far_field/far_field.h"

#include "fem/boundary_ids.h"
#include "fem/far_field/far_field_mesh.h"
#include "fem/solid/elastic_solid.h"
#include "fem/solid/output.h"
#include "fem/solver/linear_solver.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace mergel::fem {
namespace {

FarFieldGeometry geometry(const FarFieldSpec& s)
{
  return {s.chamber_diameter / 2.0,
          s.chamber_height,
          s.region_diameter / 2.0,
          s.region_height,
          s.cell_size,
          s.growth,
          s.extent};
}

SolidProperties properties(const FarFieldSpec& s)
{
  const double gamma = s.rho * s.gravity, K0 = s.K0, q = s.surcharge;
  const auto geostatic = [gamma, K0, q](const dealii::Point<3>& x) {
    dealii::SymmetricTensor<2, 3> sigma;
    sigma[2][2] = gamma * x[2] - q;
    sigma[0][0] = sigma[1][1] = K0 * sigma[2][2];
    return sigma;
  };
  return {{s.E, s.nu},
          s.rho,
          Vec3(0.0, 0.0, -s.gravity),
          geostatic,
          {{boundary::top, s.surcharge}, {boundary::outer, s.side_pressure}}};
}

Supports supports(const FarFieldSpec& s)
{
  Supports all{{boundary::bottom, Support::fixed}};
  if (s.extent == Extent::half) all[boundary::symmetry] = Support::roller;
  if (s.outer == FarFieldSpec::Outer::fixed) all[boundary::outer] = Support::fixed;
  if (s.outer == FarFieldSpec::Outer::roller) all[boundary::outer] = Support::roller;
  return all;
}

/// A quadrilateral of the interface by its interface nodes, counter-clockwise as seen from
/// the DEM region.
using Quad = std::array<int, 4>;

/// Which diagonal splits the quadrilateral: true for corners 0 and 2. It is the shorter
/// one. If they are equal, it is the one through the lowest corner nearest to x = 0, then
/// to y = 0, so that mirror images in x or y are split in mirror image.
bool splits_from_first(const Quad& quad, const std::vector<Vec3>& x)
{
  const auto corner = [&](int k) -> const Vec3& {
    return x[static_cast<std::size_t>(quad[static_cast<std::size_t>(k)])];
  };
  const double d_02 = (corner(2) - corner(0)).norm(), d_13 = (corner(3) - corner(1)).norm();
  const double close = coincidence * (d_02 + d_13);
  if (std::abs(d_02 - d_13) > close) return d_02 < d_13;

  const auto key = [&](int k) {
    const Vec3& p = corner(k);
    return std::tuple(std::llround(p.z() / close), std::llround(std::abs(p.x()) / close),
                      std::llround(std::abs(p.y()) / close));
  };
  int first = 0;
  for (int k = 1; k < 4; ++k)
    if (key(k) < key(first)) first = k;
  return first % 2 == 0;
}

/// The interface mesh, and the node of the solid at each of its nodes (ascending).
std::pair<InterfaceMesh, std::vector<std::uint32_t>>
make_interface(const ElasticSolid& solid)
{
  std::vector<std::uint32_t> nodes = solid.nodes_on(boundary::interface_side);
  const auto floor = solid.nodes_on(boundary::interface_bottom);
  nodes.insert(nodes.end(), floor.begin(), floor.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());

  InterfaceMesh mesh;
  for (const auto a : nodes) mesh.x.push_back(solid.discrete().x[a]);

  for (const auto& cell : solid.dofs().active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) {
      const auto face = cell->face(f);
      const auto id = static_cast<int>(face->boundary_id());
      if (!face->at_boundary() ||
          (id != boundary::interface_side && id != boundary::interface_bottom))
        continue;
      Quad quad{};
      // Vertices in circular order; those of deal.II are in lexicographic order.
      constexpr std::array<unsigned int, 4> around = {0, 1, 3, 2};
      for (std::size_t k = 0; k < 4; ++k)
        quad[k] =
            static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(),
                                              face->vertex_dof_index(around[k], 0) / 3) -
                             nodes.begin());
      const auto x = [&](std::size_t k) {
        return mesh.x[static_cast<std::size_t>(quad[k])];
      };
      const dealii::Point<3> c = cell->center();
      const Vec3 away = x(0) + x(1) + x(2) + x(3) - 4.0 * Vec3(c[0], c[1], c[2]);
      if ((x(2) - x(0)).cross(x(3) - x(1)).dot(away) < 0.0) std::swap(quad[1], quad[3]);

      const std::size_t s = splits_from_first(quad, mesh.x) ? 0 : 1;
      mesh.triangles.push_back({quad[s], quad[s + 1], quad[(s + 2) % 4]});
      mesh.triangles.push_back({quad[s], quad[(s + 2) % 4], quad[(s + 3) % 4]});
      mesh.boundary.insert(mesh.boundary.end(), 2, id);
    }
  return {std::move(mesh), std::move(nodes)};
}

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
      : count(layers(geometry(spec))),
        solid(meshed(spec), properties(spec), supports(spec)),
        product(solid.discrete().K, comm)
  {
    std::tie(interface, nodes) = make_interface(solid);
    motion = std::make_unique<Leapfrog>(solid.discrete(), spec.damping, nodes, comm);
  }

  dealii::Triangulation<3>& meshed(const FarFieldSpec& spec)
  {
    make_far_field_mesh(geometry(spec), count, mesh);
    return mesh;
  }

  FarFieldLayers count;
  dealii::Triangulation<3> mesh;
  ElasticSolid solid;
  InterfaceMesh interface;
  std::vector<std::uint32_t> nodes; // of the solid, at interface.x
  SharedProduct product;            // with the stiffness
  std::unique_ptr<Leapfrog> motion;
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
  return parts_->interface;
}

void FarField::interface_velocity(std::vector<Eigen::Vector3d>& v) const
{
  v.resize(parts_->nodes.size());
  for (std::size_t k = 0; k < v.size(); ++k) v[k] = at(motion().v, parts_->nodes[k]);
}

void FarField::interface_displacement(std::vector<Eigen::Vector3d>& u) const
{
  u.resize(parts_->nodes.size());
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = at(motion().u, parts_->nodes[k]);
}

std::vector<Eigen::Vector3d> FarField::initial_interface_forces() const
{
  const DiscreteSolid& s = parts_->solid.discrete();
  std::vector<Eigen::Vector3d> f;
  f.reserve(parts_->nodes.size());
  for (const auto a : parts_->nodes) f.push_back(at(s.f_initial, a) - at(s.f_gravity, a));
  return f;
}

void FarField::solve_static(std::span<const Eigen::Vector3d> f_interface)
{
  const DiscreteSolid& s = parts_->solid.discrete();
  NodalField f = s.f_gravity - s.f_initial;
  for (std::size_t k = 0; k < std::min(f_interface.size(), parts_->nodes.size()); ++k)
    f.col(parts_->nodes[k]).head<3>() += f_interface[k].array();
  parts_->motion->rest_at(fem::solve_static(s, parts_->product, f).u, f_interface);
}

void FarField::step(double dt, std::span<const Eigen::Vector3d> f_interface)
{
  parts_->motion->step(dt, f_interface);
}

double FarField::stable_time_step() const
{
  return 2.0 /
         fem::largest_frequency(parts_->solid.discrete()); // > 0: the interface can move
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
  for (const auto a : parts_->nodes)
    u.push_back(motion_of(parts_->solid.discrete(), motion().m, y, a));
}

void FarField::multiply(std::span<const double> y,
                        std::span<const Eigen::Vector3d> f_interface,
                        std::span<double> to) const
{
  const DiscreteSolid& s = parts_->solid.discrete();
  const auto column = [](std::size_t a) { return static_cast<Eigen::Index>(a); };
  NodalField u = NodalField::Zero(4, column(s.n_nodes())), Ku = u;
  for (std::size_t a = 0; a < s.n_nodes(); ++a)
    u.col(column(a)).head<3>() = motion_of(s, motion().m, y, a).array();
  parts_->product.multiply(u, Ku);
  for (std::size_t k = 0; k < f_interface.size(); ++k)
    Ku.col(parts_->nodes[k]).head<3>() += f_interface[k].array();
  for (std::size_t a = 0; a < s.n_nodes(); ++a) {
    const Vec3 f = s.P[a] * at(Ku, column(a)) / std::sqrt(motion().m(column(a)));
    for (int c = 0; c < 3; ++c) to[3 * a + static_cast<std::size_t>(c)] = f[c];
  }
}

double FarField::unbalanced_ratio() const
{
  return parts_->motion->unbalanced_ratio();
}
Energies FarField::energies() const
{
  return parts_->motion->energies();
}
void FarField::equalise_frequencies(double omega2, std::span<const double> stiffness)
{
  // Gershgorin: no frequency is above the largest row sum over the mass.
  const DiscreteSolid& s = parts_->solid.discrete();
  NodalField rows = NodalField::Zero(4, static_cast<Eigen::Index>(s.n_nodes()));
  s.K.for_each([&](std::uint32_t i, std::uint32_t j, const Mat3& block) {
    rows.col(i).head<3>() += block.cwiseAbs().rowwise().sum().array();
    if (i != j)
      rows.col(j).head<3>() += block.cwiseAbs().colwise().sum().transpose().array();
  });
  Eigen::ArrayXd k = rows.colwise().maxCoeff();
  for (std::size_t n = 0; n < parts_->nodes.size(); ++n)
    k(parts_->nodes[n]) += stiffness[n];
  parts_->motion->set_masses(k / omega2);
}

double FarField::largest_frequency(std::span<const double> stiffness) const
{
  const DiscreteSolid& s = parts_->solid.discrete();
  Eigen::ArrayXd to_ground = Eigen::ArrayXd::Zero(s.m.size());
  for (std::size_t n = 0; n < parts_->nodes.size(); ++n)
    to_ground(parts_->nodes[n]) = stiffness[n];
  return fem::largest_frequency(s, motion().m, to_ground);
}

void FarField::set_subcycle(std::size_t s)
{
  parts_->motion->set_subcycle(s);
}

void FarField::restore_masses()
{
  parts_->motion->set_masses(parts_->solid.discrete().m);
}

const NodalMotion& FarField::motion() const
{
  return parts_->motion->motion();
}
void FarField::restore(NodalMotion state)
{
  parts_->motion->restore(std::move(state));
}

std::size_t FarField::n_cells() const
{
  return parts_->mesh.n_active_cells();
}
std::size_t FarField::n_nodes() const
{
  return parts_->solid.discrete().n_nodes();
}
double FarField::mass() const
{
  return parts_->solid.discrete().m.sum();
}
double FarField::damping() const
{
  return parts_->motion->damping();
}

std::string FarField::summary() const
{
  const FarFieldLayers& n = parts_->count;
  std::ostringstream s;
  s << "far field: " << n_cells() << " cells, " << n_nodes() << " nodes, "
    << parts_->interface.triangles.size() << " interface triangles (" << n.n_around
    << " around 180 degrees, " << n.n_ring << " + " << n.n_radial << " rings, " << n.n_upper
    << " + " << n.n_lower << " layers)";
  return s.str();
}

void FarField::write_vtu(const std::string& path, const std::string& made_by) const
{
  fem::write_vtu(parts_->solid, motion().u, motion().v, path, made_by);
}

} // namespace mergel::fem
