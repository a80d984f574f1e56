#include "tests/support/catch.h"

#include "coupling/driven_pile.h"

#include <cmath>

using namespace mergel;
using namespace mergel::coupling;
using dem::Vec3;

namespace {

const PileInertia inertia{2e-3, 40e-3, 0.7}; // 2 g, 40 mm

dem::RigidWall pile_at(double z)
{
  dem::RigidWall pile =
      dem::make_rigid_wall(dem::flat_ended(1e-3), Vec3(0.0, 0.0, z), dem::LinearMaterial{});
  pile.reach = 0.1;
  return pile;
}

/// The forces of springs that resist the motion of the pile: k_z [N/m] at its tip, and k_x
/// [N/m] at each of the points of its axis at these heights in the rock.
void spring_forces(dem::RigidWall& pile, double k_z, double z_0, double k_x,
                   const std::vector<double>& heights, double z_tip_0)
{
  for (dem::VectorSum& f : pile.force) f.clear();
  pile.moment.clear();
  pile.force[0].add(Vec3(0.0, 0.0, k_z * (z_0 - pile.x.z())));
  for (const double height : heights) {
    const Vec3 arm = pile.rotation * Vec3(0.0, 0.0, height - z_tip_0);
    const Vec3 f(-k_x * (pile.x + arm).x(), 0.0, 0.0);
    pile.force[1].add(f);
    pile.moment.add(arm.cross(f));
  }
}

} // namespace

TEST_CASE("A pile under a head force settles by F/k, and the work of the head is stored or "
          "damped",
          "[verification][coupling]")
{
  const double k = 1e6, F = 20.0, dt = 1e-6;
  dem::RigidWall pile = pile_at(-5e-3);
  const double z_0 = pile.x.z();
  DrivenPile head(inertia);
  head.prescribe_force(pile);
  for (int n = 0; n < 20000; ++n) {
    spring_forces(pile, k, z_0, 0.0, {}, z_0);
    head.step(pile, {.force = F}, dt, dt);
  }
  const StructureEnergies& e = head.energies();
  const double settlement = z_0 - pile.x.z();
  CHECK(settlement == Approx(F / k).epsilon(1e-6));
  CHECK(e.applied_work == Approx(F * settlement).epsilon(1e-6));
  CHECK(-e.wall_work == Approx(0.5 * k * settlement * settlement).epsilon(1e-6));
  CHECK(std::abs(e.net()) < 1e-12 * e.applied_work); // an identity of the leapfrog
  CHECK(head.head_force(pile) == F);
  spring_forces(pile, k, z_0, 0.0, {}, z_0);
  CHECK(head.unbalanced(pile, F) < 1e-6);
}

TEST_CASE("Without damping a pile on a spring has the period of its mass",
          "[verification][coupling]")
{
  const double k = 1e6, F = 20.0, dt = 1e-7;
  dem::RigidWall pile = pile_at(-5e-3);
  const double z_0 = pile.x.z();
  DrivenPile head({inertia.mass, inertia.length, 0.0});
  head.prescribe_force(pile);
  // From rest under a sudden force it is back where it began after one period.
  const double period = 2.0 * dem::pi * std::sqrt(inertia.mass / k);
  const int n_period = static_cast<int>(std::lround(period / dt));
  double deepest = 0.0;
  for (int n = 0; n < n_period; ++n) {
    spring_forces(pile, k, z_0, 0.0, {}, z_0);
    head.step(pile, {.force = F}, dt, dt);
    deepest = std::max(deepest, z_0 - pile.x.z());
  }
  CHECK(deepest == Approx(2.0 * F / k).epsilon(1e-4));
  CHECK(std::abs(z_0 - pile.x.z()) <
        1e-4 * deepest); // (omega dt)^2, and a step of the start
}

// A rigid pile in a Winkler medium of constant stiffness: with s measured downwards from the
// pushed point, the moment of k (u - theta s) about it vanishes for theta = u <s>/<s^2>.
TEST_CASE("A pushed pile turns until the moment about the pushed point vanishes",
          "[verification][coupling]")
{
  const double h = 2e-3, depth = 10e-3, k_z = 1e6, k_x = 1e5, u = 10e-6, dt = 1e-6;
  dem::RigidWall pile = pile_at(-depth);
  DrivenPile head(inertia);
  head.push_at(h, pile);
  std::vector<double> heights;
  double s1 = 0.0, s2 = 0.0;
  const int n_springs = 20;
  for (int k = 0; k < n_springs; ++k) {
    heights.push_back(-depth * (k + 0.5) / n_springs);
    const double s = h - heights.back();
    s1 += s;
    s2 += s * s;
  }
  const int n_push = 2000;
  for (int n = 0; n < 60000; ++n) {
    spring_forces(pile, k_z, -depth, k_x, heights, -depth);
    head.step(pile, {.v_x = n < n_push ? u / (n_push * dt) : 0.0}, dt, dt);
  }
  const double theta = u * s1 / s2; // the head leans towards x
  // Springs stay horizontal and arms shorten by 1 - cos theta: 1e-6 relative.
  CHECK(head.displacement(pile) == Approx(u).epsilon(1e-9));
  CHECK(head.rotation() == Approx(theta).epsilon(1e-4));
  spring_forces(pile, k_z, -depth, k_x, heights, -depth);
  double lateral = 0.0;
  for (const double height : heights) lateral += k_x * (u - theta * (h - height));
  CHECK(head.lateral_force(pile) == Approx(lateral).epsilon(1e-3));
  const StructureEnergies& e = head.energies();
  // The mean of the velocities around a kick is not the motion between two kicks of an arm
  // that turns: (omega dt)^2.
  CHECK(std::abs(e.net()) < 1e-9 * e.applied_work);
  CHECK(e.applied_work > 0.5 * lateral * u); // stored, and damped on the way
}

TEST_CASE(
    "A head that takes over a moving pile gives it its kinetic energy, and takes it back",
    "[verification][coupling]")
{
  dem::RigidWall pile = pile_at(-5e-3);
  DrivenPile head(inertia);
  const double v = 0.5, dt = 1e-6;
  head.step(pile, {.v_z = -v}, dt, dt);
  CHECK(head.energies().kinetic == 0.0);
  head.prescribe_force(pile);
  CHECK(head.energies().kinetic == Approx(0.5 * inertia.mass * v * v));
  CHECK(head.energies().net() == 0.0);
  head.prescribe_velocity(pile);
  CHECK(head.energies().kinetic == 0.0);
  CHECK(head.energies().net() == 0.0);
}
