/// Membranes of simple shapes, and their equilibrium, for the tests of fem/membrane.
#pragma once

#include "tests/support/catch.h"

#include "fem/dealii/surface_mesh.h"
#include "fem/membrane/membrane.h"

#include <deal.II/grid/grid_generator.h>

#include <random>

namespace mergel::fem::test {

/// Four triangles for each quadrilateral, about its centre; normals away from the origin.
template <int spacedim>
void split_into_triangles(const dealii::Triangulation<2, spacedim>& quadrilaterals,
                          dealii::Triangulation<2, 3>& mesh)
{
  std::vector<dealii::Point<3>> x;
  const auto add_point = [&](const dealii::Point<spacedim>& from) {
    dealii::Point<3> to;
    for (unsigned c = 0; c < spacedim; ++c) to[c] = from[c];
    x.push_back(to);
    return static_cast<unsigned>(x.size() - 1);
  };
  for (const auto& vertex : quadrilaterals.get_vertices()) add_point(vertex);
  std::vector<dealii::CellData<2>> cells;
  for (const auto& quadrilateral : quadrilaterals.active_cell_iterators()) {
    const unsigned centre =
        add_point(quadrilateral->center(true)); // on a curved surface too
    const unsigned around[] = {0, 1, 3, 2, 0};
    for (int k = 0; k < 4; ++k) {
      unsigned a = quadrilateral->vertex_index(around[k]),
               b = quadrilateral->vertex_index(around[k + 1]);
      const auto normal = dealii::cross_product_3d(x[b] - x[a], x[centre] - x[a]);
      if (normal * x[centre] < 0.0) std::swap(a, b);
      cells.emplace_back(3).vertices = {a, b, centre};
    }
  }
  mesh.create_triangulation(x, cells, dealii::SubCellData());
}

/// Sphere about the origin of 24 * 4^n triangles.
inline void make_sphere(double radius, unsigned n, dealii::Triangulation<2, 3>& mesh)
{
  dealii::Triangulation<2, 3> quadrilaterals;
  dealii::GridGenerator::hyper_sphere(quadrilaterals, dealii::Point<3>(), radius);
  quadrilaterals.refine_global(n);
  split_into_triangles(quadrilaterals, mesh);
}

/// Disc about the origin in the plane z = 0, of 48 * 4^n triangles.
inline void make_disc(double radius, unsigned n, dealii::Triangulation<2, 3>& mesh)
{
  dealii::Triangulation<2> quadrilaterals;
  dealii::GridGenerator::hyper_ball_balanced(quadrilaterals, dealii::Point<2>(), radius);
  quadrilaterals.refine_global(n);
  split_into_triangles(quadrilaterals, mesh);
}

/// Rectangle [0, length] x [0, height] in the plane z = 0, of 4 nx ny triangles.
inline void make_rectangle(double length, double height, unsigned nx, unsigned ny,
                           dealii::Triangulation<2, 3>& mesh)
{
  dealii::Triangulation<2> quadrilaterals;
  dealii::GridGenerator::subdivided_hyper_rectangle(
      quadrilaterals, {nx, ny}, dealii::Point<2>(), dealii::Point<2>(length, height));
  split_into_triangles(quadrilaterals, mesh);
}

/// Components of n nodes at random in [-size, size].
inline NodalField random_field(Eigen::Index n, double size, std::mt19937_64& random)
{
  std::uniform_real_distribution<double> u(-size, size);
  NodalField field = NodalField::Zero(4, n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (int c = 0; c < 3; ++c) field(c, a) = u(random);
  return field;
}

/// The nodes at map(x).
template <class Map>
NodalField moved(const NodalField& x, const Map& map)
{
  NodalField y = NodalField::Zero(4, x.cols());
  for (Eigen::Index a = 0; a < x.cols(); ++a)
    y.col(a).head<3>() = Vec3(map(at(x, a))).array();
  return y;
}

inline Vec3 resultant(const NodalField& f)
{
  return f.topRows<3>().rowwise().sum().matrix();
}
/// About the origin.
inline Vec3 moment(const NodalField& x, const NodalField& f)
{
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index a = 0; a < x.cols(); ++a) sum += at(x, a).cross(at(f, a));
  return sum;
}

/// Volume (1/6) sum x1.(x2 x x3) of a closed surface whose normals point outwards.
inline double volume(const SurfaceMesh& surface, const NodalField& x)
{
  double six = 0.0;
  for (const SurfaceTriangle& k : surface.triangles)
    six += at(x, k[0]).dot(at(x, k[1]).cross(at(x, k[2])));
  return six / 6.0;
}

/// Equilibrium from x by dynamic relaxation (Otter 1965): leapfrog with unit steps; where the
/// kinetic energy passes a maximum, the motion starts again from rest.
/// @param forces forces(x, f) sets the nodal forces f
/// @param k bound of the stiffness of each node; masses of k/2 leave omega dt <= 1.42
/// @param free 1 for each component that may move, else 0
/// @param tolerance norm of the unbalanced forces over sqrt(number of nodes) [N]
template <class Forces>
NodalField relax(const Forces& forces, NodalField x, const Eigen::ArrayXd& k,
                 const NodalField& free, double tolerance)
{
  const Eigen::Array<double, 1, Eigen::Dynamic> m = 0.5 * k.transpose();
  NodalField v = NodalField::Zero(4, x.cols()), f = v;
  double kinetic_before = 0.0;
  for (int n_steps = 0; n_steps < 200000; ++n_steps) {
    forces(x, f);
    f *= free;
    if (f.matrix().norm() < tolerance * std::sqrt(static_cast<double>(x.cols()))) return x;
    v += f.rowwise() / m;
    const double kinetic = (v.square().rowwise() * m).sum();
    if (kinetic < kinetic_before) {
      v.setZero();
      kinetic_before = 0.0;
      continue;
    }
    kinetic_before = kinetic;
    x += v;
  }
  FAIL("no equilibrium; unbalanced " << f.matrix().norm());
  return x;
}

} // namespace mergel::fem::test
