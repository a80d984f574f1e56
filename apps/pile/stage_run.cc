#include "apps/pile/stage_run.h"

#include "apps/case/units.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mergel::apps {

namespace {

using coupling::HeadControl;
using Kind = PileStage::Kind;

/// Steps in which a stage must find its equilibrium.
constexpr std::uint64_t most_steps = 200'000;
/// Records of a stage that is short.
constexpr double records_of_short_stage = 50.0;

} // namespace

void StageRun::begin(std::size_t stage)
{
  stage_ = stage;
  time_ = 0.0;
  n_steps_ = 0;
  has_capacity_ = false;
  tip_ = tip_depth();
  force_ = head_.head_force(pile());
  x_ = head_.displacement(pile());
  largest_force_ = std::max(largest_force_, std::abs(force_));
  const PileStage& s = this->stage();
  if (s.is_by_force()) {
    const double F = case_.modelled_share() * s.target;
    if (s.kind == Kind::unload ? F >= force_ : F <= force_)
      throw CollectiveFailure(
          "stage " + std::to_string(stage_ + 1) + ", " + name_of(s) +
          ": the head force is " + dem::shortest(force_ / case_.modelled_share()) +
          " N where it begins, so it would be " +
          (s.kind == Kind::unload ? "a loading" : "an unloading") +
          "; continue with another `Loading/" + key_of_pile_stage(stage_) + "`");
    largest_force_ = std::max(largest_force_, F);
    head_.prescribe_force(pile());
  } else if (s.kind == Kind::push)
    head_.push_at(s.height, pile());
  else if (s.kind != Kind::hold)
    head_.prescribe_velocity(pile());
  choose_rate();
  coupled_.wait_for_equilibrium(s.ends_in_equilibrium());
  require_heavy();
}

void StageRun::resume(std::size_t stage)
{
  stage_ = stage;
  choose_rate();
  coupled_.wait_for_equilibrium(this->stage().ends_in_equilibrium());
}

double StageRun::way() const
{
  return stage().target - x_;
}

void StageRun::choose_rate()
{
  const PileStage& s = stage();
  const double length = s.kind == Kind::pull ? s.target : std::abs(way());
  if (s.kind == Kind::penetrate)
    rate_ =
        PenetrationRate(case_.velocity, 0.05 * case_.diameter, tip_, case_.tip_at_end(s));
  else
    rate_ = PenetrationRate(case_.displacement_rate,
                            std::min(0.05 * case_.diameter, 0.25 * length), 0.0, length);
}

double StageRun::displaced() const
{
  if (stage().kind == Kind::pull) return tip_ - tip_depth();
  return std::copysign(1.0, way()) * (head_.displacement(pile()) - x_);
}

coupling::HeadTarget StageRun::target() const
{
  const PileStage& s = stage();
  coupling::HeadTarget to;
  to.force = force_;
  switch (s.kind) {
  case Kind::penetrate:
    to.v_z = -rate_.velocity(tip_depth());
    break;
  case Kind::pull:
    to.v_z = rate_.velocity(displaced());
    break;
  case Kind::push:
    to.v_x = std::copysign(rate_.velocity(displaced()), way());
    break;
  case Kind::unload:
  case Kind::load:
    to.force += (case_.modelled_share() * s.target - force_) *
                std::min(1.0, time_ / case_.force_ramp);
    break;
  case Kind::hold:
    break;
  }
  return to;
}

void StageRun::step()
{
  coupled_.step([&](double dt) {
    head_.step(coupled_.assembly.rigid_walls.front(), target(),
               0.5 * (coupled_.dt_before + dt), dt);
  });
  time_ += coupled_.dt_before;
  ++n_steps_;
}

/// A pile without a head force that no particle touches would fly on as fast as the rock has
/// thrown it, and nothing would slow it down: it is held there, in an unloading until a
/// particle touches it again.
void StageRun::catch_loose_pile()
{
  if (target().force != 0.0) return;
  const bool is_loose = pile().resultant() == dem::Vec3::Zero();
  if (is_loose && head_.control() == HeadControl::force)
    head_.prescribe_velocity(pile());
  else if (!is_loose && head_.control() == HeadControl::velocity && stage().is_by_force())
    head_.prescribe_force(pile());
}

bool StageRun::is_in_equilibrium()
{
  if (n_steps_ < dem::steps_between_step_checks) return false;
  if (coupled_.n_steps % dem::steps_between_step_checks != 0) return false;
  if (stage().is_by_force() && time_ < case_.force_ramp) return false;
  constexpr double at_rest =
      0.01; // of the penetration rate, as at the end of a penetration
  if (std::abs(pile().v.z()) > at_rest * case_.velocity) return false;
  const double scale = largest_force_ > 0.0 ? largest_force_ : 1.0;
  if (head_.unbalanced(pile(), scale) > case_.balance_tolerance) return false;
  return coupled_.unbalanced() <= case_.balance_tolerance;
}

bool StageRun::is_over()
{
  const PileStage& s = stage();
  largest_force_ = std::max(largest_force_, std::abs(head_.head_force(pile())));
  if (s.kind == Kind::penetrate) return tip_depth() >= rate_.travel();
  if (s.kind == Kind::pull) return displaced() >= s.target;
  if (coupled_.n_steps % dem::steps_between_step_checks == 0) {
    catch_loose_pile();
    require_heavy();
  }
  if (head_.control() != HeadControl::velocity &&
      tip_depth() - tip_ > case_.largest_settlement) {
    has_capacity_ = true;
    head_.prescribe_velocity(pile());
    return true;
  }
  if (s.kind == Kind::push) return displaced() >= std::abs(way());
  if (s.kind == Kind::hold && s.target > 0.0) return time_ >= s.target;
  if (is_in_equilibrium()) return true;
  if (n_steps_ < most_steps) return false;
  throw Unstable("stage " + std::to_string(stage_ + 1) + ", " + name_of(s) +
                 ": no equilibrium in " + std::to_string(most_steps) +
                 " steps: unbalanced-force ratio " + dem::shortest(coupled_.unbalanced()) +
                 "; a restart may raise `Loading/unbalanced-force tolerance`");
}

/// The stable step is that of a pile whose motion is prescribed. One that moves freely must be
/// so slow that it does not count.
void StageRun::require_heavy() const
{
  constexpr double largest = 0.5; // its square is 6 % of that of the limit, 2
  const double omega2 =
      head_.omega2(pile(), coupled_.assembly.particles, coupled_.assembly.comm);
  const double phase = coupled_.dt * std::sqrt(omega2);
  if (phase <= largest) return;
  throw Unstable("stage " + std::to_string(stage_ + 1) + ", " + name_of(stage()) +
                 ": the pile is too light for the time step: " + dem::shortest(phase) +
                 " rad of its own oscillation in a step, at most " +
                 dem::shortest(largest) + "; raise `Pile/mass` " +
                 dem::shortest(std::ceil(phase * phase / (largest * largest))) +
                 " times, from a checkpoint before its first stage under a head force");
}

double StageRun::position() const
{
  switch (stage().kind) {
  case Kind::penetrate:
    return tip_depth();
  case Kind::pull:
  case Kind::push:
    return displaced();
  case Kind::hold:
  case Kind::unload:
  case Kind::load:
    break;
  }
  return time_;
}

double StageRun::record_every() const
{
  switch (stage().kind) {
  case Kind::penetrate:
    return case_.record_every;
  case Kind::pull:
  case Kind::push:
    return std::min(case_.record_every, rate_.travel() / records_of_short_stage);
  case Kind::hold:
  case Kind::unload:
  case Kind::load:
    break;
  }
  return case_.force_ramp / records_of_short_stage;
}

double StageRun::fraction() const
{
  const PileStage& s = stage();
  double done = 0.0;
  if (s.kind == Kind::penetrate || s.kind == Kind::pull || s.kind == Kind::push)
    done = position() / rate_.travel();
  else if (s.kind == Kind::hold && s.target > 0.0)
    done = time_ / s.target;
  else
    done = time_ / (2.0 * case_.force_ramp);
  return std::clamp(done, 0.0, 0.99);
}

std::string StageRun::outcome() const
{
  std::ostringstream out;
  out.precision(4);
  out << "in " << 1e3 * time_ << " ms, " << 1e3 * (tip_depth() - tip_) << " mm deeper";
  if (has_capacity_)
    out << "; the bearing capacity: at `Loading/largest settlement` the particles resisted "
           "with "
        << head_.head_force(pile()) / case_.modelled_share() << " N";
  return out.str();
}

} // namespace mergel::apps
