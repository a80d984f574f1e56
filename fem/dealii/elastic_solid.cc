#include "fem/dealii/elastic_solid.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

namespace mergel::fem {
namespace {

constexpr unsigned int n_vertices = dealii::GeometryInfo<3>::vertices_per_cell;

const dealii::QGauss<3> cell_quadrature(2);
const dealii::QGauss<2> face_quadrature(2);

/// Projector onto the directions that a set of unit normals leaves free.
Mat3 free_directions(const std::vector<Vec3>& normals)
{
  Mat3 P = Mat3::Identity();
  for (const Vec3& n : normals) {
    // Gram-Schmidt; a normal within 0.1 degree of the span of the others is ignored.
    constexpr double same_direction = 2e-3;
    const Vec3 rest = P * n;
    if (rest.norm() > same_direction) P -= rest * rest.transpose() / rest.squaredNorm();
  }
  // Set entries of the size of round-off to zero, so that a fixed axis is fixed exactly.
  return P.unaryExpr([](double p) { return std::abs(p) < 1e-12 ? 0.0 : p; });
}

} // namespace

ElasticSolid::ElasticSolid(const dealii::Triangulation<3>& mesh, SolidProperties properties,
                           const Supports& supports)
    : properties_(std::move(properties)), fe_(dealii::FE_Q<3>(1), 3), dofs_(mesh)
{
  dofs_.distribute_dofs(fe_);
  const std::size_t n = dofs_.n_dofs() / 3;
  discrete_.x.resize(n);
  for (const auto& cell : dofs_.active_cell_iterators())
    for (unsigned int v = 0; v < n_vertices; ++v)
      for (unsigned int c = 0; c < 3; ++c)
        discrete_.x[node(cell, v)][c] = cell->vertex(v)[c];
  set_supports(supports);
  set_pattern();
  assemble();
  add_pressures();
}

void ElasticSolid::set_supports(const Supports& supports)
{
  const std::size_t n = discrete_.n_nodes();
  std::vector<bool> is_fixed(n, false);
  std::vector<std::vector<Vec3>> normals(n);

  dealii::FEFaceValues<3> face_values(
      fe_, face_quadrature, dealii::update_normal_vectors | dealii::update_JxW_values);
  for (const auto& [id, support] : supports) {
    std::map<std::uint32_t, Vec3> normal; // int n dA of the node's faces with this id
    for (const auto& cell : dofs_.active_cell_iterators())
      for (const unsigned int f : cell->face_indices()) {
        if (!cell->face(f)->at_boundary() || cell->face(f)->boundary_id() != id) continue;
        face_values.reinit(cell, f);
        Vec3 area = Vec3::Zero();
        for (const unsigned int q : face_values.quadrature_point_indices())
          for (int c = 0; c < 3; ++c)
            area[c] += face_values.normal_vector(q)[c] * face_values.JxW(q);
        for (const unsigned int v : cell->face(f)->vertex_indices()) {
          const auto a = cell->face(f)->vertex_dof_index(v, 0) / 3;
          normal.try_emplace(a, Vec3::Zero()).first->second += area;
        }
      }
    if (normal.empty())
      throw std::invalid_argument("support on boundary id " + std::to_string(id) +
                                  ": no face of the mesh has this id");
    for (const auto& [a, area] : normal) {
      if (support == Support::fixed) is_fixed[a] = true;
      if (support == Support::roller) normals[a].push_back(area.normalized());
    }
  }

  discrete_.P.resize(n);
  for (std::uint32_t a = 0; a < n; ++a) {
    Mat3& P = discrete_.P[a];
    P = is_fixed[a] ? Mat3::Zero() : free_directions(normals[a]);
    if (!P.isDiagonal(0.0)) discrete_.oblique.push_back(a);
  }
}

void ElasticSolid::set_pattern()
{
  // A block P_a K_ab P_b is left out where either node cannot move.
  const std::size_t n = discrete_.n_nodes();
  std::vector<std::set<std::uint32_t>> neighbours(n);
  for (const auto& cell : dofs_.active_cell_iterators())
    for (unsigned int v = 0; v < n_vertices; ++v)
      for (unsigned int w = 0; w < n_vertices; ++w) {
        const auto a = node(cell, v), b = node(cell, w);
        if (a < b && !discrete_.P[a].isZero(0.0) && !discrete_.P[b].isZero(0.0))
          neighbours[a].insert(b);
      }
  std::vector<std::vector<std::uint32_t>> upper(n);
  for (std::size_t a = 0; a < n; ++a)
    upper[a].assign(neighbours[a].begin(), neighbours[a].end());
  discrete_.K = BlockMatrix(upper);
}

void ElasticSolid::assemble()
{
  const std::size_t n = discrete_.n_nodes();
  const auto columns = static_cast<Eigen::Index>(n);
  DiscreteSolid& s = discrete_;
  s.m = Eigen::ArrayXd::Zero(columns);
  s.f_gravity = s.f_initial = NodalField::Zero(4, columns);
  std::vector<Mat3> K_aa(n, Mat3::Zero()); // without supports

  const auto C = elasticity_tensor(properties_.elastic);
  dealii::FEValues<3> fe_values(fe_, cell_quadrature,
                                dealii::update_values | dealii::update_gradients |
                                    dealii::update_quadrature_points |
                                    dealii::update_JxW_values);
  const dealii::FEValuesExtractors::Vector u(0);
  const unsigned int n_dofs = fe_.n_dofs_per_cell();
  dealii::FullMatrix<double> K(n_dofs, n_dofs);
  std::vector<double> f_initial(n_dofs);
  std::array<double, n_vertices> m{};

  // Local unknowns of Q1 are ordered by vertex: 3 v + c is component c at vertex v.
  for (const auto& cell : dofs_.active_cell_iterators()) {
    fe_values.reinit(cell);
    K = 0.0;
    std::fill(f_initial.begin(), f_initial.end(), 0.0);
    m.fill(0.0);

    // a(v, u) = int eps(v) : C : eps(u) dx
    for (const unsigned int q : fe_values.quadrature_point_indices()) {
      const double dx = fe_values.JxW(q);
      for (const unsigned int i : fe_values.dof_indices()) {
        const auto sigma_i = C * fe_values[u].symmetric_gradient(i, q);
        for (const unsigned int j : fe_values.dof_indices())
          K(i, j) += sigma_i * fe_values[u].symmetric_gradient(j, q) * dx;
      }
      if (properties_.initial_stress) {
        const auto sigma_0 = properties_.initial_stress(fe_values.quadrature_point(q));
        for (const unsigned int i : fe_values.dof_indices())
          f_initial[i] += sigma_0 * fe_values[u].symmetric_gradient(i, q) * dx;
      }
      for (unsigned int v = 0; v < n_vertices; ++v)
        m[v] += properties_.rho * fe_values.shape_value(3 * v, q) * dx;
    }

    for (unsigned int v = 0; v < n_vertices; ++v) {
      const auto a = node(cell, v);
      s.m(a) += m[v];
      s.f_gravity.col(a).head<3>() += (s.P[a] * properties_.gravity).array() * m[v];
      s.f_initial.col(a).head<3>() +=
          (s.P[a] * Vec3(f_initial[3 * v], f_initial[3 * v + 1], f_initial[3 * v + 2]))
              .array();
      for (unsigned int w = 0; w < n_vertices; ++w) {
        const auto b = node(cell, w);
        Mat3 K_ab;
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int d = 0; d < 3; ++d) K_ab(c, d) = K(3 * v + c, 3 * w + d);
        if (a == b) K_aa[a] += K_ab;
        if (a <= b && (a == b || (!s.P[a].isZero(0.0) && !s.P[b].isZero(0.0))))
          s.K.add(a, b, s.P[a] * K_ab * s.P[b]);
      }
    }
  }

  // kappa: the mean stiffness of the node itself, which does not raise the largest
  // frequency
  for (std::uint32_t a = 0; a < n; ++a)
    s.K.add(a, a, (K_aa[a].trace() / 3.0) * (Mat3::Identity() - s.P[a]));
}

/// f_initial += int p n N dA: what a pressure leaves of the forces of the initial stress.
void ElasticSolid::add_pressures()
{
  dealii::FEFaceValues<3> face_values(
      fe_, face_quadrature,
      dealii::update_values | dealii::update_normal_vectors | dealii::update_JxW_values);
  for (const auto& [id, p] : properties_.pressure) {
    if (p == 0.0) continue;
    for (const auto& cell : dofs_.active_cell_iterators())
      for (const unsigned int f : cell->face_indices()) {
        if (!cell->face(f)->at_boundary() || cell->face(f)->boundary_id() != id) continue;
        face_values.reinit(cell, f);
        for (unsigned int v = 0; v < n_vertices; ++v) {
          Vec3 area = Vec3::Zero(); // int n N dA
          for (const unsigned int q : face_values.quadrature_point_indices())
            for (int c = 0; c < 3; ++c)
              area[c] += face_values.normal_vector(q)[c] *
                         face_values.shape_value(3 * v, q) * face_values.JxW(q);
          const auto a = node(cell, v);
          discrete_.f_initial.col(a).head<3>() += (discrete_.P[a] * (p * area)).array();
        }
      }
  }
}

std::vector<std::uint32_t> ElasticSolid::nodes_on(dealii::types::boundary_id id) const
{
  std::set<std::uint32_t> nodes;
  for (const auto& cell : dofs_.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == id)
        for (const unsigned int v : cell->face(f)->vertex_indices())
          nodes.insert(cell->face(f)->vertex_dof_index(v, 0) / 3);
  return {nodes.begin(), nodes.end()};
}

std::vector<dealii::SymmetricTensor<2, 3>>
ElasticSolid::cell_stress(const NodalField& u) const
{
  const auto C = elasticity_tensor(properties_.elastic);
  dealii::FEValues<3> fe_values(fe_, cell_quadrature,
                                dealii::update_gradients |
                                    dealii::update_quadrature_points |
                                    dealii::update_JxW_values);
  std::vector<dealii::SymmetricTensor<2, 3>> stress;
  stress.reserve(dofs_.get_triangulation().n_active_cells());
  for (const auto& cell : dofs_.active_cell_iterators()) {
    fe_values.reinit(cell);
    dealii::SymmetricTensor<2, 3> sum;
    double volume = 0.0;
    for (const unsigned int q : fe_values.quadrature_point_indices()) {
      dealii::Tensor<2, 3> gradient;
      for (unsigned int v = 0; v < n_vertices; ++v)
        for (unsigned int c = 0; c < 3; ++c)
          gradient[c] += u(c, node(cell, v)) * fe_values.shape_grad(3 * v, q);
      auto sigma = C * dealii::symmetrize(gradient);
      if (properties_.initial_stress)
        sigma += properties_.initial_stress(fe_values.quadrature_point(q));
      sum += sigma * fe_values.JxW(q);
      volume += fe_values.JxW(q);
    }
    stress.push_back(sum / volume); // a cell of a valid mesh has volume > 0
  }
  return stress;
}

} // namespace mergel::fem
