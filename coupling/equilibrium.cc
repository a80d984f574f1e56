#include "coupling/equilibrium.h"

#include "dem/assembly/overlaps.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mergel::coupling {

namespace {

std::string shown(double ratio)
{
  char text[48];
  std::snprintf(text, sizeof text, "unbalanced-force ratio %.1e", ratio);
  return text;
}

/// Another reason for a failure, where it may be one.
std::string hint_of(const dem::StepSpec& step)
{
  if (step.safety <= 1.0) return "";
  return "; or the time step, " + dem::shortest(step.safety) +
         " of the stable one, is too large: lower `Motion/time step safety`";
}

/// One phase of settling and who hears of it.
struct Phase {
  const char* name;
  const EquilibriumSpec& spec;
  const EquilibriumReport& report;
  const std::function<void()>& after_step;
};

void set_smooth(CoupledSystem& coupled, bool is_smooth)
{
  for (const CoupledSystem::Member& s : coupled.structures)
    coupled.wall_of(s).is_smooth = is_smooth;
}

void slide_along_smooth_walls(CoupledSystem& coupled, double dt)
{
  for (dem::Wall& wall : coupled.assembly.walls)
    if (wall.is_smooth) dem::slide_anchors(wall, coupled.assembly.particles, dt);
}

/// Step until the unbalanced-force ratio is below that of the spec.
void relax(CoupledSystem& coupled, const Phase& phase)
{
  const auto after_step = [&] {
    if (phase.after_step) phase.after_step();
  };
  if (phase.report.begin) phase.report.begin(phase.name);
  const double ratio = phase.spec.ratio;
  double now = coupled.unbalanced(), first = now;
  std::size_t& n = coupled.settling.n;
  while (n < phase.spec.max_steps) {
    coupled.step([&](double dt) { slide_along_smooth_walls(coupled, dt); });
    ++n;
    if (n % 50 != 0) {
      after_step();
      continue;
    }
    dem::check_overlaps(coupled.assembly);
    now = coupled.unbalanced();
    first = std::max(first, now);
    if (coupled.assembly.comm.global_sum(coupled.assembly.losses.broken) > 0)
      throw Unstable("a bond broke before equilibrium (" + shown(now) +
                     "): the specimen is too weak for its own weight and the surcharge, or "
                     "was made under pressure" +
                     hint_of(coupled.step_spec));
    if (now < ratio) {
      if (phase.report.done)
        phase.report.done(shown(now) + ", " + std::to_string(n) + " steps");
      return;
    }
    const double part = std::log(first / now) / std::log(first / ratio);
    if (phase.report.update) phase.report.update(std::clamp(part, 0.0, 1.0), shown(now));
    after_step();
  }
  throw Unstable(std::string(phase.name) + ": no equilibrium in " +
                 std::to_string(phase.spec.max_steps) + " steps: " + shown(now) +
                 ", required " + dem::shortest(ratio) +
                 "; raise `Motion/damping` or `Motion/unbalanced-force tolerance`" +
                 hint_of(coupled.step_spec));
}

/// Displacement of wall nodes, of all walls one after the other.
struct WallMotion {
  Nodal x; ///< before it [m]
  Nodal u; ///< [m]; zero where a structure has no static solution
  bool is_any = false;
};

/// Put the structures in static equilibrium under the wall forces; their walls follow.
WallMotion settle_structures(CoupledSystem& coupled)
{
  WallMotion motion;
  for (CoupledSystem::Member& s : coupled.structures) {
    dem::Wall& wall = coupled.wall_of(s);
    motion.x.insert(motion.x.end(), wall.x.begin(), wall.x.end());
    std::optional<Nodal> u;
    if (coupled.moves(s)) u = s.exchange.settle(wall);
    motion.is_any |= u.has_value();
    if (!u) u = Nodal(wall.x.size(), dem::Vec3::Zero());
    // The motion over one step, so that every history is updated.
    for (std::size_t k = 0; k < u->size(); ++k) wall.v[k] = (*u)[k] / coupled.dt;
    motion.u.insert(motion.u.end(), u->begin(), u->end());
  }
  return motion;
}

/// The particles follow the walls by interpolation, in one step that is at rest before and
/// after.
void follow_walls(CoupledSystem& coupled, const WallMotion& motion)
{
  const double dt = coupled.dt;
  dem::Particles& p = coupled.assembly.particles;
  p.for_owned([&](dem::Index i) {
    dem::ParticleState& b = p.state[i];
    const dem::Vec3 moved = interpolate_inside(motion.x, motion.u, b.x);
    b.x += moved;
    b.v = moved / dt;
    b.omega.setZero();
  });
  coupled.assembly.list.invalidate();
  dem::add_forces(coupled.assembly, dt);
  // Those of other ranks too: ghosts keep what they have until the next step.
  for (dem::ParticleState& b : p.state) b.v.setZero();
  for (dem::Wall& wall : coupled.assembly.walls)
    for (dem::Vec3& v : wall.v) v.setZero();
}

bool has_moving_structure(const CoupledSystem& coupled)
{
  return std::any_of(coupled.structures.begin(), coupled.structures.end(),
                     [&](const auto& s) { return coupled.moves(s); });
}

} // namespace

void equilibrate(CoupledSystem& coupled, const EquilibriumSpec& spec,
                 const EquilibriumReport& report, const std::function<void()>& after_step)
{
  Settling& settling = coupled.settling;
  if (settling.phase == Settling::Phase::held) {
    coupled.are_structures_held = true;
    set_smooth(coupled, coupled.is_smooth_while_held);
    if (settling.n == 0) coupled.equalise_frequencies();
    relax(coupled, {"settling in held walls", spec, report, after_step});
    coupled.are_structures_held = false;
    set_smooth(coupled, false);
    const WallMotion motion = settle_structures(coupled);
    if (motion.is_any) follow_walls(coupled, motion);
    coupled.equalise_frequencies();
    settling = {Settling::Phase::free, 0};
  }
  if (settling.phase == Settling::Phase::free) {
    if (has_moving_structure(coupled))
      relax(coupled, {"settling in free walls", spec, report, after_step});
    settling = {Settling::Phase::done, 0};
    coupled.restore_masses();
    dem::Assembly& assembly = coupled.assembly;
    assembly.partition.gather_motion(assembly.particles, assembly.comm);
    for (const dem::ParticleState& b : assembly.particles.state) coupled.x_0.push_back(b.x);
  }
}

} // namespace mergel::coupling
