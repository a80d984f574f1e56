#include "coupling/interface_balance.h"

#include <cmath>

namespace mergel::coupling {

InterfaceBalance interface_balance(Exchange& exchange, const dem::Wall& wall,
                                   const Nodal& x_fem, const dem::Communicator& comm)
{
  dem::WallSums sums = dem::sum_contact_forces(wall);
  dem::ExactReduction all;
  all.add(sums.force);
  all.add(sums.moment);
  all.add(sums.power);
  all.run(comm);
  const Nodal& f_fem = exchange.sum_forces(wall);
  const Nodal& v_fem = exchange.far_field_velocities();

  // Forces on the far field and on the particles sum to zero.
  dem::Vec3 force = sums.force.value(), moment = sums.moment.value();
  double power = 0.0, sum_f = 0.0, sum_m = 0.0, sum_p = 0.0;
  for (std::size_t k = 0; k < wall.f.size(); ++k) {
    const dem::Vec3 f = wall.f[k].value();
    sum_f += f.norm();
    sum_m += wall.x[k].norm() * f.norm();
    sum_p += wall.v[k].norm() * f.norm();
  }
  for (std::size_t k = 0; k < f_fem.size(); ++k) {
    force += f_fem[k];
    moment += x_fem[k].cross(f_fem[k]);
    if (!v_fem.empty()) power += f_fem[k].dot(v_fem[k]);
  }
  const auto share = [](double part, double whole) {
    return whole > 0.0 ? part / whole : 0.0;
  };
  return {share(force.norm(), sum_f), share(moment.norm(), sum_m),
          share(std::abs(power - sums.power.value()), sum_p)};
}

} // namespace mergel::coupling
