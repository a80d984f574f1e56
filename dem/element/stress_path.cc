#include "dem/element/stress_path.h"

#include "dem/error.h"

#include <cmath>
#include <string>

namespace mergel::dem {

SoilState soil_state(const Vec3& stress, const Vec3& size, const Vec3& size_0)
{
  return {-stress, Vec3::Ones() - size.cwiseQuotient(size_0)};
}

double value_of(Quantity quantity, const SoilState& s)
{
  switch (quantity) {
  case Quantity::p:
    return s.p();
  case Quantity::q:
    return s.q();
  case Quantity::axial_stress:
    return s.axial();
  case Quantity::lateral_stress:
    return s.lateral();
  case Quantity::x_stress:
    return s.stress.x();
  case Quantity::y_stress:
    return s.stress.y();
  case Quantity::axial_strain:
    return s.axial_strain();
  case Quantity::x_strain:
    return s.strain.x();
  case Quantity::y_strain:
    return s.strain.y();
  case Quantity::volumetric_strain:
    return s.volumetric_strain();
  case Quantity::driven_stress:
    break;
  }
  return s.axial();
}

bool is_strain(Quantity quantity)
{
  return quantity == Quantity::axial_strain || quantity == Quantity::x_strain ||
         quantity == Quantity::y_strain || quantity == Quantity::volumetric_strain;
}

namespace {

/// The way of a leg: which stress is driven, and what the others do.
struct Way {
  Course::Drive drive = Course::Drive::axial;
  Course::Follow follow = Course::Follow::line;
  double at_zero = 0.0, slope = 0.0; ///< held = at_zero + slope * driven
  std::array<AxisRule, 3> rules{};
};

/// From dq = k dp with q = a - l and p = (a + 2 l)/3: da (1 - k/3) = dl (1 + 2 k/3). The
/// steeper of both is driven.
Way radial_way(double k, const SoilState& now)
{
  const bool is_constant_p = std::isinf(k);
  const double of_a = is_constant_p ? -1.0 : 3.0 - k,
               of_l = is_constant_p ? 2.0 : 3.0 + 2.0 * k;
  if (std::abs(of_a) <= std::abs(of_l)) { // of_l is not 0: both vanish for no k
    const double slope = of_a / of_l;
    return {.at_zero = now.lateral() - slope * now.axial(), .slope = slope};
  }
  const double slope = of_l / of_a;
  return {.drive = Course::Drive::lateral,
          .at_zero = now.axial() - slope * now.lateral(),
          .slope = slope};
}

/// By the rules of the axes; the driven one is the first that is.
Way ruled_way(const Leg& leg)
{
  Way w{.follow = Course::Follow::each, .rules = leg.axes};
  const Course::Drive drives[] = {Course::Drive::x, Course::Drive::y, Course::Drive::axial};
  for (int a = 2; a >= 0; --a)
    if (leg.axes[static_cast<std::size_t>(a)].kind == AxisRule::Kind::driven)
      w.drive = drives[a];
  return w;
}

Way way_of(const Leg& leg, const SoilState& now)
{
  switch (leg.kind) {
  case PathKind::isotropic:
    return {.drive = Course::Drive::all, .follow = Course::Follow::mean};
  case PathKind::oedometer:
    return {.follow = Course::Follow::nothing};
  case PathKind::triaxial:
    return {.at_zero = leg.has_lateral ? leg.lateral : now.lateral()};
  case PathKind::radial:
    return radial_way(leg.slope, now);
  case PathKind::axes:
    return ruled_way(leg);
  default:
    return {};
  }
}

/// Index of the one axis that is driven; -1: more than one.
int driven_axis(Course::Drive drive)
{
  switch (drive) {
  case Course::Drive::x:
    return 0;
  case Course::Drive::y:
    return 1;
  case Course::Drive::axial:
    return 2;
  default:
    return -1;
  }
}

/// Growth of a stress with the driven one, by its sign where no line rules it.
double growth(Quantity quantity, const Way& w)
{
  if (w.follow == Course::Follow::mean) return quantity == Quantity::q ? 0.0 : 1.0;
  if (w.follow == Course::Follow::nothing) return 1.0; // all grow with the axial stress
  const bool is_lateral = w.drive == Course::Drive::lateral;
  double x = is_lateral ? 1.0 : w.slope, y = x, z = is_lateral ? w.slope : 1.0;
  if (w.follow == Course::Follow::each) { // what does not hold a stress grows
    const auto of = [&](std::size_t a) {
      return w.rules[a].kind == AxisRule::Kind::held ? 0.0 : 1.0;
    };
    x = of(0);
    y = of(1);
    z = of(2);
    if (quantity == Quantity::q) return driven_axis(w.drive) == 2 ? 1.0 : -1.0;
  }
  switch (quantity) {
  case Quantity::p:
    return (x + y + z) / 3.0;
  case Quantity::q:
    return z - 0.5 * (x + y);
  case Quantity::axial_stress:
    return z;
  case Quantity::lateral_stress:
    return 0.5 * (x + y);
  case Quantity::x_stress:
    return x;
  case Quantity::y_stress:
    return y;
  default:
    return 1.0;
  }
}

void check_rules(const std::array<AxisRule, 3>& rules)
{
  int n_driven = 0;
  for (const AxisRule& rule : rules) n_driven += rule.kind == AxisRule::Kind::driven;
  require(n_driven == 1, "one axis must be driven, and only one");
}

/// Whether a goal of `quantity` can be reached on this way.
void check_goal(Quantity quantity, const Way& w)
{
  if (!is_strain(quantity)) {
    require(std::abs(growth(quantity, w)) > 1e-9,
            "this stress does not change along the leg");
    return;
  }
  if (quantity == Quantity::volumetric_strain) return;
  const int axis = quantity == Quantity::axial_strain ? 2
                   : quantity == Quantity::x_strain   ? 0
                                                      : 1;
  require(w.drive == Course::Drive::all || driven_axis(w.drive) == axis ||
              (w.drive == Course::Drive::lateral && axis != 2),
          "the strain of another axis is driven here: end the leg at that, at a stress or "
          "at a volumetric strain");
}

} // namespace

void Leg::check() const
{
  require(std::isfinite(goal), "the goal must be a number");
  require(kind != PathKind::resume, "there is no leg before to resume");
  if (kind == PathKind::axes) check_rules(axes);
  check_goal(quantity, way_of(*this, {}));
  if (quantity != Quantity::axial_strain && quantity != Quantity::axial_stress) return;
  const char* what = is_strain(quantity) ? " strain" : " stress";
  if (kind == PathKind::tension)
    require(goal < 0.0, std::string("tension is an extension: the") + what +
                            " must be negative, compression being positive");
  if (kind == PathKind::compression)
    require(goal > 0.0, std::string("compression needs a positive") + what);
}

void Leg::check_after(const Leg& resumed) const
{
  require(std::isfinite(goal), "the goal must be a number");
  if (!returns) check_goal(quantity, way_of(resumed, {}));
}

double Course::driven(const SoilState& s) const
{
  if (drive == Drive::all) return s.p();
  return drive == Drive::lateral ? s.lateral() : s.stress[driven_axis(drive)];
}

double Course::driven_strain(const SoilState& s) const
{
  if (drive == Drive::all) return s.volumetric_strain();
  return drive == Drive::lateral ? s.lateral_strain() : s.strain[driven_axis(drive)];
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
  if (progress(s) >= 1.0) return true;
  return returns && direction * (driven_strain(s) - strain_to_return) >= 0.0;
}

CellOrder Course::order(const SoilState& s, double rate) const
{
  const double extension = -direction * rate;
  CellOrder axes;
  AxisOrder &x = axes[0], &y = axes[1], &z = axes[2];
  const double held = at_zero + slope * driven(s);
  switch (follow) {
  case Follow::mean: {
    const double p = is_approaching ? driven_at_start : s.p();
    x = y = z = {true, -p, extension / std::sqrt(3.0)};
    break;
  }
  case Follow::nothing:
    z.rate = extension;
    break;
  case Follow::line:
    if (drive == Drive::axial) {
      z.rate = extension;
      x = y = {true, -held, 0.0};
    } else {
      x.rate = y.rate = extension / std::sqrt(2.0);
      z = {true, -held, 0.0};
    }
    break;
  case Follow::each:
    for (std::size_t a = 0; a < 3; ++a)
      if (rules[a].kind == AxisRule::Kind::held) axes[a] = {true, -rules[a].stress, 0.0};
    axes[static_cast<std::size_t>(driven_axis(drive))].rate = extension;
    break;
  }
  if (!is_approaching) return axes;
  for (std::size_t a = 0; a < 3; ++a) {
    AxisOrder& axis = axes[a];
    if (axis.holds_stress)
      axis = {true, axis.stress - remaining * offset[static_cast<int>(a)], 0.0};
    else if (axis.rate != 0.0) // driven later
      axis = {true, -driven_at_start, 0.0};
  }
  return axes;
}

Course set_out(const Leg& leg, const Course& before, const SoilState& now, const Vec3& size)
{
  Course c;
  if (leg.kind == PathKind::resume) {
    c = before;
  } else {
    const Way w = way_of(leg, now);
    c.drive = w.drive;
    c.follow = w.follow;
    c.at_zero = w.at_zero;
    c.slope = w.slope;
    c.rules = w.rules;
    c.size_0 = size;
  }
  c.quantity = leg.returns ? Quantity::driven_stress : leg.quantity;
  c.goal = leg.returns ? before.driven_at_start : leg.goal;
  c.returns = leg.returns;
  c.strain_to_return = before.strain_at_start;

  SoilState here = now;
  if (leg.kind != PathKind::resume) here.strain.setZero(); // strains count from here
  c.driven_at_start = c.driven(here);
  c.strain_at_start = c.driven_strain(here);
  c.value_at_start = c.quantity == Quantity::driven_stress ? c.driven_at_start
                                                           : value_of(c.quantity, here);
  const double way = c.goal - c.value_at_start;
  const double per_drive =
      is_strain(c.quantity) || c.quantity == Quantity::driven_stress
          ? 1.0
          : growth(c.quantity, {c.drive, c.follow, c.at_zero, c.slope, c.rules});
  require(std::abs(per_drive) > 1e-9, "this stress does not change along the leg");
  c.direction = way * per_drive >= 0.0 ? 1.0 : -1.0;

  c.is_approaching = false;
  c.remaining = 1.0;
  c.offset.setZero();
  const CellOrder order = c.order(here, 0.0);
  for (int a = 0; a < 3; ++a)
    if (order[static_cast<std::size_t>(a)].holds_stress)
      c.offset[a] = here.stress[a] + order[static_cast<std::size_t>(a)].stress;
  return c;
}

} // namespace mergel::dem
