#include "fem/solid/leapfrog.h"

#include <cstring>
#include <stdexcept>
#include <utility>

namespace mergel::fem {

Leapfrog::Leapfrog(const DiscreteSolid& solid, double alpha,
                   std::vector<std::uint32_t> loaded, MPI_Comm comm)
    : solid_(solid), product_(solid.K, comm), alpha_(alpha), loaded_(std::move(loaded))
{
  if (!(alpha >= 0.0 && alpha < 1.0))
    throw std::invalid_argument("local damping of the solid = " + std::to_string(alpha) +
                                ": must satisfy 0 <= damping < 1");
  const auto n = static_cast<Eigen::Index>(solid.n_nodes());
  now_.u = now_.v = now_.Ku = now_.f_interface = NodalField::Zero(4, n);
  set_masses(solid.m);
}

void Leapfrog::load_interface_forces(std::span<const Vec3> f)
{
  if (f.size() != loaded_.size())
    throw std::invalid_argument("interface forces: " + std::to_string(f.size()) +
                                " given, one for each of " +
                                std::to_string(loaded_.size()) + " nodes needed");
  for (std::size_t k = 0; k < f.size(); ++k) {
    const auto a = loaded_[k];
    now_.f_interface.col(a).head<3>() = (solid_.P[a] * f[k]).array();
  }
}

void Leapfrog::step(double dt, std::span<const Vec3> f)
{
  load_interface_forces(f);
  product_.multiply(now_.u, now_.Ku);

  const double dt_kick = now_.dt > 0.0 ? 0.5 * (now_.dt + dt) : dt;
  const auto n = static_cast<Eigen::Index>(solid_.n_nodes());
  const NodeLanes zero = {0.0, 0.0, 0.0, 0.0};
  NodeLanes power_interface = zero, power_gravity = zero, power_initial = zero,
            power_damping = zero;

  const auto load = [](NodeLanes& lanes, const NodalField& field, Eigen::Index a) {
    std::memcpy(&lanes, field.data() + 4 * a, sizeof lanes);
  };
  for (Eigen::Index a = 0; a < n; ++a) {
    NodeLanes f_interface, f_gravity, f_initial, Ku, v;
    load(f_interface, now_.f_interface, a);
    load(f_gravity, solid_.f_gravity, a);
    load(f_initial, solid_.f_initial, a);
    load(Ku, now_.Ku, a);
    load(v, now_.v, a);

    const NodeLanes f_a = f_interface + f_gravity - f_initial - Ku;
    const NodeLanes drag = alpha_ * (f_a < 0.0 ? -f_a : f_a);
    const NodeLanes f_damping = v > 0.0 ? drag : (v < 0.0 ? -drag : zero);
    const NodeLanes v_new = v + (f_a - f_damping) * (dt_kick * inverse_m_[a]);

    const NodeLanes v_mean = 0.5 * (v + v_new);
    power_interface += f_interface * v_mean;
    power_gravity += f_gravity * v_mean;
    power_initial -= f_initial * v_mean;
    power_damping += f_damping * v_mean;
    std::memcpy(now_.v.data() + 4 * a, &v_new, sizeof v_new);
  }
  // Component-wise damping leaves the range of an oblique P. The part that P removes here
  // is normal to the old and the new velocity, so the works above do not change.
  for (const auto a : solid_.oblique)
    now_.v.col(a).head<3>() = (solid_.P[a] * at(now_.v, a)).array();

  NodeLanes strain = zero;
  for (Eigen::Index a = 0; a < n; ++a) {
    NodeLanes u, v, Ku;
    load(u, now_.u, a);
    load(v, now_.v, a);
    load(Ku, now_.Ku, a);
    u += dt * v;
    strain += Ku * u;
    std::memcpy(now_.u.data() + 4 * a, &u, sizeof u);
  }

  const auto sum = [](const NodeLanes& s) { return (s[0] + s[1]) + s[2]; };
  now_.energy.strain = 0.5 * sum(strain);
  now_.energy.interface_work += dt_kick * sum(power_interface);
  now_.energy.gravity_work += dt_kick * sum(power_gravity);
  now_.energy.initial_stress_work += dt_kick * sum(power_initial);
  now_.energy.damping += dt_kick * sum(power_damping);
  now_.dt = dt;
}

void Leapfrog::rest_at(const NodalField& u, std::span<const Vec3> f)
{
  load_interface_forces(f);
  now_.u = u;
  now_.v.setZero();
  solid_.K.multiply(now_.u, now_.Ku);
  now_.dt = 0.0;
  now_.energy = {};
  now_.energy.strain = 0.5 * dot(now_.Ku, now_.u);
}

void Leapfrog::set_masses(const Eigen::ArrayXd& m)
{
  now_.m = m;
  inverse_m_ = m.inverse();
  now_.v.setZero();
  now_.dt = 0.0;
}

void Leapfrog::restore(NodalMotion state)
{
  const auto n = static_cast<Eigen::Index>(solid_.n_nodes());
  for (const NodalField* field : {&state.u, &state.v, &state.Ku, &state.f_interface})
    if (field->cols() != n)
      throw std::invalid_argument(
          "state of the far field: " + std::to_string(field->cols()) +
          " nodes, the mesh has " + std::to_string(n) +
          "; restart with the mesh of the first run");
  if (state.m.size() != n || !(state.m > 0.0).all())
    throw std::invalid_argument("state of the far field: a node without mass");
  now_ = std::move(state);
  inverse_m_ = now_.m.inverse();
}

Energies Leapfrog::energies() const
{
  Energies e = now_.energy;
  e.kinetic = 0.5 * (now_.v.square().colwise().sum() * now_.m.transpose()).sum();
  return e;
}

double Leapfrog::unbalanced_ratio() const
{
  const auto size = [](const NodalField& f) { return f.matrix().colwise().norm().sum(); };
  const NodalField f = now_.f_interface + solid_.f_gravity - solid_.f_initial - now_.Ku;
  const double scale = size(now_.f_interface) + size(solid_.f_gravity) +
                       size(solid_.f_initial) + size(now_.Ku);
  return scale > 0.0 ? size(f) / scale : 0.0;
}

} // namespace mergel::fem
