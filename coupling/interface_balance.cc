#include "coupling/interface_balance.h"

#include <algorithm>
#include <cmath>

namespace mergel::coupling {

InterfaceBalance interface_balance(Exchange& exchange, const dem::Wall& wall,
                                   const dem::Communicator& comm)
{
  dem::WallSums sums = dem::sum_contact_forces(wall);
  dem::ExactReduction all;
  all.add(sums.force);
  all.add(sums.moment);
  all.add(sums.power);
  all.run(comm);
  const Nodal& f_s = exchange.sum_forces(wall);
  Nodal x_s, v_s;
  exchange.structure().positions(x_s);
  exchange.structure().velocities(v_s);

  // Forces on the structure and on the particles sum to zero.
  dem::Vec3 force = sums.force.value(), moment = sums.moment.value();
  double power = 0.0, sum_f = 0.0, sum_m = 0.0, sum_p = 0.0;
  for (std::size_t k = 0; k < wall.f.size(); ++k) {
    const dem::Vec3 f = wall.f.value(k);
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
