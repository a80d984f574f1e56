/// Symmetries of one bond that yields, is damaged and has a sliding contact beside it: ends
/// swapped, mirrored, rotated, shifted, and in any lane of the kernel.
#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double dt = 1e-4;
constexpr int n_steps = 600;

/// Positions of both ends at every step, and the velocities and spins that lead there.
struct Script {
  double R[2];
  std::vector<Vec3> x[2], v[2], omega[2];
};

/// Rounds to a grid of 2^-44 m, so that a shift by some metres is exact.
Vec3 on_grid(const Vec3& x)
{
  return (x * 0x1p44).array().round().matrix() * 0x1p-44;
}

/// Random stretching, shearing and bending past yield, with a rotation of the whole pair.
Script script(int seed, double R_i, double R_j)
{
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  Script s;
  s.R[0] = R_i;
  s.R[1] = R_j;
  const Vec3 spin = 1e-3 * random_vector(random); // per step: 0.6 rad in all
  Vec3 way_x[2], way_turn[2];
  Vec3 x[2] = {Vec3(0.01, -0.02, 0.03),
               Vec3(0.01, -0.02, 0.03) + (R_i + R_j) / 3.0 * Vec3(1, 2, 2)};
  for (int e = 0; e < 2; ++e) s.x[e].push_back(on_grid(x[e]));
  for (int k = 0; k < n_steps; ++k) {
    if (k % 60 == 0)
      for (int e = 0; e < 2; ++e) {
        way_x[e] = 2.2e-6 * random_vector(random);
        way_turn[e] = 8e-5 * random_vector(random);
      }
    const Vec3 centre = 0.5 * (s.x[0].back() + s.x[1].back());
    const Mat3 Q = Eigen::AngleAxisd(spin.norm(), spin.normalized()).toRotationMatrix();
    for (int e = 0; e < 2; ++e) {
      const Vec3 to = on_grid(centre + Q * (s.x[e].back() - centre) + way_x[e]);
      s.v[e].push_back((to - s.x[e].back()) / dt);
      s.omega[e].push_back((spin + way_turn[e]) / dt);
      s.x[e].push_back(to);
    }
  }
  return s;
}

/// Transformed scene: x' = A x + shift; spins take the sign of the determinant of A.
struct View {
  Mat3 A = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
  bool swapped = false; ///< the ends exchange their numbers

  Vec3 axial(const Vec3& a) const { return A.determinant() < 0.0 ? Vec3(-(A * a)) : A * a; }
};

/// Force and torque on both ends at every step, and the final state of the bond.
struct Story {
  std::vector<Vec3> f[2], t[2];
  double D = 0.0, slip = 0.0, plastic = 0.0;
};

PairMaterials materials(BendingFlow flow)
{
  DamageBond law = bond_of_table_1();
  law.flow = flow;
  law.twist = Twist::elastic;
  law.u_c = 1e-3;
  law.theta_c = 30e-3;
  return {law, contact(40e6, 2.0, 0.3, 0.2e-3)};
}

Story seen(const Script& script, const View& view, BendingFlow flow)
{
  Scene s;
  s.material = materials(flow);
  const std::size_t at[] = {view.swapped ? 1u : 0u, view.swapped ? 0u : 1u};
  for (const std::size_t e : at) // at is its own inverse
    s.p.add(sphere(view.A * script.x[e][0] + view.shift, script.R[e]));
  s.bond({{0, 1}});
  Story out;
  for (std::size_t k = 0; k < n_steps; ++k) {
    for (std::size_t e = 0; e < 2; ++e) {
      ParticleState& b = s.p.state[at[e]];
      b.x = view.A * script.x[e][k + 1] + view.shift;
      b.v = view.A * script.v[e][k];
      b.omega = view.axial(script.omega[e][k]);
    }
    s.forces(dt);
    for (std::size_t e = 0; e < 2; ++e) {
      out.f[e].push_back(s.p.load[at[e]].f);
      out.t[e].push_back(s.p.load[at[e]].t);
    }
  }
  out.D = read_bond(s.bonds, 0, s.p, s.cell, s.material.bond).D;
  out.slip = s.losses.slip.value();
  out.plastic = s.losses.plastic.value();
  return out;
}

/// Largest difference of forces over the largest force, and of torques.
double difference(const Story& plain, const Story& other, const View& view)
{
  double f = 0.0, t = 0.0, df = 0.0, dtorque = 0.0;
  for (int e = 0; e < 2; ++e)
    for (std::size_t k = 0; k < n_steps; ++k) {
      f = std::max(f, plain.f[e][k].norm());
      t = std::max(t, plain.t[e][k].norm());
      df = std::max(df, (other.f[e][k] - view.A * plain.f[e][k]).norm());
      dtorque = std::max(dtorque, (other.t[e][k] - view.axial(plain.t[e][k])).norm());
    }
  return std::max({df / f, dtorque / t, std::abs(plain.D - other.D)});
}

/// The bond yields and is damaged, the contact slides, and the bond is not yet broken.
void check_is_conclusive(const Story& s)
{
  CAPTURE(s.D, s.slip, s.plastic);
  CHECK(s.D > 0.1);
  CHECK(s.D < 0.99);
  CHECK(s.plastic > 0.0);
  CHECK(s.slip > 0.0);
}

const BendingFlow flows[] = {BendingFlow::conjugate, BendingFlow::published};

} // namespace

TEST_CASE("The loads of a bond do not depend on the order of its ends",
          "[verification][dem]")
{
  View swapped;
  swapped.swapped = true;
  for (const BendingFlow flow : flows)
    for (const int seed : {1, 2, 3}) {
      // Equal radii: both arms are half the distance exactly, and so are the bits.
      const Script equal = script(seed, 0.03, 0.03);
      const Story a = seen(equal, {}, flow), b = seen(equal, swapped, flow);
      check_is_conclusive(a);
      CHECK(difference(a, b, swapped) == 0.0);
      CHECK(a.plastic == b.plastic);
      CHECK(a.slip == b.slip);
      // Unequal: the arm of j is the distance less that of i, with one rounding more;
      // measured 2.5e-15.
      const Script unequal = script(seed, 0.02, 0.04);
      const Story c = seen(unequal, {}, flow), d = seen(unequal, swapped, flow);
      check_is_conclusive(c);
      CHECK(difference(c, d, swapped) < 1e-14);
    }
}

TEST_CASE("Mirroring reflects forces as vectors and torques as pseudovectors, to the bit",
          "[verification][dem]")
{
  for (const BendingFlow flow : flows)
    for (int axis = 0; axis < 3; ++axis) {
      View mirror;
      mirror.A(axis, axis) = -1.0;
      const Script s = script(4 + axis, 0.02, 0.04);
      const Story a = seen(s, {}, flow), b = seen(s, mirror, flow);
      check_is_conclusive(a);
      CHECK(difference(a, b, mirror) == 0.0);
      CHECK(a.plastic == b.plastic);
      CHECK(a.slip == b.slip);
    }
}

TEST_CASE("The loads of a scene rotated about any axis rotate with it",
          "[verification][dem]")
{
  // Rotated positions have an error of some 1e-17 m, against a yield displacement of
  // 0.15 mm; measured 1.3e-13.
  std::mt19937_64 random(8);
  double worst = 0.0;
  for (const BendingFlow flow : flows)
    for (int k = 0; k < 8; ++k) {
      View rotated;
      rotated.A = Eigen::AngleAxisd(6.0 * random_vector(random).x(),
                                    random_vector(random).normalized())
                      .toRotationMatrix();
      const Script s = script(10 + k, 0.02, 0.04);
      const Story a = seen(s, {}, flow), b = seen(s, rotated, flow);
      check_is_conclusive(a);
      worst = std::max(worst, difference(a, b, rotated));
    }
  CAPTURE(worst);
  CHECK(worst < 5e-13);
}

TEST_CASE("The loads do not depend on the origin, to the bit", "[verification][dem]")
{
  // Positions on a grid of 2^-44 m stay exact doubles after a shift of a few metres.
  View shifted;
  shifted.shift = {3.0, -5.0, 0.375};
  for (const BendingFlow flow : flows)
    for (const int seed : {20, 21, 22}) {
      const Script s = script(seed, 0.02, 0.04);
      const Story a = seen(s, {}, flow), b = seen(s, shifted, flow);
      check_is_conclusive(a);
      CHECK(difference(a, b, shifted) == 0.0);
      CHECK(a.plastic == b.plastic);
    }
}

TEST_CASE("A bond has the same bits in every lane and beside any neighbours",
          "[verification][dem]")
{
  const Script told = script(30, 0.02, 0.04);
  for (const BendingFlow flow : flows) {
    const Story alone = seen(told, {}, flow);
    check_is_conclusive(alone);
    for (const std::size_t n_bonds : {4u, 9u}) // full blocks, and a last one of one bond
      for (std::size_t place = 0; place < n_bonds; ++place) {
        std::vector<Script> scripts;
        for (std::size_t b = 0; b < n_bonds; ++b)
          scripts.push_back(b == place ? told
                                       : script(40 + static_cast<int>(b), 0.03, 0.025));
        Scene s;
        s.material = materials(flow);
        std::vector<Pair> pairs;
        for (const Script& other : scripts) {
          const Index i = s.p.add(sphere(other.x[0][0], other.R[0]));
          pairs.push_back({i, s.p.add(sphere(other.x[1][0], other.R[1]))});
        }
        s.bond(pairs);
        bool same = true;
        for (std::size_t k = 0; k < n_steps; ++k) {
          for (std::size_t b = 0; b < n_bonds; ++b)
            for (std::size_t e = 0; e < 2; ++e) {
              ParticleState& particle = s.p.state[2 * b + e];
              particle.x = scripts[b].x[e][k + 1];
              particle.v = scripts[b].v[e][k];
              particle.omega = scripts[b].omega[e][k];
            }
          s.forces(dt);
          for (std::size_t e = 0; e < 2; ++e) {
            const Load& load = s.p.load[2 * place + e];
            same = same && load.f == alone.f[e][k] && load.t == alone.t[e][k];
          }
        }
        CAPTURE(n_bonds, place);
        CHECK(same);
        CHECK(1.0 - s.bonds.intact(place) == alone.D);
        CHECK(s.losses.yielded > 0);
      }
  }
}
