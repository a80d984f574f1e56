#include "tests/support/catch.h"

#include "dem/element/stress_path.h"

#include "dem/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace mergel::dem;

namespace {

/// A linear elastic cell, E and nu, that follows the control of each axis exactly.
struct ElasticCell {
  double E = 1e9, nu = 0.2;
  Vec3 size = Vec3::Ones(), strain = Vec3::Zero(); ///< strain: extension positive

  Vec3 stress() const
  {
    const double lambda = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)),
                 G = 0.5 * E / (1.0 + nu);
    return 2.0 * G * strain + Vec3::Constant(lambda * strain.sum());
  }
  SoilState state(const Vec3& size_0) const { return soil_state(stress(), size, size_0); }

  void deform(const Vec3& de)
  {
    strain += de;
    size = size.cwiseProduct(Vec3::Ones() + de);
  }

  /// Moves strain-controlled axes by dt times their rate, stress-controlled ones to the
  /// stress that the next state asks for.
  void follow(const ActiveStage& active, double dt)
  {
    Vec3 de = Vec3::Zero();
    for (int pass = 0; pass < 60; ++pass) { // the control depends on the state
      ElasticCell next = *this;
      next.deform(de);
      const CellControl control = active.control(next.state(active.size_0), 1.0);
      const Vec3 s = next.stress();
      for (int a = 0; a < 3; ++a) {
        const AxisControl& axis = control[static_cast<std::size_t>(a)];
        if (!axis.holds_stress)
          de[a] = dt * axis.rate;
        else if (active.follow == ActiveStage::Follow::mean)
          de[a] = dt * axis.rate + 0.5 * (axis.stress - s[a]) / E;
        else
          de[a] += 0.5 * (axis.stress - s[a]) / E;
      }
    }
    deform(de);
  }

  /// Follows the stage to its target; changes `active` and returns the final state.
  SoilState lead(const LoadingStage& stage, ActiveStage& active)
  {
    active = begin_stage(stage, active,
                         state(active.size_0.isZero() ? size : active.size_0), size);
    for (int k = 0; k < 20000; ++k) {
      if (active.has_reached_target(state(active.size_0))) break;
      follow(active, 1e-5);
    }
    REQUIRE(active.has_reached_target(state(active.size_0)));
    return state(active.size_0);
  }
};

LoadingStage stage(PathKind kind, Quantity quantity, double target)
{
  LoadingStage l;
  l.kind = kind;
  l.quantity = quantity;
  l.target = target;
  if (kind != PathKind::resume) l.check();
  return l;
}

} // namespace

TEST_CASE("Each kind of loading stage keeps its conditions and ends at its target",
          "[unit][dem]")
{
  // One step of 1e-5 is 1e4 Pa: targets are overshot by less.
  ElasticCell cell;
  ActiveStage active;
  SoilState s = cell.lead(stage(PathKind::isotropic, Quantity::p, 1e6), active);
  CHECK(s.p() == Approx(1e6).margin(1.5e4));
  CHECK(s.q() == Approx(0.0).margin(1.0));
  const double lateral = s.lateral();
  s = cell.lead(stage(PathKind::triaxial, Quantity::axial_strain, 2e-3), active);
  CHECK(s.lateral() == Approx(lateral).epsilon(1e-6));
  CHECK(s.q() == Approx(2e-3 * cell.E).epsilon(0.01));
  const double q = s.q();
  s = cell.lead(stage(PathKind::resume, Quantity::q, 0.5e6), active); // unload
  CHECK(s.q() == Approx(0.5e6).margin(1.5e4));
  CHECK(s.lateral() == Approx(lateral).epsilon(1e-6));
  LoadingStage back = stage(PathKind::resume, Quantity::q, 0.0);
  back.returns = true;
  s = cell.lead(back, active);
  CHECK(s.q() == Approx(q).margin(2e4));
  s = cell.lead(stage(PathKind::resume, Quantity::axial_strain, 3e-3), active);
  CHECK(s.axial_strain() ==
        Approx(3e-3).margin(2e-5)); // counted from the triaxial stage on

  ElasticCell pressed;
  ActiveStage along;
  s = pressed.lead(stage(PathKind::oedometer, Quantity::axial_stress, 2e6), along);
  CHECK(s.lateral_strain() == 0.0);
  CHECK(s.lateral() / s.axial() == Approx(0.2 / 0.8).epsilon(1e-9)); // nu/(1 - nu)
  ElasticCell pulled;
  ActiveStage out;
  s = pulled.lead(stage(PathKind::tension, Quantity::axial_strain, -1e-3), out);
  CHECK(s.axial() == Approx(-1e6).epsilon(0.02));
  CHECK(std::abs(s.lateral()) < 10.0);
}

TEST_CASE("A radial path keeps dq/dp, whichever axis is strain-controlled", "[unit][dem]")
{
  for (const double k : {0.5, 1.5, 2.9, -1.0, -1.5, -2.5, 6.0}) {
    ElasticCell cell;
    ActiveStage active;
    const SoilState a = cell.lead(stage(PathKind::isotropic, Quantity::p, 1e6), active);
    LoadingStage radial;
    radial.kind = PathKind::radial;
    radial.slope = k;
    radial.target = k > 0.0 ? 2e6 : 1.2e6;
    radial.check();
    const SoilState b = cell.lead(radial, active);
    CAPTURE(k);
    CHECK((b.q() - a.q()) / (b.p() - a.p()) == Approx(k).epsilon(1e-4));
    CHECK(b.p() == Approx(radial.target).margin(2e4));
  }
  ElasticCell cell;
  ActiveStage active;
  const SoilState a = cell.lead(stage(PathKind::isotropic, Quantity::p, 2e6), active);
  LoadingStage shear;
  shear.kind = PathKind::radial;
  shear.slope = std::numeric_limits<double>::infinity();
  shear.quantity = Quantity::q;
  shear.target = 1e6;
  const SoilState b = cell.lead(shear, active);
  CHECK(b.p() == Approx(a.p()).epsilon(1e-4));
  CHECK(b.q() == Approx(1e6).margin(2e4));
}

TEST_CASE("One rule per axis gives plane strain", "[unit][dem]")
{
  // x fixed, y = 0.5 MPa, z strain-controlled: sigma_x = nu (sigma_y + sigma_z), to 1e4 Pa
  // of a step
  ElasticCell cell;
  ActiveStage active;
  LoadingStage plane;
  plane.kind = PathKind::axes;
  plane.axes = {AxisRule{},
                {AxisRule::Kind::stress_controlled, 0.5e6},
                {AxisRule::Kind::strain_controlled}};
  plane.quantity = Quantity::axial_strain;
  plane.target = 2e-3;
  plane.check();
  const SoilState s = cell.lead(plane, active);
  CHECK(s.strain.x() == 0.0);
  CHECK(s.stress.y() == Approx(0.5e6).epsilon(1e-3));
  CHECK(s.stress.x() == Approx(cell.nu * (s.stress.y() + s.stress.z())).epsilon(1e-6));

  plane.quantity = Quantity::y_strain; // not that of the strain-controlled axis
  CHECK_THROWS_AS(plane.check(), mergel::InputError);
  plane.quantity = Quantity::y_stress; // stress-controlled
  CHECK_THROWS_AS(plane.check(), mergel::InputError);
  plane.axes[0].kind = AxisRule::Kind::strain_controlled;
  plane.quantity = Quantity::axial_strain;
  CHECK_THROWS_AS(plane.check(), mergel::InputError);
}

TEST_CASE("A return stage ends when its strain is restored, even if the stress is not",
          "[unit][dem]")
{
  ElasticCell cell;
  ActiveStage active;
  cell.lead(stage(PathKind::triaxial, Quantity::axial_strain, 2e-3), active);
  cell.lead(stage(PathKind::resume, Quantity::q, 0.5e6), active); // unload from 2 MPa
  cell.E *= 0.5; // loses stiffness meanwhile
  LoadingStage back = stage(PathKind::resume, Quantity::q, 0.0);
  back.returns = true;
  const SoilState s = cell.lead(back, active);
  CHECK(s.q() < 1.1e6);
  CHECK(s.axial_strain() == Approx(2e-3).margin(2e-5)); // one step
}

TEST_CASE("A stage with another lateral stress approaches it before strain control begins",
          "[unit][dem]")
{
  ElasticCell cell;
  ActiveStage active;
  cell.lead(stage(PathKind::isotropic, Quantity::p, 1e6), active);
  LoadingStage at = stage(PathKind::triaxial, Quantity::axial_strain, 0.01);
  at.has_lateral = true;
  at.lateral = 0.25e6;
  const SoilState now = cell.state(cell.size);
  active = begin_stage(at, active, now, cell.size);
  CHECK(active.offset.x() == Approx(now.stress.x() - 0.25e6));
  CHECK(active.offset.z() == 0.0); // strain-controlled: no stress to approach
  active.is_approaching = true;
  for (const double remaining : {1.0, 0.5, 0.0}) {
    active.remaining = remaining;
    const CellControl control = active.control(now, 1.0);
    const double lateral = 0.25e6 + remaining * active.offset.x();
    CHECK(control[0].stress == Approx(-lateral));
    CHECK(control[2].holds_stress);
    CHECK(control[2].stress == Approx(-lateral - now.q()));
  }
  active.is_approaching = false;
  CHECK_FALSE(active.control(now, 1.0)[2].holds_stress);

  // On the approach to equal stresses the control asks for the p at the start of the stage,
  // whatever p is now.
  cell.lead(stage(PathKind::triaxial, Quantity::axial_strain, 2e-3), active);
  const SoilState sheared = cell.state(cell.size);
  active =
      begin_stage(stage(PathKind::isotropic, Quantity::p, 4e6), active, sheared, cell.size);
  active.is_approaching = true;
  active.remaining = 0.0;
  SoilState lower = sheared;
  lower.stress *= 0.9;
  for (const AxisControl& axis : active.control(lower, 1.0))
    CHECK(axis.stress == Approx(-sheared.p()));
}

namespace {

/// Largest deviation of q from its value at the start of the approach of a stage [Pa].
double change_of_q(ElasticCell cell, const LoadingStage& stage)
{
  const SoilState start = cell.state(cell.size);
  ActiveStage active = begin_stage(stage, {}, start, cell.size);
  REQUIRE(active.offset.cwiseAbs().maxCoeff() > 1e5);
  active.is_approaching = true;
  double largest = 0.0;
  for (const double remaining : {0.9, 0.6, 0.3, 0.0}) {
    active.remaining = remaining;
    cell.follow(active, 0.0);
    largest = std::max(largest, std::abs(cell.state(cell.size).q() - start.q()));
  }
  return largest;
}

} // namespace

TEST_CASE("The approach to a lateral stress leaves q as it was", "[unit][dem]")
{
  LoadingStage at = stage(PathKind::triaxial, Quantity::axial_strain, 0.01);
  at.has_lateral = true;
  at.lateral = 3e6;
  CHECK(change_of_q({}, at) < 1.0); // consolidation from zero is isotropic

  ElasticCell sheared;
  ActiveStage active;
  sheared.lead(stage(PathKind::isotropic, Quantity::p, 1e6), active);
  sheared.lead(stage(PathKind::triaxial, Quantity::q, 0.5e6), active);
  sheared.deform({1e-4, -1e-4, 0.0}); // and x differs from y
  CHECK(change_of_q(sheared, at) < 1.0);
  const LoadingStage to_zero = stage(PathKind::compression, Quantity::axial_strain, 0.01);
  CHECK(change_of_q(sheared, to_zero) < 1.0);
  CHECK(change_of_q(sheared, stage(PathKind::tension, Quantity::axial_strain, -0.01)) <
        1.0);
}

TEST_CASE("The approach of a stage that rules each axis leaves the others to themselves",
          "[unit][dem]")
{
  LoadingStage plane;
  plane.kind = PathKind::axes;
  plane.axes = {AxisRule{},
                {AxisRule::Kind::stress_controlled, 0.5e6},
                {AxisRule::Kind::strain_controlled}};
  plane.quantity = Quantity::axial_strain;
  plane.target = 2e-3;
  ElasticCell cell;
  ActiveStage active = begin_stage(plane, {}, cell.state(cell.size), cell.size);
  active.is_approaching = true;
  active.remaining = 0.0;
  cell.follow(active, 0.0);
  const SoilState s = cell.state(cell.size);
  CHECK(s.strain.x() == 0.0);
  CHECK(s.stress.y() == Approx(0.5e6));
  CHECK(s.stress.z() == Approx(0.0).margin(1.0)); // as it was
}

TEST_CASE("A stage that cannot reach its target by its kind is refused", "[unit][dem]")
{
  CHECK_THROWS_AS(stage(PathKind::isotropic, Quantity::q, 1e6), mergel::InputError);
  CHECK_THROWS_AS(stage(PathKind::triaxial, Quantity::lateral_stress, 1e6),
                  mergel::InputError);
  CHECK_THROWS_AS(stage(PathKind::tension, Quantity::axial_strain, 0.01),
                  mergel::InputError);
  CHECK_THROWS_AS(stage(PathKind::compression, Quantity::axial_strain, -0.01),
                  mergel::InputError);
  CHECK_THROWS_AS(stage(PathKind::tension, Quantity::axial_stress, 1e6),
                  mergel::InputError);
  const LoadingStage iso = stage(PathKind::isotropic, Quantity::p, 1e6);
  CHECK_THROWS_AS(stage(PathKind::resume, Quantity::q, 1e6).check_after(iso),
                  mergel::InputError);
  CHECK_NOTHROW(stage(PathKind::resume, Quantity::p, 1e6).check_after(iso));
}
