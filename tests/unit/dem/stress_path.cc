#include "dem/element/stress_path.h"

#include "dem/error.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace mergel::dem;

namespace {

/// A linear elastic cell, E and nu, led by the exact solution of each order.
struct ElasticCell {
  double E = 1e9, nu = 0.2;
  Vec3 size = Vec3::Ones(), strain = Vec3::Zero(); ///< strain extension positive

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

  /// Driven axes by dt times their rate, held ones to their stress of the next state.
  void follow(const Course& course, double dt)
  {
    Vec3 de = Vec3::Zero();
    for (int pass = 0; pass < 60; ++pass) { // the orders follow the state: iterate
      ElasticCell next = *this;
      next.deform(de);
      const CellOrder order = course.order(next.state(course.size_0), 1.0);
      const Vec3 s = next.stress();
      for (int a = 0; a < 3; ++a) {
        const AxisOrder& axis = order[static_cast<std::size_t>(a)];
        if (!axis.holds_stress)
          de[a] = dt * axis.rate;
        else if (course.follow == Course::Follow::mean)
          de[a] = dt * axis.rate + 0.5 * (axis.stress - s[a]) / E;
        else
          de[a] += 0.5 * (axis.stress - s[a]) / E;
      }
    }
    deform(de);
  }

  /// Returns the course and where it ended.
  SoilState lead(const Leg& leg, Course& course)
  {
    course =
        set_out(leg, course, state(course.size_0.isZero() ? size : course.size_0), size);
    for (int k = 0; k < 20000; ++k) {
      if (course.has_reached_goal(state(course.size_0))) break;
      follow(course, 1e-5);
    }
    REQUIRE(course.has_reached_goal(state(course.size_0)));
    return state(course.size_0);
  }
};

Leg leg(PathKind kind, Quantity quantity, double goal)
{
  Leg l;
  l.kind = kind;
  l.quantity = quantity;
  l.goal = goal;
  if (kind != PathKind::resume) l.check();
  return l;
}

} // namespace

TEST_CASE("Each kind of leg keeps what it promises and ends at its goal", "[unit][dem]")
{
  // One step of 1e-5 is 1e4 Pa: goals are passed by less.
  ElasticCell cell;
  Course course;
  SoilState s = cell.lead(leg(PathKind::isotropic, Quantity::p, 1e6), course);
  CHECK(s.p() == Approx(1e6).margin(1.5e4));
  CHECK(s.q() == Approx(0.0).margin(1.0));
  const double lateral = s.lateral();
  s = cell.lead(leg(PathKind::triaxial, Quantity::axial_strain, 2e-3), course);
  CHECK(s.lateral() == Approx(lateral).epsilon(1e-6));
  CHECK(s.q() == Approx(2e-3 * cell.E).epsilon(0.01));
  const double q = s.q();
  s = cell.lead(leg(PathKind::resume, Quantity::q, 0.5e6), course); // unload
  CHECK(s.q() == Approx(0.5e6).margin(1.5e4));
  CHECK(s.lateral() == Approx(lateral).epsilon(1e-6));
  Leg back = leg(PathKind::resume, Quantity::q, 0.0);
  back.returns = true;
  s = cell.lead(back, course);
  CHECK(s.q() == Approx(q).margin(2e4));
  s = cell.lead(leg(PathKind::resume, Quantity::axial_strain, 3e-3), course);
  CHECK(s.axial_strain() == Approx(3e-3).margin(2e-5)); // counted from the triaxial leg on

  ElasticCell pressed;
  Course along;
  s = pressed.lead(leg(PathKind::oedometer, Quantity::axial_stress, 2e6), along);
  CHECK(s.lateral_strain() == 0.0);
  CHECK(s.lateral() / s.axial() == Approx(0.2 / 0.8).epsilon(1e-9)); // nu/(1 - nu)
  ElasticCell pulled;
  Course out;
  s = pulled.lead(leg(PathKind::tension, Quantity::axial_strain, -1e-3), out);
  CHECK(s.axial() == Approx(-1e6).epsilon(0.02));
  CHECK(std::abs(s.lateral()) < 10.0);
}

TEST_CASE("A radial path keeps dq/dp, whichever stress it drives", "[unit][dem]")
{
  for (const double k : {0.5, 1.5, 2.9, -1.0, -1.5, -2.5, 6.0}) {
    ElasticCell cell;
    Course course;
    const SoilState a = cell.lead(leg(PathKind::isotropic, Quantity::p, 1e6), course);
    Leg radial;
    radial.kind = PathKind::radial;
    radial.slope = k;
    radial.goal = k > 0.0 ? 2e6 : 1.2e6;
    radial.check();
    const SoilState b = cell.lead(radial, course);
    CAPTURE(k);
    CHECK((b.q() - a.q()) / (b.p() - a.p()) == Approx(k).epsilon(1e-4));
    CHECK(b.p() == Approx(radial.goal).margin(2e4));
  }
  ElasticCell cell;
  Course course;
  const SoilState a = cell.lead(leg(PathKind::isotropic, Quantity::p, 2e6), course);
  Leg shear;
  shear.kind = PathKind::radial;
  shear.slope = std::numeric_limits<double>::infinity();
  shear.quantity = Quantity::q;
  shear.goal = 1e6;
  const SoilState b = cell.lead(shear, course);
  CHECK(b.p() == Approx(a.p()).epsilon(1e-4));
  CHECK(b.q() == Approx(1e6).margin(2e4));
}

TEST_CASE("Axes with a rule each give plane strain", "[unit][dem]")
{
  // x fixed, y at 0.5 MPa, z driven: sigma_x = nu (sigma_y + sigma_z), to the step's 1e4 Pa
  ElasticCell cell;
  Course course;
  Leg plane;
  plane.kind = PathKind::axes;
  plane.axes = {AxisRule{}, {AxisRule::Kind::held, 0.5e6}, {AxisRule::Kind::driven}};
  plane.quantity = Quantity::axial_strain;
  plane.goal = 2e-3;
  plane.check();
  const SoilState s = cell.lead(plane, course);
  CHECK(s.strain.x() == 0.0);
  CHECK(s.stress.y() == Approx(0.5e6).epsilon(1e-3));
  CHECK(s.stress.x() == Approx(cell.nu * (s.stress.y() + s.stress.z())).epsilon(1e-6));

  plane.quantity = Quantity::y_strain; // not that of the driven axis
  CHECK_THROWS_AS(plane.check(), mergel::InputError);
  plane.quantity = Quantity::y_stress; // held
  CHECK_THROWS_AS(plane.check(), mergel::InputError);
  plane.axes[0].kind = AxisRule::Kind::driven;
  plane.quantity = Quantity::axial_strain;
  CHECK_THROWS_AS(plane.check(), mergel::InputError);
}

TEST_CASE("A return ends where its strain is back, though the stress is not", "[unit][dem]")
{
  ElasticCell cell;
  Course course;
  cell.lead(leg(PathKind::triaxial, Quantity::axial_strain, 2e-3), course);
  cell.lead(leg(PathKind::resume, Quantity::q, 0.5e6), course); // unload from 2 MPa
  cell.E *= 0.5;                                                // it broke meanwhile
  Leg back = leg(PathKind::resume, Quantity::q, 0.0);
  back.returns = true;
  const SoilState s = cell.lead(back, course);
  CHECK(s.q() < 1.1e6);
  CHECK(s.axial_strain() == Approx(2e-3).margin(2e-5)); // a step
}

TEST_CASE("A leg whose lateral stress is elsewhere approaches it before it is driven",
          "[unit][dem]")
{
  ElasticCell cell;
  Course course;
  cell.lead(leg(PathKind::isotropic, Quantity::p, 1e6), course);
  Leg at = leg(PathKind::triaxial, Quantity::axial_strain, 0.01);
  at.has_lateral = true;
  at.lateral = 0.25e6;
  const SoilState now = cell.state(cell.size);
  course = set_out(at, course, now, cell.size);
  CHECK(course.offset.x() == Approx(now.stress.x() - 0.25e6));
  CHECK(course.offset.z() == 0.0); // driven: holds nothing
  course.is_approaching = true;
  for (const double remaining : {1.0, 0.5, 0.0}) {
    course.remaining = remaining;
    const CellOrder order = course.order(now, 1.0);
    CHECK(order[0].stress == Approx(-0.25e6 - remaining * course.offset.x()));
    CHECK(order[2].holds_stress);
    CHECK(order[2].stress == Approx(-now.axial()));
  }
  course.is_approaching = false;
  CHECK_FALSE(course.order(now, 1.0)[2].holds_stress);

  // Towards equal stresses p stays: it is held at what it was, wherever it has gone since.
  cell.lead(leg(PathKind::triaxial, Quantity::axial_strain, 2e-3), course);
  const SoilState sheared = cell.state(cell.size);
  course = set_out(leg(PathKind::isotropic, Quantity::p, 4e6), course, sheared, cell.size);
  course.is_approaching = true;
  course.remaining = 0.0;
  SoilState lower = sheared;
  lower.stress *= 0.9;
  for (const AxisOrder& axis : course.order(lower, 1.0))
    CHECK(axis.stress == Approx(-sheared.p()));
}

TEST_CASE("A leg that cannot reach its goal by its kind is refused", "[unit][dem]")
{
  CHECK_THROWS_AS(leg(PathKind::isotropic, Quantity::q, 1e6), mergel::InputError);
  CHECK_THROWS_AS(leg(PathKind::triaxial, Quantity::lateral_stress, 1e6),
                  mergel::InputError);
  CHECK_THROWS_AS(leg(PathKind::tension, Quantity::axial_strain, 0.01), mergel::InputError);
  CHECK_THROWS_AS(leg(PathKind::compression, Quantity::axial_strain, -0.01),
                  mergel::InputError);
  CHECK_THROWS_AS(leg(PathKind::tension, Quantity::axial_stress, 1e6), mergel::InputError);
  const Leg iso = leg(PathKind::isotropic, Quantity::p, 1e6);
  CHECK_THROWS_AS(leg(PathKind::resume, Quantity::q, 1e6).check_after(iso),
                  mergel::InputError);
  CHECK_NOTHROW(leg(PathKind::resume, Quantity::p, 1e6).check_after(iso));
}
