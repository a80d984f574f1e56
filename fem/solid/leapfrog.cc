#include "fem/solid/leapfrog.h"

#include "fem/node_lanes.h"

#include <algorithm>
#include <stdexcept>
#include <string>
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
  now_.u = now_.v = now_.Ku = now_.f_interface = next_Ku_ = NodalField::Zero(4, n);
  is_loaded_.assign(solid.n_nodes(), 0);
  for (const auto a : loaded_) is_loaded_[a] = 1;
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

struct Leapfrog::Powers {
  NodeLanes interface = {0.0, 0.0, 0.0, 0.0}, gravity = interface, initial = interface,
            damping = interface; ///< times the duration of the kick [J]

  void add_to(Energies& e) const
  {
    e.interface_work += sum(interface);
    e.gravity_work += sum(gravity);
    e.initial_stress_work += sum(initial);
    e.damping += sum(damping);
  }
};

/// The velocity of a node after its kick: by the interface force over dt_kick, by its own
/// forces over window_kick. Damping sees all forces, and acts with the latter. The velocity of
/// a loaded node saws in a window: the sign of its motion is that of the mean.
NodeLanes Leapfrog::kicked(Eigen::Index a, double dt_kick, double window_kick,
                           Powers& sum) const
{
  const NodeLanes zero = {0.0, 0.0, 0.0, 0.0};
  const NodeLanes f_interface = load(now_.f_interface, a),
                  f_gravity = load(solid_.f_gravity, a),
                  f_initial = load(solid_.f_initial, a), v = load(now_.v, a);
  const NodeLanes own = f_gravity - f_initial - load(now_.Ku, a), f_a = f_interface + own;
  const NodeLanes drag = alpha_ * (f_a < 0.0 ? -f_a : f_a);
  const double saw = is_loaded_[static_cast<std::size_t>(a)] ? window_kick - dt_kick : 0.0;
  const NodeLanes motion = v + own * (0.5 * saw * inverse_m_[a]);
  const NodeLanes f_damping = motion > 0.0 ? drag : (motion < 0.0 ? -drag : zero);
  const NodeLanes impulse = f_interface * dt_kick + (own - f_damping) * window_kick;
  const NodeLanes v_new = v + impulse * inverse_m_[a];

  const NodeLanes v_mean = 0.5 * (v + v_new);
  sum.interface += f_interface * v_mean * dt_kick;
  sum.gravity += f_gravity * v_mean * window_kick;
  sum.initial -= f_initial * v_mean * window_kick;
  sum.damping += f_damping * v_mean * window_kick;
  return v_new;
}

void Leapfrog::kick_all(double dt_kick, double window_kick)
{
  Powers powers;
  const auto n = static_cast<Eigen::Index>(solid_.n_nodes());
  for (Eigen::Index a = 0; a < n; ++a)
    store(now_.v, a, kicked(a, dt_kick, window_kick, powers));
  // Component-wise damping leaves the range of an oblique P. The part that P removes here
  // is normal to the old and the new velocity, so the works above do not change.
  for (const auto a : solid_.oblique)
    now_.v.col(a).head<3>() = (solid_.P[a] * at(now_.v, a)).array();
  powers.add_to(now_.energy);
}

void Leapfrog::kick_loaded(double dt_kick)
{
  NodeLanes work = {0.0, 0.0, 0.0, 0.0};
  for (const auto a : loaded_) { // forces and velocities are in the range of P
    const NodeLanes f = load(now_.f_interface, a), v = load(now_.v, a);
    const NodeLanes v_new = v + f * (dt_kick * inverse_m_[a]);
    work += f * (0.5 * dt_kick) * (v + v_new);
    store(now_.v, a, v_new);
  }
  now_.energy.interface_work += sum(work);
}

/// Loaded nodes at every step, all others at the end of the window.
void Leapfrog::drift(double dt)
{
  const bool is_end = now_.n_left == 0;
  if (is_end && now_.since == dt) { // the window is this step
    now_.u += dt * now_.v;
    return;
  }
  for (const auto a : loaded_) now_.u.col(a) += dt * now_.v.col(a);
  if (!is_end) return;
  const auto n = static_cast<Eigen::Index>(solid_.n_nodes());
  for (Eigen::Index a = 0; a < n; ++a)
    if (!is_loaded_[static_cast<std::size_t>(a)])
      now_.u.col(a) += now_.since * now_.v.col(a);
}

void Leapfrog::step(double dt, std::span<const Vec3> f)
{
  load_interface_forces(f);
  const double dt_kick = now_.dt > 0.0 ? 0.5 * (now_.dt + dt) : dt;
  if (now_.n_left == 0) {
    if (!is_product_begun_) product_.start(now_.u, next_Ku_);
    product_.finish();
    is_product_begun_ = false;
    std::swap(now_.Ku, next_Ku_);
    // From rest a window of one step: the saw of the next ones is then even about rest.
    const std::size_t s = now_.since > 0.0 ? now_.subcycle : 1;
    const double window = dt * static_cast<double>(s);
    // What is left of the last window, which may have become another than was planned, and
    // half of the next.
    kick_all(dt_kick,
             now_.since > 0.0 ? now_.since - 0.5 * now_.window + 0.5 * window : window);
    now_.n_left = s;
    now_.window = window;
    now_.since = 0.0;
    now_.energy.strain = 0.5 * (dot(now_.Ku, now_.u) + window * dot(now_.Ku, now_.v));
  } else {
    kick_loaded(dt_kick);
  }
  now_.since += dt;
  --now_.n_left;
  drift(dt);
  now_.dt = dt;
  if (now_.n_left > 0) return;
  product_.start(now_.u, next_Ku_); // on its way while the particles move
  is_product_begun_ = true;
}

/// What moves on starts a window, with its own product.
void Leapfrog::begin_again()
{
  product_.finish();
  is_product_begun_ = false;
}

void Leapfrog::rest_at(const NodalField& u, std::span<const Vec3> f)
{
  load_interface_forces(f);
  begin_again();
  now_.u = u;
  now_.v.setZero();
  solid_.K.multiply(now_.u, now_.Ku);
  now_.dt = now_.window = now_.since = 0.0;
  now_.n_left = 0;
  now_.energy = {};
  now_.energy.strain = 0.5 * dot(now_.Ku, now_.u);
}

void Leapfrog::set_masses(const Eigen::ArrayXd& m)
{
  begin_again();
  now_.m = m;
  inverse_m_ = m.inverse();
  now_.v.setZero();
  now_.dt = now_.window = now_.since = 0.0;
  now_.n_left = 0;
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
  if (state.subcycle < 1 || state.n_left > std::max<std::size_t>(state.subcycle, 64))
    throw std::invalid_argument("state of the far field: no such step of a window");
  begin_again();
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
