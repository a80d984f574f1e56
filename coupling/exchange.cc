#include "coupling/exchange.h"

#include "dem/timer.h"

namespace mergel::coupling {

Exchange::Exchange(Transfer transfer, Structure& structure)
    : transfer_(std::move(transfer)), structure_(structure)
{
}

const Nodal& Exchange::sum_forces(const dem::Wall& wall)
{
  const double start = dem::wall_clock();
  f_wall_.resize(wall.f.size());
  for (std::size_t k = 0; k < wall.f.size(); ++k) f_wall_[k] = wall.f.value(k);
  transfer_.to_structure(f_wall_, f_s_);
  exchange_seconds += dem::wall_clock() - start;
  return f_s_;
}

void Exchange::step_structure(double dt)
{
  const double start = dem::wall_clock();
  structure_.step(dt, f_s_);
  structure_seconds += dem::wall_clock() - start;
}

void Exchange::move_wall(dem::Wall& wall, double dt)
{
  const double start = dem::wall_clock();
  structure_.velocities(v_s_);
  transfer_.to_wall(v_s_, wall.v);
  for (std::size_t k = 0; k < wall.x.size(); ++k) wall.x[k] += dt * wall.v[k];
  exchange_seconds += dem::wall_clock() - start;
}

std::optional<Nodal> Exchange::settle(dem::Wall& wall)
{
  const std::optional<Nodal> u_s = structure_.solve_static(sum_forces(wall));
  if (!u_s) return std::nullopt;
  Nodal u;
  transfer_.to_wall(*u_s, u);
  for (std::size_t k = 0; k < u.size(); ++k) {
    wall.x[k] += u[k];
    wall.v[k].setZero();
  }
  return u;
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
