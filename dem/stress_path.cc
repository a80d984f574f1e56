#include "dem/stress_path.h"

#include "dem/error.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

SoilState soil_state(const Vec3& stress, const Vec3& size, const Vec3& size_0)
{
  const Vec3 strain = Vec3::Ones() - size.cwiseQuotient(size_0);
  SoilState s;
  s.axial = -stress.z();
  s.lateral = -0.5 * (stress.x() + stress.y());
  s.axial_strain = strain.z();
  s.lateral_strain = 0.5 * (strain.x() + strain.y());
  s.volumetric_strain = 1.0 - size.prod() / size_0.prod();
  return s;
}

double value_of(Quantity quantity, const SoilState& s)
{
  switch (quantity) {
  case Quantity::p:
    return s.p();
  case Quantity::q:
    return s.q();
  case Quantity::axial_stress:
    return s.axial;
  case Quantity::lateral_stress:
    return s.lateral;
  case Quantity::axial_strain:
    return s.axial_strain;
  case Quantity::volumetric_strain:
    return s.volumetric_strain;
  case Quantity::driven_stress:
    break;
  }
  return s.axial;
}

bool is_strain(Quantity quantity)
{
  return quantity == Quantity::axial_strain || quantity == Quantity::volumetric_strain;
}

namespace {

/// The line of a leg: which stress is driven, and held = at_zero + slope * driven.
struct Line {
  Course::Drive drive;
  double at_zero, slope;
};

/// From dq = k dp with q = a - l and p = (a + 2 l)/3: da (1 - k/3) = dl (1 + 2 k/3). The
/// steeper of both is driven.
Line radial_line(double k, const SoilState& now)
{
  const bool is_constant_p = std::isinf(k);
  const double of_a = is_constant_p ? -1.0 : 3.0 - k,
               of_l = is_constant_p ? 2.0 : 3.0 + 2.0 * k;
  if (std::abs(of_a) <= std::abs(of_l)) { // of_l is not 0: both vanish for no k
    const double slope = of_a / of_l;
    return {Course::Drive::axial, now.lateral - slope * now.axial, slope};
  }
  const double slope = of_l / of_a;
  return {Course::Drive::lateral, now.axial - slope * now.lateral, slope};
}

/// Growth of a stress with the driven one.
double growth(Quantity quantity, Course::Drive drive, Course::Follow follow, double slope)
{
  if (follow == Course::Follow::mean) return quantity == Quantity::q ? 0.0 : 1.0;
  if (follow == Course::Follow::nothing) return 1.0; // all grow with the axial stress
  const bool is_axial = drive == Course::Drive::axial;
  const double a = is_axial ? 1.0 : slope, l = is_axial ? slope : 1.0;
  switch (quantity) {
  case Quantity::p:
    return (a + 2.0 * l) / 3.0;
  case Quantity::q:
    return a - l;
  case Quantity::axial_stress:
    return a;
  case Quantity::lateral_stress:
    return l;
  default:
    return 1.0;
  }
}

Line line_of(const Leg& leg, const SoilState& now)
{
  switch (leg.kind) {
  case PathKind::triaxial:
    return {Course::Drive::axial, leg.has_lateral ? leg.lateral : now.lateral, 0.0};
  case PathKind::radial:
    return radial_line(leg.slope, now);
  default:
    return {Course::Drive::axial, 0.0, 0.0};
  }
}

Course::Follow follow_of(PathKind kind)
{
  if (kind == PathKind::isotropic) return Course::Follow::mean;
  if (kind == PathKind::oedometer) return Course::Follow::nothing;
  return Course::Follow::line;
}

} // namespace

void Leg::check() const
{
  require(std::isfinite(goal), "the goal must be a number");
  if (kind == PathKind::resume) return; // by the leg before: set_out()
  const Line line = line_of(*this, {});
  if (is_strain(quantity)) {
    require(line.drive == Course::Drive::axial || kind == PathKind::isotropic ||
                quantity == Quantity::volumetric_strain,
            "with this dq/dp the lateral strain is driven: end the leg at a stress or a "
            "volumetric strain");
    if (kind == PathKind::tension)
      require(goal < 0.0, "tension is an extension: the strain must be negative");
    if (kind == PathKind::compression)
      require(goal > 0.0, "compression needs a positive strain");
    return;
  }
  require(std::abs(growth(quantity, line.drive, follow_of(kind), line.slope)) > 1e-9,
          "this stress does not change along the leg");
}

double Course::driven(const SoilState& s) const
{
  if (drive == Drive::all) return s.p();
  return drive == Drive::axial ? s.axial : s.lateral;
}

double Course::progress(const SoilState& s) const
{
  const double way = goal - value_at_start;
  const double now =
      quantity == Quantity::driven_stress ? driven(s) : value_of(quantity, s);
  return way != 0.0 ? (now - value_at_start) / way : 1.0;
}

bool Course::has_reached_goal(const SoilState& s) const
{
  return progress(s) >= 1.0;
}

CellOrder Course::order(const SoilState& s, double rate) const
{
  const double extension = -direction * rate;
  CellOrder axes;
  AxisOrder &x = axes[0], &y = axes[1], &z = axes[2];
  if (follow == Follow::mean) {
    x = y = z = {true, -s.p(), extension / std::sqrt(3.0)};
    return axes;
  }
  const double held = -(at_zero + slope * driven(s));
  if (drive == Drive::axial) {
    z = {false, 0.0, extension};
    x = y = follow == Follow::nothing ? AxisOrder{} : AxisOrder{true, held, 0.0};
  } else {
    x = y = {false, 0.0, extension / std::sqrt(2.0)};
    z = {true, held, 0.0};
  }
  return axes;
}

Course set_out(const Leg& leg, const Course& before, const SoilState& now, const Vec3& size)
{
  Course c;
  if (leg.kind == PathKind::resume) {
    c = before;
  } else {
    const Line line = line_of(leg, now);
    c.follow = follow_of(leg.kind);
    c.drive = leg.kind == PathKind::isotropic ? Course::Drive::all : line.drive;
    c.at_zero = line.at_zero;
    c.slope = line.slope;
    c.size_0 = size;
  }
  c.quantity = leg.returns ? Quantity::driven_stress : leg.quantity;
  c.goal = leg.returns ? before.driven_at_start : leg.goal;
  c.driven_at_start = c.driven(now);

  SoilState here = now;
  if (leg.kind != PathKind::resume) // strains count from here
    here.axial_strain = here.lateral_strain = here.volumetric_strain = 0.0;
  c.value_at_start =
      c.quantity == Quantity::driven_stress ? c.driven(here) : value_of(c.quantity, here);
  const double way = c.goal - c.value_at_start;
  const double per_drive = is_strain(c.quantity) || c.quantity == Quantity::driven_stress
                               ? 1.0
                               : growth(c.quantity, c.drive, c.follow, c.slope);
  require(std::abs(per_drive) > 1e-9, "this stress does not change along the leg");
  c.direction = way * per_drive >= 0.0 ? 1.0 : -1.0;
  return c;
}

} // namespace mergel::dem
