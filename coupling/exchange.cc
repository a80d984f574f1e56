#include "coupling/exchange.h"

#include "dem/timer.h"

#include <cmath>

namespace mergel::coupling {

Exchange::Exchange(Transfer transfer, Structure& structure)
    : transfer_(std::move(transfer)), structure_(structure)
{
}

const Nodal& Exchange::sum_forces(const dem::Wall& wall)
{
  const double start = dem::wall_clock();
  Nodal& f = transfer_.is_identity() ? f_s_ : f_wall_;
  f.resize(wall.f.size());
  const auto [first, end] = wall.f.own();
  for (std::size_t k = first; k < end; ++k) f[k] = wall.f.value(k);
  if (!transfer_.is_identity()) transfer_.to_structure(f_wall_, f_s_);
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
  if (transfer_.is_identity()) {
    structure_.velocities(wall.v);
  } else {
    structure_.velocities(v_s_);
    transfer_.to_wall(v_s_, wall.v);
  }
  const auto n = static_cast<Eigen::Index>(3 * wall.x.size());
  Eigen::Map<Eigen::ArrayXd> x(wall.x.front().data(), n), v(wall.v.front().data(), n);
  if (!std::isfinite(v.sum()))
    throw NumericalError("a structure moves without bound: the run is unstable");
  x += dt * v;
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
