/// Small solids with closed-form answers, for the tests of fem/.
#pragma once

#include "fem/dealii/elastic_solid.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <array>

namespace mergel::fem::test {

/// Boundary ids of a box, as deal.II colours it.
enum Side : dealii::types::boundary_id { x_low, x_high, y_low, y_high, z_low, z_high };

/// Box [0, size] of n cells with one boundary id per side.
inline void make_box(const Vec3& size, const std::array<unsigned int, 3>& n,
                     dealii::Triangulation<3>& mesh)
{
  dealii::GridGenerator::subdivided_hyper_rectangle(
      mesh, {n[0], n[1], n[2]}, dealii::Point<3>(),
      dealii::Point<3>(size.x(), size.y(), size.z()), true);
}

/// Nodal forces of the traction t(x, n) [Pa] on one side.
template <class Traction>
NodalField traction_forces(const ElasticSolid& solid, dealii::types::boundary_id id,
                           Traction&& t)
{
  NodalField f = NodalField::Zero(4, static_cast<Eigen::Index>(solid.discrete().n_nodes()));
  dealii::FEFaceValues<3> values(solid.dofs().get_fe(), dealii::QGauss<2>(2),
                                 dealii::update_values | dealii::update_normal_vectors |
                                     dealii::update_quadrature_points |
                                     dealii::update_JxW_values);
  for (const auto& cell : solid.dofs().active_cell_iterators())
    for (const unsigned int face : cell->face_indices()) {
      if (!cell->face(face)->at_boundary() || cell->face(face)->boundary_id() != id)
        continue;
      values.reinit(cell, face);
      for (const unsigned int q : values.quadrature_point_indices()) {
        const auto x = values.quadrature_point(q);
        const auto n = values.normal_vector(q);
        const Vec3 traction = t(Vec3(x[0], x[1], x[2]), Vec3(n[0], n[1], n[2]));
        for (unsigned int v = 0; v < 8; ++v)
          f.col(ElasticSolid::node(cell, v)).head<3>() +=
              (traction * (values.shape_value(3 * v, q) * values.JxW(q))).array();
      }
    }
  return f;
}

/// The nodal field g(x).
template <class G>
NodalField sample(const ElasticSolid& solid, G&& g)
{
  NodalField field =
      NodalField::Zero(4, static_cast<Eigen::Index>(solid.discrete().n_nodes()));
  for (std::size_t a = 0; a < solid.discrete().n_nodes(); ++a)
    field.col(static_cast<Eigen::Index>(a)).head<3>() = g(solid.discrete().x[a]).array();
  return field;
}

/// K^-1 f by Cholesky factors: another way to a static solution.
/// @param f in the supports
inline NodalField solve_directly(const BlockMatrix& K, const NodalField& f)
{
  const auto n = static_cast<int>(3 * K.n_rows());
  std::vector<Eigen::Triplet<double>> upper;
  K.for_each([&](std::uint32_t i, std::uint32_t j, const Mat3& B) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        upper.emplace_back(static_cast<int>(3 * i) + r, static_cast<int>(3 * j) + c,
                           B(r, c));
  });
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(upper.begin(), upper.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Upper> factors(A);
  const Eigen::MatrixXd u = factors.solve(f.topRows<3>().matrix().reshaped());
  NodalField field = NodalField::Zero(4, f.cols());
  field.topRows<3>() = u.reshaped(3, f.cols()).array();
  return field;
}

/// Columns of the given nodes as a list of vectors.
inline std::vector<Vec3> pick(const NodalField& field,
                              const std::vector<std::uint32_t>& nodes)
{
  std::vector<Vec3> list;
  for (const auto a : nodes) list.push_back(at(field, a));
  return list;
}

/// Every node, in order.
inline std::vector<std::uint32_t> all_nodes(const ElasticSolid& solid)
{
  std::vector<std::uint32_t> nodes(solid.discrete().n_nodes());
  for (std::uint32_t a = 0; a < nodes.size(); ++a) nodes[a] = a;
  return nodes;
}

} // namespace mergel::fem::test
