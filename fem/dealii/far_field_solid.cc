#include "fem/dealii/far_field_solid.h"

#include "fem/boundary_ids.h"
#include "fem/dealii/elastic_solid.h"
#include "fem/dealii/far_field_mesh.h"
#include "fem/dealii/output.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace mergel::fem {
namespace {

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

class Solid : public FarFieldSolid {
public:
  explicit Solid(const FarFieldSpec& spec)
      : solid_(meshed(spec), properties(spec), supports(spec))
  {
    std::tie(interface_, nodes_) = make_interface(solid_);
  }

  const DiscreteSolid& discrete() const override { return solid_.discrete(); }
  const InterfaceMesh& interface() const override { return interface_; }
  const std::vector<std::uint32_t>& interface_nodes() const override { return nodes_; }
  std::size_t n_cells() const override { return mesh_.n_active_cells(); }
  void write_vtu(const NodalField& u, const NodalField& v, const std::string& path,
                 const std::string& made_by) const override
  {
    fem::write_vtu(solid_, u, v, path, made_by);
  }

private:
  const dealii::Triangulation<3>& meshed(const FarFieldSpec& spec)
  {
    const FarFieldGeometry g = geometry(spec);
    make_far_field_mesh(g, layers(g), mesh_);
    return mesh_;
  }

  dealii::Triangulation<3> mesh_;
  ElasticSolid solid_;
  InterfaceMesh interface_;
  std::vector<std::uint32_t> nodes_;
};

} // namespace

std::unique_ptr<FarFieldSolid> make_far_field_solid(const FarFieldSpec& spec)
{
  return std::make_unique<Solid>(spec);
}

} // namespace mergel::fem
