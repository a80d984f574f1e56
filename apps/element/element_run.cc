#include "apps/element/element_run.h"

#include "dem/assembly/distribute.h"

#include <algorithm>
#include <cmath>

namespace mergel::apps {

namespace {

constexpr std::size_t steps_between_checks = 100;
/// Steps in which a leg gathers speed. Stress on the sides that grows with it, a per step of
/// the full rate, is met by the servo with an error of (tau_i/dt)^2/(m n) a = 5 a/m on a ramp
/// of n = 2000 steps; without a ramp with 18 to 22 a/m (see Servo for m and tau_i).
constexpr std::size_t steps_of_ramp = 2000;
constexpr double most_over_driven = 10.0;   ///< of a held axis' rate
constexpr double least_stiffness = 1e-3;    ///< that the servo counts with, of the first
constexpr double left_of_tension = 0.05;    ///< below which a specimen is pulled apart
constexpr double left_of_held = 0.5;        ///< the same of a tension that is to be held
constexpr double offset_that_counts = 0.01; ///< of the reference pressure
constexpr std::size_t steps_held = 400; ///< after an approach: a time 16 tau of the servo
constexpr double tension_that_counts = 0.02; ///< of the reference pressure

} // namespace

std::string sentence_of(Outcome outcome)
{
  switch (outcome) {
  case Outcome::done:
    return "goal reached";
  case Outcome::pulled_apart:
    return "the specimen failed in tension: pulled apart";
  case Outcome::reversed:
    return "the stress fell back on its way to the goal: the path met an unstable point";
  case Outcome::gave_up:
    return "the strain limit was reached before the goal";
  case Outcome::broke_off:
    return "the run went unstable and stopped in this leg";
  case Outcome::goes_on:
    break;
  }
  return "goes on";
}

ElementRun::ElementRun(const ElementCase& c, ElementRock rock,
                       const dem::PairMaterials& materials)
    : case_(c)
{
  dem::Rock& r = state_.rock;
  r.particles = std::move(rock.particles);
  r.cell = rock.cell;
  r.cell.is_driven = true;
  r.material = materials;
  r.motion.damping = c.damping;
  r.motion.free_rotation = c.free_rotation;
  double m = 0.0, V = 0.0, dV = 0.0;
  for (const dem::Body& b : r.particles.body) {
    const double v = dem::sphere_mass(b.R, 1.0);
    m += b.m;
    V += v;
    dV += 2.0 * b.R * v;
  }
  d_ = dV / V;
  rho_ = m / V;
  r.list = dem::VerletList(materials.contact.g_a, list_skin(r.particles));
  r.bonds = dem::make_bonds(r.particles, r.cell, std::move(rock.bonded));
  dem::share_out(r, MPI_COMM_WORLD);
  dem::add_forces(r, 0.0);
  state_.dt = state_.dt_before = dem::stable_time_step(r, c.safety);
  if (!std::isfinite(state_.dt))
    throw InputError(
        "Specimen: no grain touches another and none is bonded: the rock has no "
        "stiffness");
  state_.size_0 = r.cell.size;
  state_.stiffness_0 = dem::affine_stiffness(r);
  look_at_stiffness();
  state_.start = dem::energy_book(r, state_.dt);
}

void ElementRun::look_at_stiffness()
{
  state_.servo.stiffness =
      dem::affine_stiffness(state_.rock).cwiseMax(least_stiffness * state_.stiffness_0);
}

dem::Vec3 ElementRun::stress() const
{
  return state_.rock.virial.value() / state_.rock.cell.volume();
}

dem::Vec3 ElementRun::mean_stress() const
{
  return state_.n_stress > 0
             ? dem::Vec3(state_.stress_sum / static_cast<double>(state_.n_stress))
             : stress();
}

dem::SoilState ElementRun::soil(const dem::Vec3& sigma) const
{
  const dem::Vec3& size_0 = state_.course.size_0;
  return dem::soil_state(sigma, state_.rock.cell.size,
                         size_0.isZero() ? state_.size_0 : size_0);
}

void ElementRun::set_out(std::size_t leg)
{
  ElementState& s = state_;
  const dem::Leg& l = case_.legs[leg];
  s.course = dem::set_out(l, s.course, soil(stress()), s.rock.cell.size);
  s.course.is_approaching =
      l.kind != dem::PathKind::resume &&
      s.course.offset.cwiseAbs().maxCoeff() > offset_that_counts * case_.reference_pressure;
  s.leg = leg;
  s.n_in_leg = s.n_held = 0;
  s.farthest = 0.0;
  s.tension = 0.0;
}

/// Change what the leg shall hold as fast as the driven strain would build it up; then hold,
/// and set out anew from there.
void ElementRun::approach(double rate)
{
  ElementState& s = state_;
  dem::Course& c = s.course;
  const double change = s.servo.stiffness.minCoeff() * rate * s.dt;
  c.remaining = std::max(0.0, c.remaining - change / c.offset.cwiseAbs().maxCoeff());
  if (c.remaining > 0.0 || ++s.n_held < steps_held) return;
  c = dem::set_out(case_.legs[s.leg], c, soil(stress()), s.rock.cell.size);
  s.n_in_leg = 0;
  s.farthest = s.tension = 0.0;
}

double ElementRun::driven_rate(const dem::SoilState& now) const
{
  const double p = std::max(std::abs(now.p()), case_.reference_pressure);
  return case_.inertial_number / (d_ * std::sqrt(rho_ / p));
}

void ElementRun::lower_time_step()
{
  state_.dt = std::min(state_.dt, dem::stable_time_step(state_.rock, case_.safety));
}

void ElementRun::step()
{
  try {
    step_unguarded();
  } catch (const Unstable& e) {
    throw Unstable(std::string(e.what()) + " (step " + std::to_string(state_.n_steps) +
                   ", t = " + std::to_string(1e3 * state_.time) + " ms)");
  }
}

void ElementRun::step_unguarded()
{
  ElementState& s = state_;
  if (s.n_steps % steps_between_checks == 0) {
    lower_time_step();
    look_at_stiffness();
    dem::check_overlaps(s.rock);
  }
  const dem::Vec3 sigma = stress();
  const dem::SoilState now = soil(sigma);
  const double full = driven_rate(now);
  const auto n = static_cast<double>(std::min(s.n_in_leg + 1, steps_of_ramp));
  const double rate = full * n / steps_of_ramp;
  s.greatest_rate = std::max(s.greatest_rate, rate);
  s.servo.limit = most_over_driven * full;
  const dem::CellOrder order = s.course.order(now, rate);
  const dem::Vec3 rates = s.servo.rates(order, sigma, s.dt);
  dem::advance(s.rock, s.dt_before, s.dt, [&](double) { s.rock.cell.rate = rates; });
  s.dt_before = s.dt;
  s.time += s.dt;
  s.since_record += rate * s.dt;
  ++s.n_steps;
  ++s.n_in_leg;

  s.stress_sum += stress();
  for (int a = 0; a < 3; ++a) {
    const dem::AxisOrder& axis = order[static_cast<std::size_t>(a)];
    if (axis.holds_stress) s.held_sum[a] += axis.stress;
  }
  ++s.n_stress;
  if (s.course.is_approaching) approach(rate);
}

/// Whether an axis cannot be drawn at any more, which bore tension: the driven one, drawn
/// out further, or one that is to hold a tension and finds too little.
bool ElementRun::is_pulled_apart() const
{
  const ElementState& s = state_;
  const double counts = tension_that_counts * case_.reference_pressure;
  const double pull = -s.course.driven(soil(mean_stress()));
  if (s.course.direction < 0.0 && s.tension > counts && pull < left_of_tension * s.tension)
    return true;
  const dem::Vec3 wanted = s.held_sum / static_cast<double>(s.n_stress),
                  borne = mean_stress();
  for (int a = 0; a < 3; ++a)
    if (wanted[a] > counts && borne[a] < left_of_held * wanted[a]) return true;
  return false;
}

Outcome ElementRun::outcome() const
{
  const ElementState& s = state_;
  if (!s.course.is_approaching && s.course.has_reached_goal(soil(stress())))
    return Outcome::done;
  if (!record_is_due()) return Outcome::goes_on;

  if (is_pulled_apart()) return Outcome::pulled_apart;
  const dem::SoilState now = soil(mean_stress());
  if (!s.course.is_approaching && !dem::is_strain(s.course.quantity)) {
    const double fallen = s.farthest - s.course.progress(now);
    if (s.farthest > 0.05 && fallen > case_.reversal * s.farthest) return Outcome::reversed;
  }
  const auto whole = dem::soil_state(stress(), s.rock.cell.size, s.size_0);
  const double strain =
      std::max(whole.strain.cwiseAbs().maxCoeff(), std::abs(whole.volumetric_strain()));
  return strain > case_.strain_limit ? Outcome::gave_up : Outcome::goes_on;
}

ElementRecord ElementRun::record()
{
  ElementState& s = state_;
  ElementRecord r;
  r.time = s.time;
  r.leg = s.leg;
  r.is_approach = s.course.is_approaching;
  r.averages = dem::cell_averages(s.rock);
  const dem::Vec3 sigma = r.averages.stress.diagonal();
  r.whole = dem::soil_state(sigma, s.rock.cell.size, s.size_0);
  r.of_leg = soil(sigma);
  r.driven_strain = s.course.driven_strain(r.of_leg);
  r.broken = s.rock.domain.sum(s.rock.losses.broken);
  for (std::size_t k = 0; k < dem::n_break_modes; ++k)
    r.broken_by[k] = s.rock.domain.sum(s.rock.losses.broken_by[k]);
  r.book = dem::energy_book(s.rock, s.dt);
  s.gross_work += std::abs(r.book.cell_work - s.last_work);
  s.last_work = r.book.cell_work;
  const double scale = s.start.stored() + s.gross_work;
  r.energy_error = scale > 0.0 ? dem::unexplained(r.book, s.start) / scale : 0.0;
  r.inertial_number =
      dem::inertial_number(s.rock.cell.rate.norm(), d_, rho_,
                           std::max(std::abs(r.whole.p()), case_.reference_pressure));
  r.unbalanced = dem::unbalanced_ratio(s.rock);

  if (s.n_stress > 0) {
    const dem::SoilState mean = soil(mean_stress());
    s.tension = std::max(s.tension, -s.course.driven(mean));
    if (!s.course.is_approaching)
      s.farthest = std::max(s.farthest, s.course.progress(r.of_leg));
  }
  s.stress_sum.setZero();
  s.held_sum.setZero();
  s.n_stress = 0;
  s.since_record = 0.0;
  if (!(std::abs(r.energy_error) <= 0.01))
    throw Unstable("the energy book leaves " + std::to_string(r.energy_error) +
                   " of the work unexplained (at most 0.01) at step " +
                   std::to_string(s.n_steps) + ": lower `Motion/time step safety`");
  return r;
}

} // namespace mergel::apps
