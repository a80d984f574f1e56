#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/particles/kinematics.h"

#include <bit>

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

bool same_bits(double a, double b)
{
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_bits(const Triple<double>& a, const Triple<double>& b)
{
  return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}

/// Random numbers, vectors and ends of a pair, one in each lane.
struct Fours {
  std::mt19937_64 random{7};

  Lanes number(double low, double high)
  {
    std::uniform_real_distribution<double> u(low, high);
    Lanes a{};
    for (int l = 0; l < n_lanes; ++l) a[l] = u(random);
    return a;
  }
  Triple<Lanes> vector(double scale)
  {
    return {number(-scale, scale), number(-scale, scale), number(-scale, scale)};
  }
  End<Lanes> end(double x)
  {
    End<Lanes> e{vector(1e-4), number(1e-5, 9e-5), vector(0.1), number(1.0, 3.0),
                 vector(50.0)};
    e.x.x += Lanes{} + x;
    return e;
  }
};

End<double> lane_of(const End<Lanes>& e, int l)
{
  return {lane(e.x, l), e.R[l], lane(e.v, l), e.S[l], lane(e.omega, l)};
}

} // namespace

TEST_CASE("One row per lane is transposed into four columns, and back", "[unit][dem]")
{
  Row in[n_lanes], out[n_lanes];
  for (int l = 0; l < n_lanes; ++l)
    in[l] = Row{10.0 * l, 10.0 * l + 1, 10.0 * l + 2, 10.0 * l + 3};
  Lanes column[4];
  columns(in, column[0], column[1], column[2], column[3]);
  for (int l = 0; l < n_lanes; ++l)
    for (int k = 0; k < 4; ++k) CHECK(column[k][l] == 10.0 * l + k);
  rows(column[0], column[1], column[2], column[3], out);
  for (int l = 0; l < n_lanes; ++l)
    for (int k = 0; k < 4; ++k) CHECK(out[l][k] == in[l][k]);
}

TEST_CASE("A lane-wise choice decides each lane by its own condition", "[unit][dem]")
{
  const Lanes a{1, 5, -3, 2}, b{2, 4, -3, -2};
  const Lanes smallest = mergel::dem::min(a, b);
  for (int l = 0; l < n_lanes; ++l) CHECK(smallest[l] == std::min(a[l], b[l]));
  CHECK(any(a < b));
  CHECK_FALSE(any(a > Lanes{9, 9, 9, 9}));
  for (int l = 0; l < n_lanes; ++l) { // any() sees every lane
    Lanes one{};
    one[l] = 1.0;
    CHECK(any(one > Lanes{}));
  }
}

TEST_CASE("The four-lane kernel gives the bits of the scalar kernel", "[unit][dem]")
{
  Fours fours;
  DamageBond bond = bond_of_table_1();
  bond.twist = Twist::elastic;
  ParallelBond brittle;
  static_cast<BondSection&>(brittle) = bond;
  brittle.sigma_c = bond.sigma_t;
  brittle.tau_c = bond.C;
  const LinearMaterial law = contact(0.63e9, 2.4, 0.38, 3e-5);
  const HertzMaterial spheres{0.63e9, 0.2, 0.38};
  int n_sliding = 0, n_open = 0, n_elastic = 0, n_held = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const End<Lanes> i = fours.end(0.0), j = fours.end(2e-4);
    const double dt = 1e-7;
    const PairMotion<Lanes> k = pair_motion(i, j, dt);
    const Triple<Lanes> history = fours.vector(3e-2);
    const Triple<Lanes> V = rotated_with_contact(history, k);
    const Lanes r = mergel::dem::min(i.R, j.R), S = 0.5 * (i.S + j.S);
    const auto sides = sides_of_pair(i.R, j.R, k.inv_L);
    const auto c = contact_step(law, sides, S, {k.gap, k.du_n, k.du_s, V});
    const auto h = contact_step(spheres, sides, S, {k.gap, k.du_n, k.du_s, V});
    const auto shape = bond_shape(bond, r, k.inv_L);
    const EffectiveLoads<Lanes> q{fours.number(-1e-3, 1e-3), fours.vector(1e-3),
                                  fours.vector(1e-9), fours.number(-1e-9, 1e-9)};
    const auto elastic = is_elastic(bond, shape, q);
    const auto holds = is_elastic(brittle, shape, q);

    bool same = true;
    for (int l = 0; l < n_lanes; ++l) {
      const auto k1 = pair_motion(lane_of(i, l), lane_of(j, l), dt);
      same = same && same_bits(k1.n, lane(k.n, l)) && same_bits(k1.gap, k.gap[l]) &&
             same_bits(k1.inv_L, k.inv_L[l]) && same_bits(k1.a_i, k.a_i[l]) &&
             same_bits(k1.a_j, k.a_j[l]) && same_bits(k1.du_n, k.du_n[l]) &&
             same_bits(k1.du_s, lane(k.du_s, l)) &&
             same_bits(k1.dtheta, lane(k.dtheta, l)) && same_bits(k1.dphi, k.dphi[l]) &&
             same_bits(k1.dn, lane(k.dn, l)) && same_bits(k1.rotation_n, k.rotation_n[l]);

      const auto V1 = rotated_with_contact(lane(history, l), k1);
      const double r1 = mergel::dem::min(i.R[l], j.R[l]);
      const double S1 = 0.5 * (i.S[l] + j.S[l]);
      const auto sides1 = sides_of_pair(i.R[l], j.R[l], k1.inv_L);
      const auto c1 = contact_step(law, sides1, S1, {k1.gap, k1.du_n, k1.du_s, V1});
      same = same && same_bits(V1, lane(V, l)) && same_bits(c1.f_n, c.f_n[l]) &&
             same_bits(c1.f_s, lane(c.f_s, l)) && same_bits(c1.slip_loss, c.slip_loss[l]);
      const auto h1 = contact_step(spheres, sides1, S1, {k1.gap, k1.du_n, k1.du_s, V1});
      same = same && same_bits(h1.f_n, h.f_n[l]) && same_bits(h1.f_s, lane(h.f_s, l)) &&
             same_bits(h1.slip_loss, h.slip_loss[l]);
      n_sliding += c1.slip_loss > 0.0 && c1.f_n > 0.0;
      n_open += c1.f_n == 0.0;

      const auto s1 = bond_shape(bond, r1, k1.inv_L);
      const EffectiveLoads<double> q1{q.N[l], lane(q.V, l), lane(q.M, l), q.T[l]};
      same = same && same_bits(s1.R_b, shape.R_b[l]) && same_bits(s1.A, shape.A[l]) &&
             same_bits(s1.k_n, shape.k_n[l]) && same_bits(s1.k_s, shape.k_s[l]) &&
             same_bits(s1.k_b, shape.k_b[l]) && same_bits(s1.k_t, shape.k_t[l]) &&
             same_bits(spring_energy(s1, q1), spring_energy(shape, q)[l]) &&
             static_cast<bool>(is_elastic(bond, s1, q1)) == (elastic[l] != 0) &&
             static_cast<bool>(is_elastic(brittle, s1, q1)) == (holds[l] != 0);
      n_elastic += elastic[l] != 0;
      n_held += holds[l] != 0;
    }
    REQUIRE(same);
  }
  // every branch was taken
  CHECK(n_sliding > 100);
  CHECK(n_open > 100);
  CHECK(n_elastic > 100);
  CHECK(n_elastic < 4 * 5000 - 100);
  CHECK(n_held > 100);
  CHECK(n_held < 4 * 5000 - 100);
}
