#include "coupling/triaxial/triaxial_test.h"

#include "dem/assembly/averages.h"
#include "dem/assembly/overlaps.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mergel::coupling {

using dem::SoilState;
using dem::Vec3;
using Controlled = dem::ActiveStage::Controlled;

namespace {

/// Steps over which the rate of a stage is ramped up: some transits of a wave.
constexpr std::size_t steps_of_ramp = 4000;
/// Limit of the velocity of a platen that holds a stress, over that of the test.
constexpr double rate_limit_factor = 10.0;
/// Smallest offset that starts an approach, over the reference pressure.
constexpr double offset_threshold = 0.01;
constexpr std::size_t steps_held = 2000; ///< after an approach, or an isotropic stage
/// Bulk modulus over the axial stiffness of particles that follow the strain [-]: in
/// `element_small` 0.37.
constexpr double bulk_share = 1.0 / 3.0;
/// Axial stress at one platen in extension below which it counts as lifted off, over the cell
/// pressure. The membrane presses single particles against a platen that has left the specimen:
/// 0.011 with seven particles across.
constexpr double lifted_off = 0.02;
constexpr double transits_of_servo = 4.0; ///< of a wave, in the integral of the servo
constexpr std::size_t steps_between_strains = 100;
/// Largest stretch of a membrane: rubber tears at some six, and the springs of the triangles
/// no longer describe it long before [-].
constexpr double largest_stretch = 3.0;

} // namespace

TriaxialTest::TriaxialTest(const TriaxialControl& control, const SpecimenGeometry& geometry,
                           CoupledSystem& system)
    : control_(control), geometry_(geometry), system_(system)
{
  find_structures();
  double m = 0.0, V = 0.0, dV = 0.0;
  for (const dem::ParticleState& b : system_.assembly.particles.state) {
    const double v = dem::sphere_mass(b.R, 1.0);
    m += b.m;
    V += v;
    dV += 2.0 * b.R * v;
  }
  state_.mean_diameter = dV / V;
  state_.particle_density = m / V;
  state_.density = m / (geometry_.area * geometry_.height);
  begin_here();
}

/// Strains, volumes and energies count from the present state.
void TriaxialTest::begin_here()
{
  dem::Assembly& a = system_.assembly;
  a.partition.gather_motion(a.particles, a.comm);
  system_.x_0.clear();
  for (const dem::ParticleState& b : a.particles.state) system_.x_0.push_back(b.x);
  middle_ = MiddleThird(system_.x_0, geometry_.z_bottom, geometry_.height);
  state_.middle = {};
  state_.height = geometry_.height;
  state_.stiffness = dem::affine_stiffness(a, geometry_.area * geometry_.height).z();
  require(state_.stiffness > 0.0,
          "Specimen: no particles touch and none are bonded: it has no stiffness");
  state_.bottom_travel_0 = bottom_->motion().travel;
  state_.top_travel_0 = top_->motion().travel;
  if (membrane_) state_.volume_0 = membrane_->motion().enclosed().V;
  state_.start = system_.energy_balances();
  state_.last_work = state_.start.structures.applied_work;
}

TriaxialTest::TriaxialTest(const TriaxialControl& control, const SpecimenGeometry& geometry,
                           CoupledSystem& system, const dem::State& state)
    : control_(control), geometry_(geometry), system_(system)
{
  find_structures();
  load(state);
  middle_ = MiddleThird(system_.x_0, geometry_.z_bottom, geometry_.height);
}

void TriaxialTest::find_structures()
{
  const auto structure = [&](std::size_t k) {
    return system_.structures[k].structure.get();
  };
  bottom_ = dynamic_cast<RigidPlaten*>(structure(0));
  top_ = dynamic_cast<RigidPlaten*>(structure(1));
  if (system_.structures.size() > 2)
    membrane_ = dynamic_cast<MembraneStructure*>(structure(2));
  if (!bottom_ || !top_ || (system_.structures.size() > 2 && !membrane_))
    throw std::logic_error("a triaxial test has two platens and perhaps a membrane");
}

/// Height between the platens [m].
double TriaxialTest::height() const
{
  return geometry_.height - (bottom_->motion().travel - state_.bottom_travel_0) -
         (top_->motion().travel - state_.top_travel_0);
}

/// V/H with the volumetric strain of the middle third, as laboratories correct it.
double TriaxialTest::area() const
{
  return geometry_.area * (1.0 - state_.middle.volumetric) * geometry_.height /
         state_.height;
}

Vec3 TriaxialTest::size() const
{
  const double width = std::sqrt(area());
  return {width, width, state_.height};
}

Vec3 TriaxialTest::size_0() const
{
  const double width = std::sqrt(geometry_.area);
  return {width, width, geometry_.height};
}

SoilState TriaxialTest::soil(double axial_stress, double lateral, const Vec3& size_0) const
{
  return dem::soil_state({-lateral, -lateral, -axial_stress}, size(), size_0);
}

SoilState TriaxialTest::soil(double axial_stress) const
{
  const Vec3& of_stage = state_.active.size_0;
  return soil(axial_stress, state_.pressure, of_stage.isZero() ? size_0() : of_stage);
}

/// Mean of both platens in the last step [Pa].
double TriaxialTest::platen_stress() const
{
  return -0.5 * (bottom_->motion().load.f + top_->motion().load.f) / area();
}

double TriaxialTest::wave_speed() const
{
  return std::sqrt(state_.stiffness / state_.density);
}

/// Axial strain rate at which neither platen sends a larger wave than wave_stress, and the
/// inertial number keeps its limit [1/s].
double TriaxialTest::full_rate(const SoilState& now) const
{
  const double v = control_.wave_stress / (state_.density * wave_speed());
  const double p = std::max(std::abs(now.p()), control_.reference_pressure);
  return std::min(2.0 * v / state_.height,
                  control_.inertial_number /
                      (state_.mean_diameter * std::sqrt(state_.particle_density / p)));
}

void TriaxialTest::begin_stage(std::size_t stage)
{
  TriaxialState& s = state_;
  const dem::LoadingStage& l = control_.stages[stage];
  s.active = dem::begin_stage(l, s.active, soil(s.axial), size());
  s.active.is_approaching =
      l.kind != dem::PathKind::resume && s.active.offset.cwiseAbs().maxCoeff() >
                                             offset_threshold * control_.reference_pressure;
  s.stage = stage;
  s.n_in_stage = s.n_held = 0;
  s.largest_progress = 0.0;
}

/// Whether an isotropic stage is at its target. It prescribes the cell pressure; the axial
/// stress, a mean over some transits of a wave, comes after it.
bool TriaxialTest::is_consolidated() const
{
  return state_.active.has_reached_target(soil(state_.pressure));
}

/// Cell pressure and velocities of the platens for the next step.
void TriaxialTest::control(double rate)
{
  TriaxialState& s = state_;
  const dem::ActiveStage& stage = s.active;
  const dem::CellControl cell = stage.control(soil(s.axial), rate);
  const dem::AxisControl& axial = cell[2];
  bool holds_axial = axial.holds_stress;
  double held = -axial.stress;
  if (stage.controlled == Controlled::all && !stage.is_approaching) {
    if (s.n_held == 0 && !is_consolidated())
      s.pressure += stage.direction * bulk_share * s.stiffness * rate * system_.dt;
    else
      ++s.n_held;
    held = s.pressure;
    holds_axial = true;
  } else if (cell[0].holds_stress) {
    s.pressure = -cell[0].stress;
  }
  if (membrane_) membrane_->set_pressure(s.pressure);

  double v = -0.5 * axial.rate * s.height; // towards the specimen
  if (holds_axial) {
    // The platens as dampers with the impedance of the specimen, so that no wave comes back;
    // an integral, over some transits of a wave, takes the error that a ramp leaves.
    const double most = rate_limit_factor * 0.5 * full_rate(soil(s.axial)) * s.height;
    const double error = (held - platen_stress()) / (2.0 * s.density * wave_speed());
    v = error + s.servo_v;
    if (std::abs(v) > most)
      ++s.n_limited;
    else
      s.servo_v += error * system_.dt * wave_speed() / (transits_of_servo * s.height);
    v = std::clamp(v, -most, most);
  } else {
    s.servo_v = 0.0;
  }
  bottom_->set_drive(VelocityDrive{v});
  top_->set_drive(VelocityDrive{v});
}

/// As dem::ElementTest::approach().
void TriaxialTest::approach(double rate)
{
  TriaxialState& s = state_;
  dem::ActiveStage& c = s.active;
  const double change = s.stiffness * rate * system_.dt;
  c.remaining = std::max(0.0, c.remaining - change / c.offset.cwiseAbs().maxCoeff());
  if (c.remaining > 0.0 || ++s.n_held < steps_held) return;
  c = dem::begin_stage(control_.stages[s.stage], c, soil(s.axial), size());
  s.n_in_stage = s.n_held = 0;
  s.largest_progress = 0.0;
}

void TriaxialTest::read_strain()
{
  state_.middle = middle_.strain(system_.assembly);
}

void TriaxialTest::step()
{
  TriaxialState& s = state_;
  if (system_.n_steps % dem::steps_between_step_checks == 0) {
    dem::check_overlaps(system_.assembly);
    require_inside();
  }
  const double full = full_rate(soil(s.axial));
  const auto n = static_cast<double>(std::min(s.n_in_stage + 1, steps_of_ramp));
  const double rate = full * n / steps_of_ramp;
  s.largest_rate = std::max(s.largest_rate, rate);
  control(rate);
  system_.step([](double) {});

  const double dt = system_.dt_before;
  s.time += dt;
  s.height = height();
  s.since_record += rate * dt;
  ++s.n_in_stage;
  // Over four transits of a wave: what a load cell would show.
  const double window = 4.0 * s.height / wave_speed();
  s.axial += std::min(1.0, dt / window) * (platen_stress() - s.axial);
  s.bottom_sum -= bottom_->motion().load.f;
  s.top_sum -= top_->motion().load.f;
  s.pressure_sum += s.pressure;
  ++s.n_sum;
  if (system_.n_steps % steps_between_strains == 0) read_strain();
  if (s.active.is_approaching) approach(rate);
}

/// @throws Unstable for a particle outside of the membrane, or a membrane that bursts
void TriaxialTest::require_inside() const
{
  if (!membrane_) return;
  const fem::MembraneFields fields =
      membrane_->motion().membrane().fields(membrane_->motion().state().x);
  const auto most = std::max_element(fields.stretch_1.begin(), fields.stretch_1.end());
  const auto where = [&](const Vec3& x) {
    return "at z = " + dem::shortest(1e3 * x.z()) + " mm (step " +
           std::to_string(system_.n_steps) + ", t = " + dem::shortest(1e3 * system_.time) +
           " ms)";
  };
  if (most != fields.stretch_1.end() && *most > largest_stretch) {
    const auto t = static_cast<std::size_t>(most - fields.stretch_1.begin());
    const int node = membrane_->motion().membrane().rest().triangles[t][0];
    throw Unstable("the membrane bursts: it is stretched to " + dem::shortest(*most) + ' ' +
                   where(fem::at(membrane_->motion().state().x, node)) +
                   ": raise `Membrane/Young's modulus` or its thickness, or lower the cell "
                   "pressure");
  }

  double r2 = 0.0; // of the membrane, largest
  const fem::NodalField& x = membrane_->motion().state().x;
  for (Eigen::Index a = 0; a < x.cols(); ++a)
    r2 = std::max(r2, x(0, a) * x(0, a) + x(1, a) * x(1, a));
  Fault fault;
  const dem::Particles& p = system_.assembly.particles;
  fault.run([&] {
    p.for_owned([&](dem::Index i) {
      const Vec3& at = p.state[i].x;
      if (at.x() * at.x() + at.y() * at.y() > r2)
        throw NumericalError("particle " + std::to_string(p.id[i]) +
                             " is outside of the membrane " + where(at));
    });
  });
  system_.assembly.comm.agree_on(fault);
}

dem::Outcome TriaxialTest::outcome() const
{
  const TriaxialState& s = state_;
  const bool is_isotropic = s.active.controlled == Controlled::all;
  const SoilState now = soil(is_isotropic ? s.pressure : s.axial);
  if (is_isotropic && s.n_held >= steps_held) return dem::Outcome::done;
  if (!is_isotropic && !s.active.is_approaching && s.active.has_reached_target(now))
    return dem::Outcome::done;
  if (!record_is_due()) return dem::Outcome::goes_on;
  const bool extends = s.active.direction < 0.0 && s.active.controlled == Controlled::axial;
  const double F = std::min(s.top_sum, s.bottom_sum) / static_cast<double>(s.n_sum);
  if (extends && !s.active.is_approaching && now.lateral() > 0.0 &&
      F < lifted_off * now.lateral() * area())
    return dem::Outcome::pulled_apart;
  if (!s.active.is_approaching && !dem::is_strain(s.active.quantity)) {
    const double fallen = s.largest_progress - s.active.progress(now);
    if (s.largest_progress > 0.05 && fallen > control_.reversal * s.largest_progress)
      return dem::Outcome::reversed;
  }
  return soil(s.axial, s.pressure, size_0()).largest_strain() > control_.strain_limit
             ? dem::Outcome::strain_limit_reached
             : dem::Outcome::goes_on;
}

MembraneRecord TriaxialTest::membrane_record() const
{
  MembraneRecord r;
  if (!membrane_) return r;
  const fem::MembraneMotion& motion = membrane_->motion();
  const fem::NodalField& x = motion.state().x;
  r.volume = motion.enclosed().V;
  r.strain = 1.0 - r.volume / state_.volume_0;
  r.penetration = r.strain - state_.middle.volumetric;
  const fem::MembraneTensions tensions = motion.membrane().tensions(x);
  r.axial = -tensions.axial / r.volume;
  r.hoop = 0.5 * tensions.hoop / r.volume;
  const fem::MembraneFields fields = motion.membrane().fields(x);
  r.wrinkled = static_cast<double>(fields.n_wrinkled + fields.n_slack) /
               static_cast<double>(fields.state.size());
  r.stretch = *std::max_element(fields.stretch_1.begin(), fields.stretch_1.end());
  r.n_folds = motion.membrane().n_folds(x);

  dem::ForceSum inwards;
  for (const dem::WallContactForce& c : system_.assembly.walls[2].contact_forces) {
    const double r_xy = std::hypot(c.point.x(), c.point.y());
    if (r_xy > 0.0) inwards.add(-(c.f.x() * c.point.x() + c.f.y() * c.point.y()) / r_xy);
  }
  dem::ExactReduction sums;
  sums.add(inwards);
  sums.run(system_.assembly.comm);
  r.delivered = inwards.value() / (2.0 * std::sqrt(dem::pi * area()) * state_.height);
  return r;
}

TriaxialRecord TriaxialTest::record()
{
  TriaxialState& s = state_;
  dem::Assembly& a = system_.assembly;
  read_strain();
  TriaxialRecord r;
  r.time = s.time;
  r.stage = s.stage;
  r.is_approach = s.active.is_approaching;
  r.middle = s.middle;
  r.membrane = membrane_record();
  const auto mean = [&](double sum, double last) {
    return s.n_sum > 0 ? sum / static_cast<double>(s.n_sum) : last;
  };
  r.F_top = mean(s.top_sum, -top_->motion().load.f);
  r.F_bottom = mean(s.bottom_sum, -bottom_->motion().load.f);
  r.cell_pressure = mean(s.pressure_sum, s.pressure);
  const double axial = 0.5 * (r.F_top + r.F_bottom) / area();
  const double lateral = r.cell_pressure + r.membrane.hoop;
  r.whole = soil(axial, lateral, size_0());
  const Vec3& of_stage = s.active.size_0;
  r.of_stage = soil(axial, lateral, of_stage.isZero() ? size_0() : of_stage);
  r.controlled_strain = s.active.controlled_strain(r.of_stage);
  r.q_raw = axial + r.membrane.axial - r.cell_pressure;
  const double z = geometry_.z_bottom + bottom_->motion().travel - s.bottom_travel_0;
  const dem::Mat3 sigma =
      dem::slab_stress(a, z + s.height / 3.0, z + 2.0 * s.height / 3.0, area());
  r.middle_axial = -sigma(2, 2);
  r.middle_lateral = -0.5 * (sigma(0, 0) + sigma(1, 1));
  r.tilt = std::acos(std::clamp(-top_->axis().z(), -1.0, 1.0));
  r.void_ratio = (1.0 + geometry_.void_ratio) * (1.0 - s.middle.volumetric) - 1.0;
  r.broken = a.comm.global_sum(a.losses.broken);
  for (std::size_t k = 0; k < dem::n_break_modes; ++k)
    r.broken_by[k] = a.comm.global_sum(a.losses.broken_by[k]);
  a.losses.breakages.clear();
  r.balance = system_.energy_balances();
  const double work = r.balance.structures.applied_work;
  s.gross_work += std::abs(work - s.last_work);
  s.last_work = work;
  // At first the work is next to nothing: an error counts against what the specimen stores
  // under the reference pressure.
  const double p_ref = control_.reference_pressure;
  const double reference =
      0.5 * p_ref * p_ref / s.stiffness * geometry_.area * geometry_.height;
  r.energy_error = unexplained(r.balance, s.start) / (reference + s.gross_work);
  r.interface = system_.balance();
  r.inertial_number =
      dem::inertial_number(full_rate(r.whole), s.mean_diameter, s.particle_density,
                           std::max(std::abs(r.whole.p()), control_.reference_pressure));
  r.unbalanced = system_.unbalanced();
  r.time_step = system_.dt;
  r.stable_step = system_.stable_step.limit;
  if (!s.active.is_approaching)
    s.largest_progress = std::max(s.largest_progress, s.active.progress(soil(s.axial)));
  s.top_sum = s.bottom_sum = s.pressure_sum = s.since_record = 0.0;
  s.n_sum = 0;
  // At first, while the membrane sinks into the pores at speed, the error is up to 1e-3; then it
  // falls below 1e-4 (triaxial_small).
  s.alarm.add(r.energy_error, s.time, s.gross_work, 5.0 * reference);
  if (!(std::abs(r.energy_error) <= 0.01))
    throw Unstable("the energy balance leaves " + dem::shortest(r.energy_error) +
                   " of the work unexplained (at most 0.01) at step " +
                   std::to_string(system_.n_steps) + ": lower `Motion/time step safety`");
  return r;
}

} // namespace mergel::coupling
