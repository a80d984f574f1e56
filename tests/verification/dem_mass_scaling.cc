// dem/README.md, Mass scaling: the step that it gains, and what it leaves as it was.
#include "dem/assembly/block_bound.h"
#include "dem/assembly/mass_scaling.h"
#include "dem/assembly/timestep.h"
#include "dem/io/state/assembly_state.h"
#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 1e-3;

/// A column of touching bonded particles of these radii that hangs from a wall at z = 0.
Assembly hanging_column(const std::vector<double>& radii)
{
  Scene s;
  s.material.bond = unbreakable_bond();
  std::vector<Pair> pairs;
  double z = 0.0;
  for (Index k = 0; k < radii.size(); ++k) {
    const double r = radii[k];
    s.p.add(sphere({0, 0, z - r}, r));
    z -= 2.0 * r;
    if (k > 0) pairs.push_back({k - 1, k, {}});
  }
  s.bond(pairs);
  s.motion.gravity = {0.0, 0.0, -9.81};
  s.motion.damping = 0.7;
  Assembly a = assembly_of(s);
  const double L = 0.1; // [m]
  a.walls.push_back(make_wall({{-L, -L, 0}, {0, 2.0 * L, 0}, {L, -L, 0}}, {{0, 1, 2}},
                              a.material.contact));
  bond_to_wall(a.walls.front(), a.particles, 1e-6);
  REQUIRE(a.walls.front().bonds.size() == 1);
  add_forces(a, 0.0);
  return a;
}

/// The fourth particle is small, and rules the step.
Assembly hanging_column()
{
  return hanging_column({R, R, R, 0.6 * R, R, R, R, R});
}

double largest_bound(const Assembly& a)
{
  return block_bound(a, linear_springs(a, {})).omega2;
}

std::string refusal(Assembly a, const MassScalingSpec& spec)
{
  try {
    scale_masses(a, spec);
  } catch (const mergel::InputError& e) {
    return e.what();
  }
  return "none";
}

} // namespace

TEST_CASE("Mass scaling lengthens the step of the block bound by the wanted gain, to "
          "round-off",
          "[verification][dem]")
{
  for (const double gain : {1.05, 1.26}) {
    Assembly a = hanging_column();
    const Particles before = a.particles;
    StableStep step;
    const StepSpec spec{StepRule::block_bound, 1.0};
    find_stable_step(step, a, spec, 0.0, 0.0);
    const double limit = step.limit, bound = largest_bound(a);
    scale_masses(a, {gain, 1.0});
    find_stable_step(step, a, spec, 0.0, 0.0);
    CHECK(step.limit == Approx(gain * limit).epsilon(1e-13));
    CHECK(largest_bound(a) == Approx(bound / (gain * gain)).epsilon(1e-13));
    // Mass and moment of inertia by the same factor, of the stiffest particles alone.
    std::size_t n_scaled = 0;
    for (Index i = 0; i < a.particles.size(); ++i) {
      const double factor = a.particles.state[i].m / before.state[i].m;
      CHECK(factor == Approx(a.particles.mass_factor[i]).epsilon(1e-15));
      CHECK(true_mass(a.particles, i) == Approx(before.state[i].m).epsilon(1e-15));
      CHECK(factor >= 1.0);
      n_scaled += factor > 1.0;
    }
    CHECK(a.particles.mass_factor[3] > 1.0);
    CHECK(n_scaled < a.particles.size());
    const ScaledZone all = sum_of(scaled_zones(a.particles));
    CHECK(all.n == a.particles.size());
    CHECK(all.n_scaled == n_scaled);
  }
}

TEST_CASE(
    "A scaled particle has its weight and more inertia: it falls at g over its factor",
    "[verification][dem]")
{
  Assembly a = hanging_column();
  scale_masses(a, {1.26, 1.0});
  Particles p = a.particles;
  clear_loads(p);
  KickWork work;
  Motion motion;
  motion.damping = 0.0;
  motion.gravity = {0.0, 0.0, -9.81};
  const double dt = 1e-6;
  kick(p, motion, dt, work);
  double by_gravity = 0.0;
  for (Index i = 0; i < p.size(); ++i) {
    const double f = -true_mass(p, i) * 9.81;
    CHECK(p.state[i].m * p.state[i].v.z() / dt == Approx(f).epsilon(1e-14));
    CHECK(p.state[i].v.z() == Approx(-9.81 * dt / p.mass_factor[i]).epsilon(1e-14));
    by_gravity += 0.5 * p.state[i].m * p.state[i].v.squaredNorm();
  }
  // Work of the weight = kinetic energy of the scaled masses, to the quantum of the sums.
  CHECK(work.gravity.value() == Approx(by_gravity).margin(8 * 0x1p-61));
}

TEST_CASE("A hanging column stretches by its weight over its stiffness, scaled or not",
          "[verification][dem]")
{
  // Bond b carries the weight below it: u = sum over the bonds of weight/k_n.
  const auto stretch = [](double gain, double omega2 = 0.0) {
    Assembly a = hanging_column();
    if (gain > 1.0) scale_masses(a, {gain, 1.0});
    if (omega2 > 0.0) equalise_frequencies(a, linear_springs(a, {}), omega2);
    const double z_0 = a.particles.state.back().x.z();
    const double dt = stable_time_step(a, StepSpec{});
    for (int k = 0; k < 20000; ++k) advance(a, dt, dt, [](double) {});
    return z_0 - a.particles.state.back().x.z();
  };
  const Assembly a = hanging_column();
  const BondSection& bond = section(a.material.bond);
  double weight = 0.0, u = 0.0;
  for (Index i = static_cast<Index>(a.particles.size()); i-- > 0;) {
    const ParticleState& b = a.particles.state[i];
    weight += 9.81 * b.m;
    if (i == 0) {
      u += weight / bond_shape(bond, b.R, 1.0 / b.R).k_n; // to the wall
    } else {
      const double above = a.particles.state[i - 1].R;
      u += weight / bond_shape(bond, std::min(b.R, above), 1.0 / (b.R + above)).k_n;
    }
  }
  // Round-off of the positions, 2e-18 m, in a stretch of some 1e-9 m.
  CHECK(stretch(1.0) == Approx(u).epsilon(1e-7));
  CHECK(stretch(1.26) == Approx(u).epsilon(1e-7));
  CHECK(stretch(1.0, 1e12) == Approx(u).epsilon(1e-7));
}

TEST_CASE(
    "With equalised frequencies a graded column comes to rest in a third of the steps, "
    "and gets its true masses back",
    "[verification][dem]")
{
  // Radii from 1 mm at the top to 0.03 mm: true masses differ by a factor of 40,000.
  std::vector<double> radii;
  for (int k = 0; k < 20; ++k) radii.push_back(R * std::pow(0.03, k / 19.0));
  const Assembly column = hanging_column(radii);

  const auto steps_to_rest = [](Assembly& a) {
    double dt = stable_time_step(a, StepSpec{});
    int n = 0;
    for (; n < 20000 && (n % 50 != 0 || n == 0 || unbalanced_ratio(a) > 1e-5); ++n)
      advance(a, dt, dt, [](double) {});
    return n;
  };
  Assembly usual = column, equal = column;
  const double omega2 = largest_bound(column);
  equalise_frequencies(equal, linear_springs(equal, {}), omega2);
  for (const double bound : block_bounds(equal, linear_springs(equal, {})))
    CHECK(bound == Approx(omega2).epsilon(1e-12));

  const int n_usual = steps_to_rest(usual), n_equal = steps_to_rest(equal);
  CAPTURE(n_usual, n_equal);
  REQUIRE(n_usual < 20000);
  CHECK(3 * n_equal < n_usual);
  const auto tip = [](const Assembly& a) { return a.particles.state.back().x.z(); };
  // Both are off by 1e-5 or so of the load that is not balanced.
  CHECK(tip(equal) - tip(column) == Approx(tip(usual) - tip(column)).epsilon(1e-3));

  restore_masses(equal);
  CHECK(equal.particles.mass_factor.empty());
  for (Index i = 0; i < equal.particles.size(); ++i) {
    CHECK(equal.particles.state[i].m == Approx(column.particles.state[i].m).epsilon(1e-15));
    CHECK(equal.particles.state[i].v == Vec3::Zero());
    CHECK(equal.particles.state[i].omega == Vec3::Zero());
  }
}

TEST_CASE("Mass scaling above the limit of a zone is refused with zone, share and remedy",
          "[verification][dem]")
{
  using mergel::match::Contains;
  Assembly a = hanging_column();
  const std::string uniform = refusal(a, {1.26, 0.01});
  CHECK_THAT(uniform, Contains("Motion/mass scaling = 1.26") && Contains("1.8 %") &&
                          Contains("S = 1") && Contains("at most 1 %") &&
                          Contains("lower it") &&
                          Contains("raise `Motion/mass scaling limit`"));
  // The small particle is alone in its zone, and gains more than 5 % of itself.
  for (Index i = 0; i < a.particles.size(); ++i)
    a.particles.state[i].S = i == 3 ? 1.0 : 5.0;
  CHECK_THAT(refusal(a, {1.26, 0.05}), Contains("S = 1:"));
  CHECK(refusal(a, {1.0, 0.0}) == "none"); // off
}

TEST_CASE("The true mass of a scaled particle survives a checkpoint", "[verification][dem]")
{
  Assembly a = hanging_column();
  scale_masses(a, {1.26, 1.0});
  State state(0);
  save(state, a);
  Assembly other = hanging_column();
  load(state, other);
  CHECK(other.particles.mass_factor == a.particles.mass_factor);
  for (Index i = 0; i < a.particles.size(); ++i)
    CHECK(other.particles.state[i].m == a.particles.state[i].m);
  rebuild_lists(other);
  CHECK(stable_time_step(other, {}) == stable_time_step(a, {}));
  // Without mass scaling there are no factors, and an older file has none.
  State plain(0);
  save(plain, hanging_column());
  load(plain, other);
  CHECK(other.particles.mass_factor.empty());
}
