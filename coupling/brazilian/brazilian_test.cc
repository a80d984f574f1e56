#include "coupling/brazilian/brazilian_test.h"

#include "dem/assembly/averages.h"
#include "dem/assembly/overlaps.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>

namespace mergel::coupling {

using dem::Vec3;

namespace {

/// Steps over which the plates gather speed: some transits of a wave.
constexpr std::size_t steps_of_ramp = 4000;
/// Uniform strain whose energy counts as work in the energy error [-].
constexpr double reference_strain = 1e-4;

/// A particle in contact with a plate.
struct RimForce {
  std::uint64_t id;
  double x, f; ///< across [m]; [N], > 0
};

/// Half the width of a strip of Hertz's pressure with the second moment of these forces, and
/// of the strip that has all of them [m].
struct Strip {
  double half = 0.0, all = 0.0;
};
Strip strip(const std::vector<RimForce>& forces)
{
  double F = 0.0, moment = 0.0, second = 0.0, most = 0.0;
  for (const RimForce& r : forces) {
    F += r.f;
    moment += r.f * r.x;
    most = std::max(most, std::abs(r.x));
  }
  if (!(F > 0.0)) return {};
  const double middle = moment / F;
  for (const RimForce& r : forces) second += r.f * (r.x - middle) * (r.x - middle);
  return {2.0 * std::sqrt(second / F), most};
}

} // namespace

std::size_t peak_of(const std::vector<BrazilianPoint>& points)
{
  const auto less = [](const BrazilianPoint& a, const BrazilianPoint& b) {
    return a.load < b.load;
  };
  return static_cast<std::size_t>(std::max_element(points.begin(), points.end(), less) -
                                  points.begin());
}

BrazilianOutcome outcome(const BrazilianControl& control,
                         const std::vector<BrazilianPoint>& points)
{
  if (points.empty()) return BrazilianOutcome::goes_on;
  const double fallen = control.final_load * points[peak_of(points)].load;
  const auto is_below = [&](const BrazilianPoint& p) { return p.load < fallen; };
  if (points.size() > records_of_fall &&
      std::all_of(points.end() - records_of_fall, points.end(), is_below))
    return BrazilianOutcome::load_fell;
  return points.back().strain >= control.strain_limit
             ? BrazilianOutcome::strain_limit_reached
             : BrazilianOutcome::goes_on;
}

std::vector<dem::RigidWall> BrazilianTest::plates(const dem::ContactLaw& contact)
{
  return {dem::make_rigid_wall(dem::Plane{Vec3::UnitZ()}, Vec3::Zero(), contact),
          dem::make_rigid_wall(dem::Plane{-Vec3::UnitZ()}, Vec3::Zero(), contact)};
}

BrazilianTest::BrazilianTest(const BrazilianControl& control, const DiscGeometry& disc,
                             const dem::ContactLaw& plates, CoupledSystem& system)
    : control_(control), disc_(disc), system_(system)
{
  dem::Assembly& a = system_.assembly;
  a.partition.gather_motion(a.particles, a.comm);
  system_.x_0.clear();
  double mass = 0.0, low = 0.0, high = 0.0;
  for (const dem::ParticleState& b : a.particles.state) {
    system_.x_0.push_back(b.x);
    mass += b.m;
    low = std::min(low, b.x.z() - b.R);
    high = std::max(high, b.x.z() + b.R);
  }
  a.rigid_walls = BrazilianTest::plates(plates);
  bottom().x.z() = low;
  top().x.z() = high;
  a.list.invalidate();
  dem::add_forces(a, 0.0);
  system_.find_time_step();
  system_.dt_before = system_.dt;
  state_.gap_0 = high - low;
  state_.density = mass / disc_.volume();
  state_.stiffness = dem::affine_stiffness(a, disc_.volume()).z();
  require(state_.stiffness > 0.0,
          "Specimen: no particles touch and none are bonded: it has no stiffness");
  state_.start = system_.energy_balances().assembly;
}

BrazilianTest::BrazilianTest(const BrazilianControl& control, const DiscGeometry& disc,
                             CoupledSystem& system, const dem::State& state)
    : control_(control), disc_(disc), system_(system)
{
  load(state);
}

double BrazilianTest::approach() const
{
  return state_.gap_0 - (top().x.z() - bottom().x.z());
}

double BrazilianTest::strain() const
{
  return approach() / disc_.diameter;
}

double BrazilianTest::wave_stress() const
{
  return 0.5 * control_.velocity * std::sqrt(state_.density * state_.stiffness);
}

void BrazilianTest::step()
{
  if (system_.n_steps % dem::steps_between_step_checks == 0)
    dem::check_overlaps(system_.assembly);
  const auto n = static_cast<double>(std::min(system_.n_steps + 1, steps_of_ramp));
  const double v = 0.5 * control_.velocity * n / steps_of_ramp;
  system_.step([&](double dt) {
    bottom().v.z() = v;
    top().v.z() = -v;
    bottom().x.z() += dt * v;
    top().x.z() -= dt * v;
  });
  state_.since_record += 2.0 * v * system_.dt_before / disc_.diameter;
  state_.top_sum += F_top();
  state_.bottom_sum += F_bottom();
  ++state_.n_sum;
  collect_breaks();
}

/// Breaks of this step, on all ranks alike.
void BrazilianTest::collect_breaks()
{
  dem::Assembly& a = system_.assembly;
  if (a.comm.global_sum(a.losses.breakages.size()) == 0) return;
  std::vector<DiscBreak> mine;
  for (const dem::Breakage& b : a.losses.breakages) {
    const auto &i = a.particles.state[b.pair.i], &j = a.particles.state[b.pair.j];
    mine.push_back({b.x, (j.x - i.x).normalized(), std::min(i.R, j.R),
                    std::min(top().x.z() - b.x.z(), b.x.z() - bottom().x.z()), strain(),
                    0.5 * (F_top() + F_bottom()), system_.n_steps, a.particles.id[b.pair.i],
                    a.particles.id[b.pair.j], b.mode});
  }
  a.losses.breakages.clear();
  std::vector<DiscBreak> all = a.comm.gather(mine);
  std::sort(all.begin(), all.end(), [](const DiscBreak& p, const DiscBreak& q) {
    return std::pair{p.first, p.second} < std::pair{q.first, q.second};
  });
  breaks_.insert(breaks_.end(), all.begin(), all.end());
}

RimContact BrazilianTest::rim_contact() const
{
  const dem::Assembly& a = system_.assembly;
  RimContact rim;
  for (const dem::RigidWall& plate : a.rigid_walls) {
    std::vector<RimForce> mine;
    for (const dem::WallContact& c : plate.contacts) {
      const dem::ParticleState& b = a.particles.state[c.particle];
      if (c.overlap > 0.0)
        mine.push_back(
            {a.particles.id[c.particle], b.x.x(),
             dem::normal_force(plate.material, dem::sides_at_wall(b.R), c.overlap)});
    }
    std::vector<RimForce> all = a.comm.gather(mine);
    std::sort(all.begin(), all.end(),
              [](const RimForce& p, const RimForce& q) { return p.id < q.id; });
    const Strip s = strip(all);
    const auto angle = [&](double half) {
      return std::asin(std::min(1.0, half / disc_.radius()));
    };
    rim.half_angle += 0.5 * angle(s.half);
    rim.outermost = std::max(rim.outermost, angle(s.all));
    rim.n += all.size();
  }
  return rim;
}

BrazilianRecord BrazilianTest::record()
{
  BrazilianState& s = state_;
  dem::Assembly& a = system_.assembly;
  BrazilianRecord r;
  r.time = system_.time;
  r.approach = approach();
  r.strain = strain();
  const auto mean = [&](double sum, double last) {
    return s.n_sum > 0 ? sum / static_cast<double>(s.n_sum) : last;
  };
  r.F_top = mean(s.top_sum, F_top());
  r.F_bottom = mean(s.bottom_sum, F_bottom());
  r.load = 0.5 * (r.F_top + r.F_bottom);
  r.contact = rim_contact();
  const double w = centre_width * disc_.diameter;
  const Vec3 corner(w, disc_.thickness, w); // beyond both faces
  const dem::Mat3 sigma =
      dem::box_stress(a, -corner, corner, 4.0 * w * w * disc_.thickness);
  r.centre = {sigma(0, 0), sigma(2, 2)};
  r.zones = count_zones(breaks_, breaks_.size(), disc_);
  r.broken = a.comm.global_sum(a.losses.broken);
  for (std::size_t k = 0; k < dem::n_break_modes; ++k)
    r.broken_by[k] = a.comm.global_sum(a.losses.broken_by[k]);
  r.balance = system_.energy_balances().assembly;
  const double work = r.balance.rigid_wall_work;
  s.gross_work += std::abs(work - s.last_work);
  s.last_work = work;
  // At first the work is next to nothing: an error counts against what the disc stores at
  // the reference strain.
  const double reference =
      0.5 * s.stiffness * reference_strain * reference_strain * disc_.volume();
  r.energy_error = dem::unexplained(r.balance, s.start) / (reference + s.gross_work);
  r.unbalanced = system_.unbalanced();
  r.time_step = system_.dt;
  r.stable_step = system_.stable_step.limit;
  s.top_sum = s.bottom_sum = s.since_record = 0.0;
  s.n_sum = 0;
  s.alarm.add(r.energy_error, r.time, s.gross_work, reference);
  points_.push_back({r.strain, r.load, r.F_top - r.F_bottom, r.contact.half_angle,
                     r.contact.outermost, r.centre.xx, r.centre.zz, r.energy_error,
                     r.broken});
  if (!(std::abs(r.energy_error) <= 0.01))
    throw Unstable("the energy balance leaves " + dem::shortest(r.energy_error) +
                   " of the work unexplained (at most 0.01) at step " +
                   std::to_string(system_.n_steps) + ": lower `Motion/time step safety`");
  return r;
}

} // namespace mergel::coupling
