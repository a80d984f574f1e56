/// An elastic solid of any mesh as a structure, whose interface is one of its plane sides.
#pragma once

#include "coupling/structure.h"
#include "fem/dealii/elastic_solid.h"
#include "fem/solid/leapfrog.h"

namespace mergel::coupling::test {

/// Has no static solution, no settling and no checkpoint: for motions from a given state.
class SolidStructure final : public Structure {
public:
  /// @param id boundary id of the interface, whose faces have the outward normal `n`
  SolidStructure(const dealii::Triangulation<3>& mesh, fem::SolidProperties properties,
                 const fem::Supports& supports, dealii::types::boundary_id id,
                 const dem::Vec3& n)
      : solid_(mesh, std::move(properties), supports), nodes_(solid_.nodes_on(id)),
        motion_(solid_.discrete(), 0.0, nodes_)
  {
    std::vector<dem::Vec3> x;
    for (const auto a : nodes_) x.push_back(solid_.discrete().x[a]);
    std::vector<dem::Triangle> triangles;
    for (const auto& cell : solid_.dofs().active_cell_iterators())
      for (const unsigned int f : cell->face_indices()) {
        const auto face = cell->face(f);
        if (!face->at_boundary() || face->boundary_id() != id) continue;
        std::array<int, 4> k{};
        constexpr std::array<unsigned int, 4> around = {0, 1, 3, 2};
        for (std::size_t c = 0; c < 4; ++c)
          k[c] =
              static_cast<int>(std::lower_bound(nodes_.begin(), nodes_.end(),
                                                face->vertex_dof_index(around[c], 0) / 3) -
                               nodes_.begin());
        const auto at = [&](std::size_t c) { return x[static_cast<std::size_t>(k[c])]; };
        if ((at(1) - at(0)).cross(at(2) - at(0)).dot(n) < 0.0) std::swap(k[1], k[3]);
        triangles.push_back({k[0], k[1], k[2]});
        triangles.push_back({k[0], k[2], k[3]});
      }
    x_ = x;
    triangles_ = triangles;
  }

  const fem::ElasticSolid& solid() const { return solid_; }
  const fem::NodalMotion& motion() const { return motion_.motion(); }

  Interface interface(const dem::ContactLaw& contact) const override
  {
    Eigen::SparseMatrix<double, Eigen::RowMajor> N(static_cast<Eigen::Index>(x_.size()),
                                                   static_cast<Eigen::Index>(x_.size()));
    N.setIdentity();
    return {dem::make_wall(x_, triangles_, contact), Transfer(N)};
  }
  bool moves() const override { return true; }
  void positions(Nodal& x) const override
  {
    x.resize(x_.size());
    for (std::size_t k = 0; k < x.size(); ++k)
      x[k] = x_[k] + fem::at(motion().u, nodes_[k]);
  }
  void velocities(Nodal& v) const override
  {
    v.resize(x_.size());
    for (std::size_t k = 0; k < v.size(); ++k) v[k] = fem::at(motion().v, nodes_[k]);
  }
  void step(double dt, const Nodal& f) override { motion_.step(dt, f); }
  std::optional<Nodal> solve_static(const Nodal&) override { return std::nullopt; }
  void equalise_frequencies(double, std::span<const double>) override {}
  void restore_masses() override {}
  void choose_subcycle(double, std::span<const double>, double, std::size_t) override {}
  Subcycle subcycle() const override { return {}; }
  double damping() const override { return 0.0; }
  std::size_t n_amplitudes() const override { return 3 * solid_.discrete().n_nodes(); }
  void move(std::span<const double> y, Nodal& u) const override
  {
    u.clear();
    for (const auto a : nodes_) u.push_back(motion_of(y, a));
  }
  void multiply(std::span<const double> y, const Nodal& f,
                std::span<double> to) const override
  {
    const fem::DiscreteSolid& s = solid_.discrete();
    fem::NodalField u = fem::NodalField::Zero(4, s.m.size()), Ku = u;
    for (std::size_t a = 0; a < s.n_nodes(); ++a)
      u.col(static_cast<Eigen::Index>(a)).head<3>() = motion_of(y, a).array();
    s.K.multiply(u, Ku);
    for (std::size_t k = 0; k < f.size(); ++k) Ku.col(nodes_[k]).head<3>() += f[k].array();
    for (std::size_t a = 0; a < s.n_nodes(); ++a) {
      const auto column = static_cast<Eigen::Index>(a);
      const dem::Vec3 g = s.P[a] * fem::at(Ku, column) / std::sqrt(s.m(column));
      for (std::size_t c = 0; c < 3; ++c) to[3 * a + c] = g[static_cast<int>(c)];
    }
  }
  double unbalanced_ratio() const override { return motion_.unbalanced_ratio(); }
  StructureEnergies energies() const override
  {
    const fem::Energies e = motion_.energies();
    return {e.kinetic, e.strain, e.interface_work, 0.0, e.initial_stress_work, e.damping};
  }
  void save(dem::State&, const std::string&) const override {}
  void load(const dem::State&, const std::string&) override {}

private:
  dem::Vec3 motion_of(std::span<const double> y, std::size_t a) const
  {
    const fem::DiscreteSolid& s = solid_.discrete();
    return s.P[a] * dem::Vec3(y[3 * a], y[3 * a + 1], y[3 * a + 2]) /
           std::sqrt(s.m(static_cast<Eigen::Index>(a)));
  }

  fem::ElasticSolid solid_;
  std::vector<std::uint32_t> nodes_; ///< of the interface
  std::vector<dem::Vec3> x_;
  std::vector<dem::Triangle> triangles_;
  fem::Leapfrog motion_;
};

} // namespace mergel::coupling::test
