/// One bond under imposed motion against its closed forms, Eqs. 2, 3, 6 of the paper, with
/// the left column of its Table 1 and R = 30 mm.
#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

constexpr double R = 30e-3, dt = 1e-4;

/// A bonded pair along x whose motion is imposed.
struct MovedBond {
  Scene s;

  explicit MovedBond(double D_broken = 0.99)
  {
    s.p.add(sphere({0, 0, 0}, R));
    s.p.add(sphere({2.0 * R, 0, 0}, R));
    s.bond_law().D_broken = D_broken;
    s.bond({{0, 1}});
  }
  BondReading move(const Vec3& du, const Vec3& dtheta_i, const Vec3& dtheta_j)
  {
    s.p.state[1].v = du / dt;
    s.p.state[1].x += du;
    s.p.state[0].omega = dtheta_i / dt;
    s.p.state[1].omega = dtheta_j / dt;
    s.forces(dt);
    return read_bond(s.bonds, 0, s.p, s.cell, s.material.bond);
  }
  /// Pull by du [m].
  double pull(double du) { return move({du, 0, 0}, {0, 0, 0}, {0, 0, 0}).N; }
  /// Shear by du: equal rotations separate the contact points along y and keep the normal.
  double shear(double du)
  {
    const Vec3 turn(0, 0, -du / (2.0 * R));
    const Vec3 V = move({0, 0, 0}, turn, turn).V;
    return V.norm() * (V.y() < 0.0 ? -1.0 : 1.0);
  }
  /// Bend by dtheta about z: opposite rotations.
  double bend(double dtheta)
  {
    return move({0, 0, 0}, {0, 0, -0.5 * dtheta}, {0, 0, 0.5 * dtheta}).M.z();
  }
};

using Move = double (MovedBond::*)(double);

struct Mode {
  const char* name;
  Move drive;
  double peak, at, tail; ///< strength, motion at yield, softening scale
};

const Mode modes[] = {
    {"tension", &MovedBond::pull, 314.159265, 0.15e-3, 0.1e-3},
    {"compression", &MovedBond::pull, -3141.59265, -1.5e-3, 0.1e-3},
    {"shear", &MovedBond::shear, 471.238898, 0.45e-3, 0.1e-3},
    {"bending", &MovedBond::bend, 0.785398163, 15e-3, 0.1e-3},
};

/// Moves on to `target` in n equal steps; returns the load.
double move_to(MovedBond& b, const Mode& mode, double& now, double target, int n)
{
  double load = 0.0;
  const double step = (target - now) / n;
  for (int k = 0; k < n; ++k) load = (b.*mode.drive)(step);
  now = target;
  return load;
}

} // namespace

TEST_CASE("One bond rises to its strength and falls as exp(-(u-u_y)/u_c)",
          "[verification][dem]")
{
  for (const Mode& mode : modes) {
    CAPTURE(mode.name);
    MovedBond b;
    double u = 0.0;
    const double sign = mode.at > 0.0 ? 1.0 : -1.0;
    CHECK(move_to(b, mode, u, 0.5 * mode.at, 7) == Approx(0.5 * mode.peak).epsilon(1e-6));
    CHECK(move_to(b, mode, u, mode.at, 7) == Approx(mode.peak).epsilon(1e-6));
    for (const double tails : {0.3, 1.0, 2.0, 4.0}) {
      // Exact for any step: the effective load is constant, and damage is a product of
      // exponentials.
      const double load = move_to(b, mode, u, mode.at + sign * tails * mode.tail, 5);
      CHECK(load == Approx(mode.peak * std::exp(-tails)).epsilon(1e-6));
    }
    CHECK(b.s.losses.broken == 0);
    move_to(b, mode, u, mode.at + sign * 4.604 * mode.tail, 1);
    CHECK(b.s.losses.broken == 0);
    // D = 0.99 is reached ln 100 = 4.60517 softening scales past yield
    CHECK(move_to(b, mode, u, mode.at + sign * 4.606 * mode.tail, 1) == 0.0);
    CHECK(b.s.losses.broken == 1);
    CHECK(b.s.p.n_bonds[0] == 0);
    CHECK(b.s.p.n_bonds[1] == 0);
  }
}

TEST_CASE("Both bending flows agree where only bending acts", "[verification][dem]")
{
  MovedBond b;
  b.s.bond_law().flow = BendingFlow::published;
  double theta = 0.0;
  CHECK(move_to(b, modes[3], theta, 15.1e-3, 100) ==
        Approx(0.785398163 * std::exp(-1.0)).epsilon(1e-6));
}

TEST_CASE("A damaged bond unloads along (1-D) k", "[verification][dem]")
{
  for (const Mode& mode : modes) {
    CAPTURE(mode.name);
    MovedBond b;
    double u = 0.0;
    const double sign = mode.at > 0.0 ? 1.0 : -1.0, past = sign * 0.7 * mode.tail;
    const double top = move_to(b, mode, u, mode.at + past, 40);
    const double k = mode.peak / mode.at;
    const double back = 0.3 * mode.at;
    const double lower = move_to(b, mode, u, u - back, 3);
    CHECK((top - lower) / back == Approx(std::exp(-0.7) * k).epsilon(1e-6));
    // and reaches zero at the plastic part of the motion; 1e-9 of the peak is round-off of
    // the position
    CHECK(move_to(b, mode, u, past, 3) == Approx(0.0).margin(1e-9 * std::abs(mode.peak)));
    // and returns to the load at which it unloaded
    CHECK(move_to(b, mode, u, mode.at + past, 3) == Approx(top).epsilon(1e-6));
  }
}

TEST_CASE("One bond absorbs strength (u_y/2 + u_c) to full damage", "[verification][dem]")
{
  for (const Mode& mode : modes) {
    CAPTURE(mode.name);
    const double sign = mode.at > 0.0 ? 1.0 : -1.0;
    const auto lost = [&](int n) {
      MovedBond b(1.0 - 1e-9);
      double u = 0.0;
      move_to(b, mode, u, mode.at, 5);
      const double elastic = b.s.stored();
      CHECK(elastic == Approx(0.5 * mode.peak * mode.at).epsilon(1e-6));
      move_to(b, mode, u, mode.at + sign * 21.0 * mode.tail, n);
      CHECK(b.s.losses.broken == 1);
      return b.s.losses.plastic.value() + b.s.losses.breakage_release.value();
    };
    const double exact = mode.peak * (0.5 * mode.at + sign * mode.tail);
    const double e_1 = std::abs(lost(400) - exact) / exact;
    const double e_2 = std::abs(lost(800) - exact) / exact;
    // Trapezoidal work of exp(-s): relative error of the tail (ds)^2/12 with ds = 21/n.
    const double tail_share = mode.tail / std::abs(0.5 * mode.at + sign * mode.tail);
    CAPTURE(e_1, e_2);
    CHECK(e_1 < 1.1 * tail_share * std::pow(21.0 / 400, 2) / 12.0 + 1e-8);
    CHECK(e_1 / e_2 == Approx(4.0).epsilon(0.05));
  }
}
