#include "dem/element/element_test.h"

#include "dem/assembly/distribute.h"
#include "dem/assembly/overlaps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mergel::dem {

namespace {

/// Steps over which the rate of a stage is ramped up. Let the lateral stress change by a
/// per step at the full rate. The error of the servo is then (tau_i/dt)^2/(m n) a = 1.6 a/m
/// with a ramp of n = 1000 steps (m and tau_i: see Servo).
constexpr std::size_t steps_of_ramp = 1000;
/// Limit of the rate of a stress-controlled axis, over the controlled rate.
constexpr double rate_limit_factor = 10.0;
/// Smallest stiffness that the servo uses, over the stiffness before the first stage.
constexpr double lowest_stiffness = 1e-3;
/// Share of its largest tension below which the controlled axis counts as pulled apart.
constexpr double min_tension_share = 0.05;
/// Share of a tension to hold below which the axis counts as pulled apart.
constexpr double min_held_share = 0.5;
/// Smallest offset that starts an approach, over the reference pressure.
constexpr double offset_threshold = 0.01;
constexpr std::size_t steps_held = 160; ///< after an approach: 16 tau of the servo
/// Smallest tension that counts, over the reference pressure.
constexpr double tension_threshold = 0.02;

} // namespace

std::string sentence_of(Outcome outcome)
{
  switch (outcome) {
  case Outcome::done:
    return "target reached";
  case Outcome::pulled_apart:
    return "the specimen failed in tension: pulled apart";
  case Outcome::reversed:
    return "the stress fell back before it reached the target: unstable point of the path";
  case Outcome::strain_limit_reached:
    return "the strain limit was reached before the target";
  case Outcome::unstable:
    return "the run went unstable and stopped in this stage";
  case Outcome::goes_on:
    break;
  }
  return "goes on";
}

ElementTest::ElementTest(const ElementControl& c, PeriodicSpecimen specimen,
                         const PairMaterials& materials, MPI_Comm comm)
    : control_(c)
{
  Assembly& r = state_.assembly;
  r.particles = std::move(specimen.particles);
  r.cell = specimen.cell;
  r.cell.is_strain_controlled = true;
  r.material = materials;
  r.motion.damping = c.damping;
  r.motion.free_rotation = c.free_rotation;
  r.motion.inertia_factor = c.inertia_factor;
  r.motion.largest_overlap = c.largest_overlap;
  double m = 0.0, V = 0.0, dV = 0.0;
  for (const ParticleState& b : r.particles.state) {
    const double v = sphere_mass(b.R, 1.0);
    m += b.m;
    V += v;
    dV += 2.0 * b.R * v;
  }
  state_.mean_diameter = dV / V;
  state_.density = m / V;
  r.list = VerletList(activation_gap(materials.contact), list_skin(r.particles));
  r.bonds = make_bonds(r.particles, r.cell, std::move(specimen.bonded));
  distribute(r, comm);
  add_forces(r, 0.0);
  scale_masses(r, c.mass_scaling);
  find_stable_step(state_.stable_step, r, c.step, 0.0, c.damping);
  state_.dt = state_.dt_before = c.step.safety * state_.stable_step.limit;
  if (!std::isfinite(state_.dt))
    throw InputError(
        "Specimen: no particles touch and none are bonded: the specimen has no "
        "stiffness");
  state_.size_0 = r.cell.size;
  state_.stiffness_0 = affine_stiffness(r);
  update_stiffness();
  state_.start = energy_balance(r, state_.dt);
}

ElementTest::ElementTest(const ElementControl& c, ElementState state, MPI_Comm comm)
    : control_(c), state_(std::move(state))
{
  Assembly& r = state_.assembly;
  r.motion.damping = c.damping;
  r.motion.free_rotation = c.free_rotation;
  r.motion.inertia_factor = c.inertia_factor;
  r.motion.largest_overlap = c.largest_overlap;
  r.list = VerletList(activation_gap(r.material.contact), list_skin(r.particles));
  distribute(r, comm);
  rebuild_lists(r);
  // The restart may have another safety.
  state_.dt = c.step.safety * state_.stable_step.limit;
}

double list_skin(const Particles& p)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (const ParticleState& b : p.state) smallest = std::min(smallest, 2.0 * b.R / b.S);
  return default_skin * smallest;
}

void ElementTest::update_stiffness()
{
  state_.servo.stiffness =
      affine_stiffness(state_.assembly).cwiseMax(lowest_stiffness * state_.stiffness_0);
}

Vec3 ElementTest::stress() const
{
  return state_.assembly.virial.value() / state_.assembly.cell.volume();
}

Vec3 ElementTest::mean_stress() const
{
  return state_.n_stress > 0
             ? Vec3(state_.stress_sum / static_cast<double>(state_.n_stress))
             : stress();
}

SoilState ElementTest::soil(const Vec3& sigma) const
{
  const Vec3& size_0 = state_.active.size_0;
  return soil_state(sigma, state_.assembly.cell.size,
                    size_0.isZero() ? state_.size_0 : size_0);
}

void ElementTest::begin_stage(std::size_t stage)
{
  ElementState& s = state_;
  const LoadingStage& l = control_.stages[stage];
  s.active = dem::begin_stage(l, s.active, soil(stress()), s.assembly.cell.size);
  s.active.is_approaching =
      l.kind != PathKind::resume && s.active.offset.cwiseAbs().maxCoeff() >
                                        offset_threshold * control_.reference_pressure;
  s.stage = stage;
  s.n_in_stage = s.n_held = 0;
  s.largest_progress = 0.0;
  s.tension = 0.0;
}

/// Change the stresses to hold at the rate at which the controlled strain would change
/// them; then hold them, and begin the stage again from there.
void ElementTest::approach(double rate)
{
  ElementState& s = state_;
  ActiveStage& c = s.active;
  const double change = s.servo.stiffness.minCoeff() * rate * s.dt;
  c.remaining = std::max(0.0, c.remaining - change / c.offset.cwiseAbs().maxCoeff());
  if (c.remaining > 0.0 || ++s.n_held < steps_held) return;
  c = dem::begin_stage(control_.stages[s.stage], c, soil(stress()), s.assembly.cell.size);
  s.n_in_stage = 0;
  s.largest_progress = s.tension = 0.0;
}

double ElementTest::controlled_rate(const SoilState& now) const
{
  const double p = std::max(std::abs(now.p()), control_.reference_pressure);
  return control_.inertial_number / (state_.mean_diameter * std::sqrt(state_.density / p));
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
  if (s.n_steps % steps_between_step_checks == 0) {
    update_stable_step(s.stable_step, s.assembly, control_.step, s.n_steps, s.dt,
                       control_.damping);
    s.dt = control_.step.safety * s.stable_step.limit;
    update_stiffness();
    check_overlaps(s.assembly);
  }
  const Vec3 sigma = stress();
  const SoilState now = soil(sigma);
  const double full = controlled_rate(now);
  const auto n = static_cast<double>(std::min(s.n_in_stage + 1, steps_of_ramp));
  const double rate = full * n / steps_of_ramp;
  s.largest_rate = std::max(s.largest_rate, rate);
  s.servo.limit = rate_limit_factor * full;
  const CellControl control = s.active.control(now, rate);
  const Vec3 rates = s.servo.rates(control, sigma, s.dt);
  advance(s.assembly, s.dt_before, s.dt, [&](double) { s.assembly.cell.rate = rates; });
  s.dt_before = s.dt;
  s.time += s.dt;
  s.since_record += rate * s.dt;
  ++s.n_steps;
  ++s.n_in_stage;

  s.stress_sum += stress();
  for (int a = 0; a < 3; ++a) {
    const AxisControl& axis = control[static_cast<std::size_t>(a)];
    if (axis.holds_stress) s.held_sum[a] += axis.stress;
  }
  ++s.n_stress;
  if (s.active.is_approaching) approach(rate);
}

/// Whether an axis has lost its tension: the controlled axis while it is extended further,
/// or an axis that bears too little of the tension that it is to hold.
bool ElementTest::is_pulled_apart() const
{
  const ElementState& s = state_;
  const double counts = tension_threshold * control_.reference_pressure;
  const double pull = -s.active.controlled_stress(soil(mean_stress()));
  const bool is_extended = !s.active.is_approaching && s.active.direction < 0.0;
  if (is_extended && s.tension > counts && pull < min_tension_share * s.tension)
    return true;
  const Vec3 wanted = s.held_sum / static_cast<double>(s.n_stress), borne = mean_stress();
  for (int a = 0; a < 3; ++a)
    if (wanted[a] > counts && borne[a] < min_held_share * wanted[a]) return true;
  return false;
}

Outcome ElementTest::outcome() const
{
  const ElementState& s = state_;
  if (!s.active.is_approaching && s.active.has_reached_target(soil(stress())))
    return Outcome::done;
  if (!record_is_due()) return Outcome::goes_on;

  if (is_pulled_apart()) return Outcome::pulled_apart;
  const SoilState now = soil(mean_stress());
  if (!s.active.is_approaching && !is_strain(s.active.quantity)) {
    const double fallen = s.largest_progress - s.active.progress(now);
    if (s.largest_progress > 0.05 && fallen > control_.reversal * s.largest_progress)
      return Outcome::reversed;
  }
  const auto whole = soil_state(stress(), s.assembly.cell.size, s.size_0);
  return whole.largest_strain() > control_.strain_limit ? Outcome::strain_limit_reached
                                                        : Outcome::goes_on;
}

ElementRecord ElementTest::record()
{
  ElementState& s = state_;
  ElementRecord r;
  r.time = s.time;
  r.stage = s.stage;
  r.is_approach = s.active.is_approaching;
  r.averages = cell_averages(s.assembly);
  const Vec3 sigma = r.averages.stress.diagonal();
  r.whole = soil_state(sigma, s.assembly.cell.size, s.size_0);
  r.of_stage = soil(sigma);
  r.controlled_strain = s.active.controlled_strain(r.of_stage);
  r.broken = s.assembly.comm.global_sum(s.assembly.losses.broken);
  for (std::size_t k = 0; k < n_break_modes; ++k)
    r.broken_by[k] = s.assembly.comm.global_sum(s.assembly.losses.broken_by[k]);
  r.balance = energy_balance(s.assembly, s.dt);
  s.gross_work += std::abs(r.balance.cell_work - s.last_work);
  s.last_work = r.balance.cell_work;
  const double scale = s.start.stored() + s.gross_work;
  r.energy_error = scale > 0.0 ? unexplained(r.balance, s.start) / scale : 0.0;
  r.inertial_number =
      inertial_number(s.assembly.cell.rate.norm(), s.mean_diameter, s.density,
                      std::max(std::abs(r.whole.p()), control_.reference_pressure));
  r.unbalanced = unbalanced_ratio(s.assembly);
  r.time_step = s.dt;
  r.stable_step = s.stable_step.limit;

  if (s.n_stress > 0) {
    const SoilState mean = soil(mean_stress());
    s.tension = std::max(s.tension, -s.active.controlled_stress(mean));
    if (!s.active.is_approaching)
      s.largest_progress = std::max(s.largest_progress, s.active.progress(r.of_stage));
  }
  s.stress_sum.setZero();
  s.held_sum.setZero();
  s.n_stress = 0;
  s.since_record = 0.0;
  s.alarm.add(r.energy_error, s.time, s.gross_work, s.start.stored());
  if (!(std::abs(r.energy_error) <= 0.01))
    throw Unstable("the energy balance leaves " + std::to_string(r.energy_error) +
                   " of the work unexplained (at most 0.01) at step " +
                   std::to_string(s.n_steps) + ": lower `Motion/time step safety`");
  return r;
}

} // namespace mergel::dem
