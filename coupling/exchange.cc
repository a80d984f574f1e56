#include "coupling/exchange.h"

#include "dem/assembly/step.h"
#include "dem/timer.h"

#include <cmath>
#include <map>

namespace mergel::coupling {

namespace {

std::size_t uz(int i)
{
  return static_cast<std::size_t>(i);
}

} // namespace

Interface make_interface(const fem::InterfaceMesh& mesh, const dem::ContactLaw& material,
                         double collar_height)
{
  std::vector<dem::Vec3> x = mesh.x;
  std::vector<dem::Triangle> triangles = mesh.triangles;
  std::vector<int> follows(x.size()); // far-field node of each wall node
  for (std::size_t k = 0; k < x.size(); ++k) follows[k] = static_cast<int>(k);

  if (collar_height > 0.0) {
    // The rim at z = 0: edges of one triangle only, with both ends in the surface.
    const auto in_surface = [&](int k) {
      return std::abs(mesh.x[uz(k)].z()) < fem::coincidence * mesh.x[uz(k)].norm();
    };
    std::map<int, int> raised;
    const auto raise = [&](int k) {
      const auto [entry, is_new] = raised.try_emplace(k, static_cast<int>(x.size()));
      if (is_new) {
        x.push_back(mesh.x[uz(k)] + dem::Vec3(0.0, 0.0, collar_height));
        follows.push_back(k);
      }
      return entry->second;
    };
    for (const dem::Triangle& t : mesh.triangles)
      for (std::size_t e = 0; e < 3; ++e) {
        const int a = t[e], b = t[(e + 1) % 3];
        if (!in_surface(a) || !in_surface(b)) continue;
        const int a_up = raise(a), b_up = raise(b);
        // The edge reversed: the normal is on the same side as that of the triangle below.
        triangles.push_back({b, a, a_up});
        triangles.push_back({b, a_up, b_up});
      }
  }

  Eigen::SparseMatrix<double, Eigen::RowMajor> N(static_cast<Eigen::Index>(x.size()),
                                                 static_cast<Eigen::Index>(mesh.x.size()));
  for (std::size_t k = 0; k < x.size(); ++k)
    N.insert(static_cast<Eigen::Index>(k), follows[k]) = 1.0;
  return {dem::make_wall(x, std::move(triangles), material), Transfer(std::move(N))};
}

Exchange::Exchange(Transfer transfer, fem::FarField& far_field)
    : transfer_(std::move(transfer)), far_field_(far_field)
{
}

const Nodal& Exchange::sum_forces(const dem::Wall& wall)
{
  f_dem_.resize(wall.f.size());
  for (std::size_t k = 0; k < wall.f.size(); ++k) f_dem_[k] = wall.f[k].value();
  transfer_.to_fem(f_dem_, f_fem_);
  return f_fem_;
}

Nodal Exchange::settle(dem::Wall& wall)
{
  far_field_.solve_static(sum_forces(wall));
  far_field_.interface_displacement(v_fem_); // v_fem_ as buffer
  Nodal u;
  transfer_.to_dem(v_fem_, u);
  for (std::size_t k = 0; k < u.size(); ++k) {
    wall.x[k] += u[k];
    wall.v[k].setZero();
  }
  far_field_.interface_velocity(v_fem_);
  return u;
}

void Exchange::step(dem::Wall& wall, double dt)
{
  const double start = dem::wall_clock();
  sum_forces(wall);
  const double up = dem::wall_clock();
  far_field_.step(dt, f_fem_);
  const double moved = dem::wall_clock();
  far_field_.interface_velocity(v_fem_);
  transfer_.to_dem(v_fem_, wall.v);
  for (std::size_t k = 0; k < wall.x.size(); ++k) wall.x[k] += dt * wall.v[k];
  const double end = dem::wall_clock();
  far_field_seconds += moved - up;
  exchange_seconds += (up - start) + (end - moved);
}

dem::Vec3 interpolate_inside(const Nodal& x, const Nodal& u, const dem::Vec3& at)
{
  double sum = 0.0;
  dem::Vec3 mean = dem::Vec3::Zero();
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double d = (x[k] - at).norm();
    if (d == 0.0) return u[k];
    const double w = 1.0 / (d * d * d);
    sum += w;
    mean += w * u[k];
  }
  return sum > 0.0 ? dem::Vec3(mean / sum) : dem::Vec3::Zero();
}

} // namespace mergel::coupling
