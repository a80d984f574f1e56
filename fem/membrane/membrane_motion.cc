#include "fem/membrane/membrane_motion.h"

#include "fem/node_lanes.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace mergel::fem {

namespace {

/// Windows after which the work of the pressure is added: it changes little in these.
constexpr std::size_t windows_between_volumes = 50;

/// Rows of MembraneState::work.
enum { row_of_load, row_of_guides, row_of_damping };

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
  now_.f_own = now_.f = now_.work = NodalField::Zero(4, n);
  now_.v = NodalMessage::Zero(3, n);
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

void MembraneMotion::set_masses(const Eigen::ArrayXd& m)
{
  now_.m = m;
  inverse_m_ = m.inverse();
  now_.v.setZero();
  now_.dt = now_.window = now_.since = 0.0;
  now_.n_left = 0;
}

/// Own forces over window_kick, nodal forces over dt_kick. Damping sees both, and acts with
/// the former, against the mean motion in a window.
void MembraneMotion::kick(double dt_kick, double window_kick, std::span<const Vec3> given)
{
  const NodeLanes zero{};
  const bool takes_own = window_kick > 0.0;
  const double saw = window_kick - dt_kick;
  const NodeShares& nodes = membrane_.shares();
  for (Eigen::Index a = nodes.first(); a < nodes.end(); ++a) {
    const Vec3& force = given[static_cast<std::size_t>(a)];
    const NodeLanes f{force.x(), force.y(), force.z(), 0.0};
    const NodeLanes v = load(now_.v, a), is_free = load(free_, a);
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
    const NodeLanes work{sum(f * v_mean * dt_kick * is_free), 0.0, sum(lost * v_mean), 0.0};
    store(now_.f, a, f);
    store(now_.v, a, v_new);
    store(now_.work, a, load(now_.work, a) + work);
  }
}

/// Velocities of the guided components. The guide gives the impulse that is missing.
void MembraneMotion::guide(double dt_kick, double window_kick, std::span<const Vec3> guided,
                           const NodalMessage& v_before)
{
  std::size_t k = 0;
  for (const GuidedNodes& g : guides_)
    for (const int a : g.nodes) {
      const std::size_t of = k++;
      if (!membrane_.shares().has(a)) continue;
      for (int c = g.along_z_only ? 2 : 0; c < 3; ++c) {
        const double v = v_before(c, static_cast<Eigen::Index>(of)), v_new = guided[of][c];
        const double given = now_.f(c, a) * dt_kick + now_.f_own(c, a) * window_kick;
        const double missing = now_.m[a] * (v_new - v) - given, v_mean = 0.5 * (v + v_new);
        now_.work(row_of_load, a) += now_.f(c, a) * dt_kick * v_mean;
        now_.work(row_of_guides, a) += missing * v_mean;
        now_.v(c, a) = v_new;
      }
    }
}

/// The ranks complete the velocities, and each moves all nodes.
void MembraneMotion::move(double dt)
{
  membrane_.shares().gather(now_.v);
  for (Eigen::Index a = 0; a < membrane_.n_nodes(); ++a)
    store(now_.x, a, load(now_.x, a) + dt * load(now_.v, a));
}

void MembraneMotion::step(double dt, std::span<const Vec3> f, std::span<const Vec3> guided)
{
  const Eigen::Index n = membrane_.n_nodes();
  if (static_cast<Eigen::Index>(f.size()) != n)
    throw std::invalid_argument("membrane: a force for each node is needed");
  NodalMessage before(3, static_cast<Eigen::Index>(guided.size()));
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
    membrane_.forces(now_.x, now_.next_pressure, now_.f_own);
    // From rest a window of one step: the saw of the next ones is then even about rest.
    const std::size_t s = now_.since > 0.0 ? now_.subcycle : 1;
    const double window = dt * static_cast<double>(s);
    window_kick = now_.since > 0.0 ? now_.since - 0.5 * now_.window + 0.5 * window : window;
    now_.n_left = s;
    now_.window = window;
    now_.since = 0.0;
    if (++now_.n_volume >= windows_between_volumes) add_pressure_work();
  }
  kick(dt_kick, window_kick, f);
  guide(dt_kick, window_kick, guided, before);
  move(dt);
  now_.since += dt;
  --now_.n_left;
  now_.dt = dt;
  if (now_.n_left == 0) now_.next_pressure = now_.pressure;
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
  for (const Eigen::Index n_state : {state.x.cols(), state.v.cols(), state.f_own.cols(),
                                     state.f.cols(), state.work.cols()})
    if (n_state != n)
      throw std::invalid_argument("state of the membrane: " + std::to_string(n_state) +
                                  " nodes, the mesh has " + std::to_string(n) +
                                  "; restart with the mesh of the first run");
  if (state.m.size() != n || !(state.m > 0.0).all())
    throw std::invalid_argument("state of the membrane: a node without mass");
  now_ = std::move(state);
  inverse_m_ = now_.m.inverse();
}

MembraneEnergies MembraneMotion::energies() const
{
  // The own forces gave their impulse from half a window before their kick to half a window
  // after it. Less what lies ahead, the velocity saws no more.
  const double ahead = 0.5 * (now_.window + now_.dt) - now_.since;
  const NodalField f_own = membrane_.shares().gathered(now_.f_own),
                   work = membrane_.shares().gathered(now_.work);
  NodalField x = now_.x, v = -ahead * ((free_ * f_own).rowwise() * inverse_m_.transpose());
  x.topRows<3>() -= 0.5 * now_.dt * now_.v;
  v.topRows<3>() += now_.v;
  MembraneEnergies e;
  e.kinetic = 0.5 * (v.square().colwise().sum() * now_.m.transpose()).sum();
  e.strain = membrane_.strain_energy(x);
  e.load_work = work.row(row_of_load).sum();
  e.pressure_work =
      now_.pressure_work + work_on_side(0.5 * (now_.work_pressure + now_.next_pressure),
                                        now_.work_volume, membrane_.enclosed(x, tube_));
  e.guide_work = work.row(row_of_guides).sum();
  e.damping = work.row(row_of_damping).sum();
  return e;
}

double MembraneMotion::unbalanced_ratio() const
{
  const auto size = [&](const NodalField& f) {
    return (f * free_).matrix().colwise().norm().sum();
  };
  const NodalField f = membrane_.shares().gathered(now_.f),
                   f_own = membrane_.shares().gathered(now_.f_own);
  const double scale = size(f) + size(f_own);
  return scale > 0.0 ? size(f + f_own) / scale : 0.0;
}

} // namespace mergel::fem
