#include "coupling/interface_balance.h"

#include <algorithm>
#include <cmath>

namespace mergel::coupling {

namespace {

/// Of all wall nodes, on every rank.
Nodal gather_forces(const dem::Wall& wall, const dem::Communicator& comm)
{
  Nodal f;
  const auto [first, end] = wall.f.own();
  for (std::size_t k = first; k < end; ++k) f.push_back(wall.f.value(k));
  return wall.f.is_shared() ? comm.gather(f) : f;
}

} // namespace

InterfaceBalance interface_balance(const Exchange& exchange, const dem::Wall& wall,
                                   const dem::Communicator& comm)
{
  dem::WallSums sums = dem::sum_contact_forces(wall);
  dem::ExactReduction all;
  all.add(sums.force);
  all.add(sums.moment);
  all.add(sums.power);
  all.run(comm);
  const Nodal f_wall = gather_forces(wall, comm);
  Nodal f_s, x_s, v_s;
  exchange.transfer().to_structure(f_wall, f_s);
  exchange.structure().positions(x_s);
  exchange.structure().velocities(v_s);

  // Forces on the structure and on the particles sum to zero.
  dem::Vec3 force = sums.force.value(), moment = sums.moment.value();
  double power = 0.0, sum_f = 0.0, sum_m = 0.0, sum_p = 0.0;
  for (std::size_t k = 0; k < f_wall.size(); ++k) {
    const dem::Vec3& f = f_wall[k];
    sum_f += f.norm();
    sum_m += wall.x[k].norm() * f.norm();
    sum_p += wall.v[k].norm() * f.norm();
  }
  for (std::size_t k = 0; k < f_s.size(); ++k) {
    force += f_s[k];
    moment += x_s[k].cross(f_s[k]);
    power += f_s[k].dot(v_s[k]);
  }
  const auto share = [](double part, double whole) {
    return whole > 0.0 ? part / whole : 0.0;
  };
  return {share(force.norm(), sum_f), share(moment.norm(), sum_m),
          share(std::abs(power - sums.power.value()), sum_p)};
}

InterfaceBalance worst(const InterfaceBalance& a, const InterfaceBalance& b)
{
  return {std::max(a.force, b.force), std::max(a.moment, b.moment),
          std::max(a.power, b.power)};
}

} // namespace mergel::coupling
