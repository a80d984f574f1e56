#include "fem/membrane/membrane_motion.h"

#include "fem/node_lanes.h"

#include <stdexcept>
#include <utility>

namespace mergel::fem {

namespace {

/// Windows after which the work of the pressure is added: it changes little in these.
constexpr std::size_t windows_between_volumes = 50;

/// Work of a pressure p on the side of a tube while its volume changed: the polygons at its
/// ends are not part of it.
double work_on_side(double p, const EnclosedVolume& from, const EnclosedVolume& to)
{
  double of_side = to.V - from.V;
  for (int end = 0; end < 2; ++end)
    of_side -= 0.5 * (from.area[end] + to.area[end]).dot(to.centre[end] - from.centre[end]);
  return -p * of_side;
}

} // namespace

MembraneMotion::MembraneMotion(Membrane membrane, const Tube& tube, double alpha,
                               std::vector<GuidedNodes> guides)
    : membrane_(std::move(membrane)), tube_(tube), alpha_(alpha), guides_(std::move(guides))
{
  if (!(alpha >= 0.0 && alpha < 1.0))
    throw std::invalid_argument("local damping of the membrane = " + std::to_string(alpha) +
                                ": must satisfy 0 <= damping < 1");
  const Eigen::Index n = membrane_.n_nodes();
  now_.v = now_.f_own = now_.f = next_f_own_ = NodalField::Zero(4, n);
  now_.x = membrane_.rest_positions();
  free_ = NodalField::Constant(4, n, 1.0);
  free_.row(3).setZero();
  for (const GuidedNodes& g : guides_)
    for (const int a : g.nodes) {
      if (g.along_z_only)
        free_(2, a) = 0.0;
      else
        free_.col(a).setZero();
    }
  now_.work_volume = enclosed();
  set_masses(membrane_.masses());
}

MembraneMotion::~MembraneMotion()
{
  membrane_.finish(); // may still receive next_f_own_
}

void MembraneMotion::set_masses(const Eigen::ArrayXd& m)
{
  membrane_.finish();
  is_begun_ = false;
  now_.m = m;
  inverse_m_ = m.inverse();
  now_.v.setZero();
  now_.dt = now_.window = now_.since = 0.0;
  now_.n_left = 0;
}

/// Own forces over window_kick, nodal forces over dt_kick. Damping sees both, and acts with
/// the former, against the mean motion in a window.
void MembraneMotion::kick(double dt_kick, double window_kick)
{
  const NodeLanes zero{};
  NodeLanes load_work{}, damping{};
  const bool takes_own = window_kick > 0.0;
  const double saw = window_kick - dt_kick;
  for (Eigen::Index a = 0; a < membrane_.n_nodes(); ++a) {
    const NodeLanes f = load(now_.f, a), v = load(now_.v, a), is_free = load(free_, a);
    NodeLanes impulse = f * dt_kick, lost{};
    if (takes_own) {
      const NodeLanes own = load(now_.f_own, a), all = f + own;
      const NodeLanes drag = alpha_ * (all < 0.0 ? -all : all) * is_free;
      const NodeLanes motion = v + own * (0.5 * saw * inverse_m_[a]);
      const NodeLanes f_damping = motion > 0.0 ? drag : (motion < 0.0 ? -drag : zero);
      impulse += (own - f_damping) * window_kick;
      lost = f_damping * window_kick;
    }
    const NodeLanes v_new = v + impulse * inverse_m_[a] * is_free;
    const NodeLanes v_mean = 0.5 * (v + v_new);
    load_work += f * v_mean * dt_kick * is_free;
    damping += lost * v_mean;
    store(now_.v, a, v_new);
  }
  now_.load_work += sum(load_work);
  now_.damping += sum(damping);
}

/// Velocities of the guided components. The guide gives the impulse that is missing.
void MembraneMotion::guide(double dt_kick, double window_kick, std::span<const Vec3> guided,
                           const NodalField& v_before)
{
  std::size_t k = 0;
  for (const GuidedNodes& g : guides_)
    for (const int a : g.nodes) {
      for (int c = g.along_z_only ? 2 : 0; c < 3; ++c) {
        const double v = v_before(c, static_cast<Eigen::Index>(k)), v_new = guided[k][c];
        const double given = now_.f(c, a) * dt_kick + now_.f_own(c, a) * window_kick;
        const double missing = now_.m[a] * (v_new - v) - given, v_mean = 0.5 * (v + v_new);
        now_.load_work += now_.f(c, a) * dt_kick * v_mean;
        now_.guide_work += missing * v_mean;
        now_.v(c, a) = v_new;
      }
      ++k;
    }
}

void MembraneMotion::step(double dt, std::span<const Vec3> f, std::span<const Vec3> guided)
{
  const Eigen::Index n = membrane_.n_nodes();
  if (static_cast<Eigen::Index>(f.size()) != n)
    throw std::invalid_argument("membrane: a force for each node is needed");
  for (Eigen::Index a = 0; a < n; ++a)
    now_.f.col(a).head<3>() = f[static_cast<std::size_t>(a)].array();
  NodalField before(4, static_cast<Eigen::Index>(guided.size()));
  Eigen::Index k = 0;
  for (const GuidedNodes& g : guides_)
    for (const int a : g.nodes) before.col(k++) = now_.v.col(a);
  if (k != before.cols())
    throw std::invalid_argument("membrane: a velocity for each guided node is needed");

  const double dt_kick = now_.dt > 0.0 ? 0.5 * (now_.dt + dt) : dt;
  double window_kick = 0.0;
  if (now_.n_left == 0) {
    if (now_.since == 0.0) { // from rest
      add_pressure_work();
      now_.next_pressure = now_.work_pressure = now_.pressure;
    }
    if (!is_begun_) membrane_.start(now_.x, now_.next_pressure, next_f_own_);
    membrane_.finish();
    is_begun_ = false;
    std::swap(now_.f_own, next_f_own_);
    // From rest a window of one step: the saw of the next ones is then even about rest.
    const std::size_t s = now_.since > 0.0 ? now_.subcycle : 1;
    const double window = dt * static_cast<double>(s);
    window_kick = now_.since > 0.0 ? now_.since - 0.5 * now_.window + 0.5 * window : window;
    now_.n_left = s;
    now_.window = window;
    now_.since = 0.0;
    if (++now_.n_volume >= windows_between_volumes) add_pressure_work();
  }
  kick(dt_kick, window_kick);
  guide(dt_kick, window_kick, guided, before);
  now_.since += dt;
  --now_.n_left;
  now_.x += dt * now_.v;
  now_.dt = dt;
  if (now_.n_left > 0) return;
  now_.next_pressure = now_.pressure;
  membrane_.start(now_.x, now_.pressure,
                  next_f_own_); // on its way while the particles move
  is_begun_ = true;
}

void MembraneMotion::add_pressure_work()
{
  const EnclosedVolume now = enclosed();
  const double p = now_.next_pressure; // at the present positions
  now_.pressure_work += work_on_side(0.5 * (now_.work_pressure + p), now_.work_volume, now);
  now_.work_volume = now;
  now_.work_pressure = p;
  now_.n_volume = 0;
}

void MembraneMotion::restore(MembraneState state)
{
  const Eigen::Index n = membrane_.n_nodes();
  for (const NodalField* field : {&state.x, &state.v, &state.f_own, &state.f})
    if (field->cols() != n)
      throw std::invalid_argument(
          "state of the membrane: " + std::to_string(field->cols()) +
          " nodes, the mesh has " + std::to_string(n) +
          "; restart with the mesh of the first run");
  if (state.m.size() != n || !(state.m > 0.0).all())
    throw std::invalid_argument("state of the membrane: a node without mass");
  membrane_.finish();
  is_begun_ = false;
  now_ = std::move(state);
  inverse_m_ = now_.m.inverse();
}

MembraneEnergies MembraneMotion::energies() const
{
  // The own forces gave their impulse from half a window before their kick to half a window
  // after it. Less what lies ahead, the velocity saws no more.
  const double ahead = 0.5 * (now_.window + now_.dt) - now_.since;
  const NodalField x = now_.x - 0.5 * now_.dt * now_.v,
                   v = now_.v -
                       ahead * ((free_ * now_.f_own).rowwise() * inverse_m_.transpose());
  MembraneEnergies e;
  e.kinetic = 0.5 * (v.square().colwise().sum() * now_.m.transpose()).sum();
  e.strain = membrane_.strain_energy(x);
  e.load_work = now_.load_work;
  e.pressure_work =
      now_.pressure_work + work_on_side(0.5 * (now_.work_pressure + now_.next_pressure),
                                        now_.work_volume, membrane_.enclosed(x, tube_));
  e.guide_work = now_.guide_work;
  e.damping = now_.damping;
  return e;
}

double MembraneMotion::unbalanced_ratio() const
{
  const auto size = [&](const NodalField& f) {
    return (f * free_).matrix().colwise().norm().sum();
  };
  const double scale = size(now_.f) + size(now_.f_own);
  return scale > 0.0 ? size(now_.f + now_.f_own) / scale : 0.0;
}

} // namespace mergel::fem
