// dem/README.md, Time step: the largest stable step of one and two particles against closed
// forms, and against runs.
#include "dem/assembly/step.h"
#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 0.03;

/// What the two particles do in the mode that rules the step.
enum class Mode { stretch, shear, bend };

/// Two bonded particles whose step is ruled by this mode, in motion along it.
///
/// With spins theta (the arm is R) and the true I = 2/5 m R^2 times the factor f:
///
///   stretch   u_i = -u_j                    omega^2 = 2 k_n/m
///   shear     u_i = -u_j, theta_i = theta_j omega^2 = 2 k_s (1/m + R^2/I)
///   bend      theta_i = -theta_j            omega^2 = 2 k_b/I
struct TwoParticles {
  Scene s;
  double omega2;

  TwoParticles(Mode mode, double alpha)
  {
    s.material.bond = unbreakable_bond();
    BondSection& b = section(s.material.bond);
    b.lambda_b = 1.0;
    b.kappa = mode == Mode::shear ? 1.0 : 20.0;
    s.motion.damping = alpha;
    s.motion.inertia_factor = mode == Mode::bend ? 0.1 : 1.0;
    s.p.add(sphere({-R, 0, 0}, R));
    s.p.add(sphere({R, 0, 0}, R));
    s.bond({{0, 1}});
    ParticleState &i = s.p.state[0], &j = s.p.state[1];
    const double m = i.m, I_p = inertia(i, s.motion), v = 1e-6;
    const auto k = bond_shape(b, R, 0.5 / R);
    if (mode == Mode::stretch) {
      i.v.x() = -v;
      j.v.x() = v;
      omega2 = 2.0 * k.k_n / m;
    } else if (mode == Mode::bend) {
      i.omega.z() = -v / R;
      j.omega.z() = v / R;
      omega2 = 2.0 * k.k_b / I_p;
    } else {
      i.v.y() = -v;
      j.v.y() = v;
      i.omega.z() = j.omega.z() = -v * m * R / I_p; // of the mode
      omega2 = 2.0 * k.k_s * (1.0 / m + R * R / I_p);
    }
  }
};

double speed2(const Particles& p)
{
  double sum = 0.0;
  for (const ParticleState& b : p.state)
    sum += b.v.squaredNorm() + b.R * b.R * b.omega.squaredNorm();
  return sum;
}

/// True if the motion stays bounded over 4,000 steps: 0.1 % above the limit undamped
/// motions grow by exp(0.06) a step.
template <class Step>
bool stays_bounded(const Particles& p, Step&& step)
{
  const double before = speed2(p);
  for (int k = 0; k < 4000; ++k) {
    try {
      step();
    } catch (const mergel::NumericalError&) {
      return false;
    }
    if (speed2(p) > 1e6 * before) return false;
  }
  return true;
}

bool is_stable(Scene s, double dt)
{
  return stays_bounded(s.p, [&] { s.step(dt); });
}

bool is_stable(Assembly a, double dt)
{
  add_forces(a, 0.0);
  return stays_bounded(a.particles, [&] { advance(a, dt, dt, [](double) {}); });
}

/// Squared largest frequency [1/s^2].
double omega2_of(Assembly a)
{
  StableStep step;
  find_stable_step(step, a, {}, 0.0, 0.0);
  return step.omega2;
}

/// A particle that touches what is at y = 0.
Assembly particle_beside(double kappa, double g_a)
{
  Assembly a;
  a.particles.add(sphere({0.0, R, 0.0}, R));
  a.material = {unbreakable_bond(), contact(1e8, kappa, 0.5, g_a)};
  a.motion.damping = 0.0;
  a.list = VerletList(g_a, 0.1 * R);
  return a;
}

} // namespace

TEST_CASE("The step at safety 1 is the largest stable one of two bonded particles that "
          "stretch, shear or bend, at any damping",
          "[verification][dem]")
{
  for (const Mode mode : {Mode::stretch, Mode::shear, Mode::bend})
    for (const double alpha : {0.0, 0.2, 0.5, 0.7, 0.9}) {
      const TwoParticles two(mode, alpha);
      const double closed = 2.0 / std::sqrt(two.omega2 * (1.0 + alpha));
      const double dt = stable_time_step(two.s, 1.0);
      CAPTURE(static_cast<int>(mode), alpha, dt / closed);
      // The iteration ends when it rises by less than 1e-4, from below.
      CHECK(dt == Approx(closed).epsilon(1e-4));
      CHECK(is_stable(two.s, 0.999 * closed));
      CHECK_FALSE(is_stable(two.s, 1.002 * closed));
    }
}

TEST_CASE("The inertia factor lengthens the step where rotation rules it, and only there",
          "[verification][dem]")
{
  const auto step = [](Mode mode, double factor) {
    TwoParticles two(mode, 0.0);
    two.s.motion.inertia_factor *= factor;
    return stable_time_step(two.s, 1.0);
  };
  // Shear: 1/m + R^2/I from 3.5/m to 2.25/m. Closed forms to the 1e-4 of the iteration.
  CHECK(step(Mode::stretch, 2.0) / step(Mode::stretch, 1.0) == Approx(1.0).epsilon(1e-4));
  CHECK(step(Mode::shear, 2.0) / step(Mode::shear, 1.0) ==
        Approx(std::sqrt(3.5 / 2.25)).epsilon(1e-4));
  CHECK(step(Mode::bend, 2.0) / step(Mode::bend, 1.0) ==
        Approx(std::sqrt(2.0)).epsilon(1e-4));
}

TEST_CASE(
    "The step of a particle held by a wall is that of its stiffness there, if it spins "
    "or not",
    "[verification][dem]")
{
  // Against a wall k_n = E pi R and k_s = k_n/kappa; free to spin, the arm R + gap lowers
  // what resists the shear: 1/m + arm^2/I.
  for (const bool is_plane : {true, false})
    for (const double kappa : {1.0, 2.0, 8.0})
      for (const bool spins : {false, true}) {
        const double gap = 1e-3;
        Assembly a = particle_beside(kappa, 2.0 * gap);
        a.motion.free_rotation = spins;
        a.particles.state[0].x.y() = R + gap;
        const ContactLaw law = a.material.contact;
        if (is_plane)
          a.rigid_walls.push_back(make_rigid_wall(Plane{Vec3::UnitY()}, Vec3::Zero(), law));
        else
          a.walls.push_back(
              make_wall({{-1, 0, -1}, {0, 0, 2}, {1, 0, -1}}, {{0, 1, 2}}, law));
        const ParticleState& b = a.particles.state[0];
        const double k_n = 1e8 * pi * R, k_s = k_n / kappa, arm = R + gap;
        const double shear = k_s * (1.0 / b.m + (spins ? arm * arm / b.inertia() : 0.0));
        CAPTURE(is_plane, kappa, spins);
        const double omega2 = omega2_of(a);
        CHECK(omega2 == Approx(std::max(k_n / b.m, shear)).epsilon(1e-4));
        // A spring to a held wall counts half in the bound, which is then the frequency
        // itself; where the triangulated wall moves, the bound is on the safe side.
        rebuild_lists(a);
        const double held = block_bound(a, linear_springs(a, {})).omega2;
        const double moved = block_bound(a, linear_springs(a, {0.0, true})).omega2;
        CHECK(held == Approx(omega2).epsilon(1e-4));
        CHECK(moved == Approx((is_plane ? 1.0 : 2.0) * held).epsilon(1e-12));
      }
}

TEST_CASE(
    "A particle bonded to its mirror image or pressed on it vibrates at 2 k/m, and its "
    "run is stable up to that step",
    "[verification][dem]")
{
  // The image moves against the particle, so that the gap changes twice as fast.
  for (const bool is_bonded : {true, false}) {
    const double g_a = 1e-3;
    Assembly a = particle_beside(2.0, g_a);
    if (is_bonded) a.material.contact = no_contact();
    a.mirrors.emplace_back();
    if (is_bonded) bond_to_mirror(a.mirrors.front(), a.particles, 1e-6);
    ParticleState& b = a.particles.state[0];
    if (!is_bonded) { // oscillates about an overlap, under a load that balances it
      b.x.y() = R + 0.25e-3;
      const double k = contact_stiffness(a.material.contact, sides_at_mirror(R), 1e-3).k_n;
      a.motion.gravity = {0.0, -k * 0.5e-3 / b.m, 0.0};
    }
    b.v.y() = 1e-6;
    const double k =
        is_bonded ? bond_shape(section(a.material.bond), R, 0.5 / R).k_n
                  : contact_stiffness(a.material.contact, sides_at_mirror(R), 1e-3).k_n;
    const double omega2 = 2.0 * k / b.m;
    CAPTURE(is_bonded);
    CHECK(omega2_of(a) == Approx(omega2).epsilon(1e-12)); // one degree of freedom acts
    CHECK(is_stable(a, 0.999 * 2.0 / std::sqrt(omega2)));
    CHECK_FALSE(is_stable(a, 1.001 * 2.0 / std::sqrt(omega2)));
  }
}
