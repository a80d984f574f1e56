#include "dem/element/stress_path.h"

#include "dem/error.h"

#include <cmath>
#include <string>

namespace mergel::dem {

/// Growth of a stress along a path, relative to that of the controlled one, that counts as none.
static constexpr double no_growth = 1e-9;

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
  case Quantity::controlled_stress:
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

/// Path of a stage: which axes are strain-controlled, and what the others do.
struct StagePath {
  ActiveStage::Controlled controlled = ActiveStage::Controlled::axial;
  ActiveStage::Follow follow = ActiveStage::Follow::line;
  double at_zero = 0.0, slope = 0.0; ///< held = at_zero + slope * controlled stress
  std::array<AxisRule, 3> rules{};
};

/// From dq = k dp with q = a - l and p = (a + 2 l)/3: da (1 - k/3) = dl (1 + 2 k/3). The
/// axis whose stress changes more is strain-controlled.
StagePath radial_path(double k, const SoilState& now)
{
  const bool is_constant_p = std::isinf(k);
  const double of_a = is_constant_p ? -1.0 : 3.0 - k,
               of_l = is_constant_p ? 2.0 : 3.0 + 2.0 * k;
  if (std::abs(of_a) <= std::abs(of_l)) { // of_l is not 0: both vanish for no k
    const double slope = of_a / of_l;
    return {.at_zero = now.lateral() - slope * now.axial(), .slope = slope};
  }
  const double slope = of_l / of_a;
  return {.controlled = ActiveStage::Controlled::lateral,
          .at_zero = now.axial() - slope * now.lateral(),
          .slope = slope};
}

/// Path by the rules of the axes; the first strain-controlled axis counts.
StagePath ruled_path(const LoadingStage& stage)
{
  StagePath w{.follow = ActiveStage::Follow::each, .rules = stage.axes};
  const ActiveStage::Controlled axes_of_x_y_z[] = {ActiveStage::Controlled::x,
                                                   ActiveStage::Controlled::y,
                                                   ActiveStage::Controlled::axial};
  for (int a = 2; a >= 0; --a)
    if (stage.axes[static_cast<std::size_t>(a)].kind == AxisRule::Kind::strain_controlled)
      w.controlled = axes_of_x_y_z[a];
  return w;
}

StagePath path_of(const LoadingStage& stage, const SoilState& now)
{
  switch (stage.kind) {
  case PathKind::isotropic:
    return {.controlled = ActiveStage::Controlled::all,
            .follow = ActiveStage::Follow::mean};
  case PathKind::oedometer:
    return {.follow = ActiveStage::Follow::nothing};
  case PathKind::triaxial:
    return {.at_zero = stage.has_lateral ? stage.lateral : now.lateral()};
  case PathKind::radial:
    return radial_path(stage.slope, now);
  case PathKind::axes:
    return ruled_path(stage);
  default:
    return {};
  }
}

/// Index of the only strain-controlled axis; -1 if there are more.
int controlled_axis(ActiveStage::Controlled controlled)
{
  switch (controlled) {
  case ActiveStage::Controlled::x:
    return 0;
  case ActiveStage::Controlled::y:
    return 1;
  case ActiveStage::Controlled::axial:
    return 2;
  default:
    return -1;
  }
}

/// Growth of a stress with the controlled stress; its sign only where the path is no line.
double growth(Quantity quantity, const StagePath& w)
{
  if (w.follow == ActiveStage::Follow::mean) return quantity == Quantity::q ? 0.0 : 1.0;
  if (w.follow == ActiveStage::Follow::nothing)
    return 1.0; // all grow with the axial stress
  const bool is_lateral = w.controlled == ActiveStage::Controlled::lateral;
  double x = is_lateral ? 1.0 : w.slope, y = x, z = is_lateral ? w.slope : 1.0;
  if (w.follow == ActiveStage::Follow::each) { // stresses that are not held grow
    const auto of = [&](std::size_t a) {
      return w.rules[a].kind == AxisRule::Kind::stress_controlled ? 0.0 : 1.0;
    };
    x = of(0);
    y = of(1);
    z = of(2);
    if (quantity == Quantity::q) return controlled_axis(w.controlled) == 2 ? 1.0 : -1.0;
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
  int n_controlled = 0;
  for (const AxisRule& rule : rules)
    n_controlled += rule.kind == AxisRule::Kind::strain_controlled;
  require(n_controlled == 1, "exactly one axis must be strain-controlled");
}

/// @throws InputError when no target of `quantity` can be reached on this path
void check_target(Quantity quantity, const StagePath& w)
{
  if (!is_strain(quantity)) {
    require(std::abs(growth(quantity, w)) > no_growth,
            "this stress does not change along the stage");
    return;
  }
  if (quantity == Quantity::volumetric_strain) return;
  const int axis = quantity == Quantity::axial_strain ? 2
                   : quantity == Quantity::x_strain   ? 0
                                                      : 1;
  require(w.controlled == ActiveStage::Controlled::all ||
              controlled_axis(w.controlled) == axis ||
              (w.controlled == ActiveStage::Controlled::lateral && axis != 2),
          "the strain of another axis is controlled here: end the stage at that strain, at "
          "a stress or at a volumetric strain");
}

} // namespace

void LoadingStage::check() const
{
  require(std::isfinite(target), "the target must be a finite number");
  require(kind != PathKind::resume, "there is no earlier stage to resume");
  if (kind == PathKind::axes) check_rules(axes);
  check_target(quantity, path_of(*this, {}));
  if (quantity != Quantity::axial_strain && quantity != Quantity::axial_stress) return;
  const char* what = is_strain(quantity) ? " strain" : " stress";
  if (kind == PathKind::tension)
    require(target < 0.0, std::string("tension is an extension: the") + what +
                              " must be negative, compression being positive");
  if (kind == PathKind::compression)
    require(target > 0.0, std::string("compression needs a positive") + what);
}

void LoadingStage::check_after(const LoadingStage& resumed) const
{
  require(std::isfinite(target), "the target must be a finite number");
  if (!returns) check_target(quantity, path_of(resumed, {}));
}

double ActiveStage::controlled_stress(const SoilState& s) const
{
  if (controlled == Controlled::all) return s.p();
  return controlled == Controlled::lateral ? s.lateral()
                                           : s.stress[controlled_axis(controlled)];
}

double ActiveStage::controlled_strain(const SoilState& s) const
{
  if (controlled == Controlled::all) return s.volumetric_strain();
  return controlled == Controlled::lateral ? s.lateral_strain()
                                           : s.strain[controlled_axis(controlled)];
}

double ActiveStage::progress(const SoilState& s) const
{
  const double change = target - value_at_start;
  const double now = quantity == Quantity::controlled_stress ? controlled_stress(s)
                                                             : value_of(quantity, s);
  return change != 0.0 ? (now - value_at_start) / change : 1.0;
}

bool ActiveStage::has_reached_target(const SoilState& s) const
{
  if (progress(s) >= 1.0) return true;
  return returns && direction * (controlled_strain(s) - strain_to_return) >= 0.0;
}

CellControl ActiveStage::control(const SoilState& s, double rate) const
{
  const double extension = -direction * rate;
  CellControl axes;
  AxisControl &x = axes[0], &y = axes[1], &z = axes[2];
  const double held = at_zero + slope * controlled_stress(s);
  switch (follow) {
  case Follow::mean: {
    const double p = is_approaching ? controlled_stress_at_start : s.p();
    x = y = z = {true, -p, extension / std::sqrt(3.0)};
    break;
  }
  case Follow::nothing:
    z.rate = extension;
    break;
  case Follow::line:
    if (controlled == Controlled::axial) {
      z.rate = extension;
      x = y = {true, -held, 0.0};
    } else {
      x.rate = y.rate = extension / std::sqrt(2.0);
      z = {true, -held, 0.0};
    }
    break;
  case Follow::each:
    for (std::size_t a = 0; a < 3; ++a)
      if (rules[a].kind == AxisRule::Kind::stress_controlled)
        axes[a] = {true, -rules[a].stress, 0.0};
    axes[static_cast<std::size_t>(controlled_axis(controlled))].rate = extension;
    break;
  }
  if (!is_approaching) return axes;
  double followed = controlled_stress_at_start;
  if (follow == Follow::line) {
    int n_held = 0; // 1 or 2 on a line
    for (const AxisControl& axis : axes) n_held += axis.holds_stress;
    followed -= (1.0 - remaining) * offset.sum() / n_held;
  }
  for (std::size_t a = 0; a < 3; ++a) {
    AxisControl& axis = axes[a];
    if (axis.holds_stress)
      axis = {true, axis.stress - remaining * offset[static_cast<int>(a)], 0.0};
    else if (axis.rate != 0.0) // strain-controlled after the approach
      axis = {true, -followed, 0.0};
  }
  return axes;
}

ActiveStage begin_stage(const LoadingStage& stage, const ActiveStage& before,
                        const SoilState& now, const Vec3& size)
{
  ActiveStage c;
  if (stage.kind == PathKind::resume) {
    c = before;
  } else {
    const StagePath w = path_of(stage, now);
    c.controlled = w.controlled;
    c.follow = w.follow;
    c.at_zero = w.at_zero;
    c.slope = w.slope;
    c.rules = w.rules;
    c.size_0 = size;
  }
  c.quantity = stage.returns ? Quantity::controlled_stress : stage.quantity;
  c.target = stage.returns ? before.controlled_stress_at_start : stage.target;
  c.returns = stage.returns;
  c.strain_to_return = before.strain_at_start;

  SoilState here = now;
  if (stage.kind != PathKind::resume) here.strain.setZero(); // strains count from here
  c.controlled_stress_at_start = c.controlled_stress(here);
  c.strain_at_start = c.controlled_strain(here);
  c.value_at_start = c.quantity == Quantity::controlled_stress
                         ? c.controlled_stress_at_start
                         : value_of(c.quantity, here);
  const double change = c.target - c.value_at_start;
  const double per_controlled =
      is_strain(c.quantity) || c.quantity == Quantity::controlled_stress
          ? 1.0
          : growth(c.quantity, {c.controlled, c.follow, c.at_zero, c.slope, c.rules});
  require(std::abs(per_controlled) > no_growth,
          "this stress does not change along the stage");
  c.direction = change * per_controlled >= 0.0 ? 1.0 : -1.0;

  c.is_approaching = false;
  c.remaining = 1.0;
  c.offset.setZero();
  const CellControl control = c.control(here, 0.0);
  for (int a = 0; a < 3; ++a)
    if (control[static_cast<std::size_t>(a)].holds_stress)
      c.offset[a] = here.stress[a] + control[static_cast<std::size_t>(a)].stress;
  return c;
}

} // namespace mergel::dem
