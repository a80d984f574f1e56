#include "dem/element/element_test.h"

#include "dem/assembly/distribute.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mergel::dem {

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

ElementTest::ElementTest(const ElementControl& c, PeriodicSpecimen rock,
                         const PairMaterials& materials, MPI_Comm comm)
    : control_(c)
{
  Rock& r = state_.rock;
  r.particles = std::move(rock.particles);
  r.cell = rock.cell;
  r.cell.is_driven = true;
  r.material = materials;
  r.motion.damping = c.damping;
  r.motion.free_rotation = c.free_rotation;
  double m = 0.0, V = 0.0, dV = 0.0;
  for (const Body& b : r.particles.body) {
    const double v = sphere_mass(b.R, 1.0);
    m += b.m;
    V += v;
    dV += 2.0 * b.R * v;
  }
  state_.mean_diameter = dV / V;
  state_.density = m / V;
  r.list = VerletList(materials.contact.g_a, list_skin(r.particles));
  r.bonds = make_bonds(r.particles, r.cell, std::move(rock.bonded));
  share_out(r, comm);
  add_forces(r, 0.0);
  state_.dt = state_.dt_before = stable_time_step(r, c.safety);
  if (!std::isfinite(state_.dt))
    throw InputError(
        "Specimen: no grain touches another and none is bonded: the rock has no "
        "stiffness");
  state_.size_0 = r.cell.size;
  state_.stiffness_0 = affine_stiffness(r);
  look_at_stiffness();
  state_.start = energy_book(r, state_.dt);
}

ElementTest::ElementTest(const ElementControl& c, ElementState state, MPI_Comm comm)
    : control_(c), state_(std::move(state))
{
  Rock& r = state_.rock;
  r.motion.damping = c.damping;
  r.motion.free_rotation = c.free_rotation;
  r.list = VerletList(r.material.contact.g_a, list_skin(r.particles));
  share_out(r, comm);
  rebuild_lists(r);
}

double list_skin(const Particles& p)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Body& b : p.body) least = std::min(least, 2.0 * b.R / b.S);
  return usual_skin * least;
}

void ElementTest::look_at_stiffness()
{
  state_.servo.stiffness =
      affine_stiffness(state_.rock).cwiseMax(least_stiffness * state_.stiffness_0);
}

Vec3 ElementTest::stress() const
{
  return state_.rock.virial.value() / state_.rock.cell.volume();
}

Vec3 ElementTest::mean_stress() const
{
  return state_.n_stress > 0
             ? Vec3(state_.stress_sum / static_cast<double>(state_.n_stress))
             : stress();
}

SoilState ElementTest::soil(const Vec3& sigma) const
{
  const Vec3& size_0 = state_.course.size_0;
  return soil_state(sigma, state_.rock.cell.size, size_0.isZero() ? state_.size_0 : size_0);
}

void ElementTest::set_out(std::size_t leg)
{
  ElementState& s = state_;
  const Leg& l = control_.legs[leg];
  s.course = dem::set_out(l, s.course, soil(stress()), s.rock.cell.size);
  s.course.is_approaching =
      l.kind != PathKind::resume && s.course.offset.cwiseAbs().maxCoeff() >
                                        offset_that_counts * control_.reference_pressure;
  s.leg = leg;
  s.n_in_leg = s.n_held = 0;
  s.farthest = 0.0;
  s.tension = 0.0;
}

/// Change what the leg shall hold as fast as the driven strain would build it up; then hold,
/// and set out anew from there.
void ElementTest::approach(double rate)
{
  ElementState& s = state_;
  Course& c = s.course;
  const double change = s.servo.stiffness.minCoeff() * rate * s.dt;
  c.remaining = std::max(0.0, c.remaining - change / c.offset.cwiseAbs().maxCoeff());
  if (c.remaining > 0.0 || ++s.n_held < steps_held) return;
  c = dem::set_out(control_.legs[s.leg], c, soil(stress()), s.rock.cell.size);
  s.n_in_leg = 0;
  s.farthest = s.tension = 0.0;
}

double ElementTest::driven_rate(const SoilState& now) const
{
  const double p = std::max(std::abs(now.p()), control_.reference_pressure);
  return control_.inertial_number / (state_.mean_diameter * std::sqrt(state_.density / p));
}

void ElementTest::lower_time_step()
{
  state_.dt = std::min(state_.dt, stable_time_step(state_.rock, control_.safety));
}

void ElementTest::step()
{
  try {
    step_unguarded();
  } catch (const Unstable& e) {
    throw Unstable(std::string(e.what()) + " (step " + std::to_string(state_.n_steps) +
                   ", t = " + std::to_string(1e3 * state_.time) + " ms)");
  }
}

void ElementTest::step_unguarded()
{
  ElementState& s = state_;
  if (s.n_steps % steps_between_checks == 0) {
    lower_time_step();
    look_at_stiffness();
    check_overlaps(s.rock);
  }
  const Vec3 sigma = stress();
  const SoilState now = soil(sigma);
  const double full = driven_rate(now);
  const auto n = static_cast<double>(std::min(s.n_in_leg + 1, steps_of_ramp));
  const double rate = full * n / steps_of_ramp;
  s.greatest_rate = std::max(s.greatest_rate, rate);
  s.servo.limit = most_over_driven * full;
  const CellOrder order = s.course.order(now, rate);
  const Vec3 rates = s.servo.rates(order, sigma, s.dt);
  advance(s.rock, s.dt_before, s.dt, [&](double) { s.rock.cell.rate = rates; });
  s.dt_before = s.dt;
  s.time += s.dt;
  s.since_record += rate * s.dt;
  ++s.n_steps;
  ++s.n_in_leg;

  s.stress_sum += stress();
  for (int a = 0; a < 3; ++a) {
    const AxisOrder& axis = order[static_cast<std::size_t>(a)];
    if (axis.holds_stress) s.held_sum[a] += axis.stress;
  }
  ++s.n_stress;
  if (s.course.is_approaching) approach(rate);
}

/// Whether an axis cannot be drawn at any more, which bore tension: the driven one, drawn
/// out further, or one that is to hold a tension and finds too little.
bool ElementTest::is_pulled_apart() const
{
  const ElementState& s = state_;
  const double counts = tension_that_counts * control_.reference_pressure;
  const double pull = -s.course.driven(soil(mean_stress()));
  if (s.course.direction < 0.0 && s.tension > counts && pull < left_of_tension * s.tension)
    return true;
  const Vec3 wanted = s.held_sum / static_cast<double>(s.n_stress), borne = mean_stress();
  for (int a = 0; a < 3; ++a)
    if (wanted[a] > counts && borne[a] < left_of_held * wanted[a]) return true;
  return false;
}

Outcome ElementTest::outcome() const
{
  const ElementState& s = state_;
  if (!s.course.is_approaching && s.course.has_reached_goal(soil(stress())))
    return Outcome::done;
  if (!record_is_due()) return Outcome::goes_on;

  if (is_pulled_apart()) return Outcome::pulled_apart;
  const SoilState now = soil(mean_stress());
  if (!s.course.is_approaching && !is_strain(s.course.quantity)) {
    const double fallen = s.farthest - s.course.progress(now);
    if (s.farthest > 0.05 && fallen > control_.reversal * s.farthest)
      return Outcome::reversed;
  }
  const auto whole = soil_state(stress(), s.rock.cell.size, s.size_0);
  const double strain =
      std::max(whole.strain.cwiseAbs().maxCoeff(), std::abs(whole.volumetric_strain()));
  return strain > control_.strain_limit ? Outcome::gave_up : Outcome::goes_on;
}

ElementRecord ElementTest::record()
{
  ElementState& s = state_;
  ElementRecord r;
  r.time = s.time;
  r.leg = s.leg;
  r.is_approach = s.course.is_approaching;
  r.averages = cell_averages(s.rock);
  const Vec3 sigma = r.averages.stress.diagonal();
  r.whole = soil_state(sigma, s.rock.cell.size, s.size_0);
  r.of_leg = soil(sigma);
  r.driven_strain = s.course.driven_strain(r.of_leg);
  r.broken = s.rock.comm.global_sum(s.rock.losses.broken);
  for (std::size_t k = 0; k < n_break_modes; ++k)
    r.broken_by[k] = s.rock.comm.global_sum(s.rock.losses.broken_by[k]);
  r.book = energy_book(s.rock, s.dt);
  s.gross_work += std::abs(r.book.cell_work - s.last_work);
  s.last_work = r.book.cell_work;
  const double scale = s.start.stored() + s.gross_work;
  r.energy_error = scale > 0.0 ? unexplained(r.book, s.start) / scale : 0.0;
  r.inertial_number =
      inertial_number(s.rock.cell.rate.norm(), s.mean_diameter, s.density,
                      std::max(std::abs(r.whole.p()), control_.reference_pressure));
  r.unbalanced = unbalanced_ratio(s.rock);

  if (s.n_stress > 0) {
    const SoilState mean = soil(mean_stress());
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

} // namespace mergel::dem
