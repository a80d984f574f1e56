#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"
#include "tests/support/polyhedra.h"

#include "dem/walls/rigid_wall.h"
#include "dem/walls/wall_readings.h"

#include <algorithm>
#include <random>

using namespace mergel::dem;
using namespace mergel::dem::test;
using mergel::match::Contains;

namespace {

constexpr double mm = 1e-3, R = 0.2 * mm;
const LinearMaterial smooth = contact(1e9, 2.0, 0.0, 0.0);

RigidWall wall_of(const ClosedSurface& surface, const ContactLaw& law = smooth)
{
  return make_rigid_wall(make_polyhedron(surface), Vec3::Zero(), law);
}

/// Force of the wall on a smooth particle at x at rest.
Vec3 force_at(const ClosedSurface& surface, const Vec3& x)
{
  RigidWall wall = wall_of(surface);
  Particles p;
  p.add(sphere(x, R));
  rebuild_wall(wall, {}, p, 0.1 * mm);
  PairLosses losses;
  add_wall_forces(wall, {}, 0.0, p, losses);
  CHECK((wall.resultant() + p.load[0].f).norm() <= 1e-12 * p.load[0].f.norm());
  return p.load[0].f;
}

/// Of one contact with this overlap.
double force_of(double overlap)
{
  return normal_force(smooth, sides_at_wall(R), overlap);
}

/// Two slabs at a right angle, open towards x > 0.2 mm, y > 0.2 mm.
const ClosedSurface angle = prism({{{-1 * mm, -1 * mm},
                                    {2 * mm, -1 * mm},
                                    {2 * mm, 0},
                                    {0, 0},
                                    {0, 2 * mm},
                                    {-1 * mm, 2 * mm}}},
                                  4 * mm);

} // namespace

TEST_CASE("the tip of a polyhedron reaches to the lowest of its largest sections",
          "[unit][dem]")
{
  const double h = 0.7 * mm * std::sqrt(3.0);
  const auto cone = make_polyhedron(cone_ended_surface(0.7 * mm, h, 20 * mm, 64));
  CHECK(cone.tip_height == Approx(h).epsilon(1e-12));
  CHECK(cone.length == Approx(20 * mm));
  // The area of a polygon of 64 corners on the circle.
  const double area = 32.0 * std::sin(2.0 * pi / 64) * 0.49 * mm * mm;
  CHECK(pi * cone.R() * cone.R() == Approx(area).epsilon(1e-12));
  // An area of 0 at the apex to round-off, 1e-16, is a radius of 1e-8.
  CHECK(radius_at(RigidShape(cone), 0.5 * h) == Approx(0.5 * cone.R()).epsilon(1e-6));
  CHECK(radius_at(RigidShape(cone), 10 * mm) == Approx(cone.R()).epsilon(1e-9));
  CHECK(radius_at(RigidShape(cone), -0.1 * mm) == 0.0);

  const auto square = make_polyhedron(box(2 * mm, 1 * mm, 8 * mm));
  CHECK(square.tip_height == 0.0);
  CHECK(pi * square.R() * square.R() == Approx(2 * mm * mm).epsilon(1e-12));

  // A base of twice the diameter: all above it is shaft.
  const auto base = make_polyhedron(revolved(
      {{0, 0}, {2 * mm, 1 * mm}, {2 * mm, 3 * mm}, {1 * mm, 3.5 * mm}, {1 * mm, 9 * mm}},
      40));
  CHECK(base.tip_height == Approx(1 * mm).epsilon(1e-12));
  CHECK(radius_at(RigidShape(base), 8 * mm) == Approx(0.5 * base.R()).epsilon(1e-9));

  // A double cone has its largest section at one height.
  const auto spindle =
      make_polyhedron(revolved({{0, 1 * mm}, {1 * mm, 2 * mm}, {0, 3 * mm}}, 40));
  CHECK(spindle.tip_height == Approx(1 * mm).epsilon(1e-12)); // from its lowest point
  CHECK(spindle.surface.x.front().z() == 0.0);
}

TEST_CASE("a surface that bounds no polyhedron is refused with what is wrong",
          "[unit][dem]")
{
  const ClosedSurface good = box(1.0, 1.0, 1.0);
  require_closed(good);
  CHECK(volume(good) == Approx(1.0));
  CHECK((centre_of_volume(good) - Vec3(0, 0, 0.5)).norm() < 1e-14);

  ClosedSurface open = good;
  open.triangles.pop_back();
  CHECK_THROWS_WITH(require_closed(open),
                    Contains("the surface is open: no other triangle"));

  ClosedSurface turned = good;
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  CHECK_THROWS_WITH(require_closed(turned), Contains("is the wrong way round"));

  ClosedSurface inside_out = good;
  for (Triangle& t : inside_out.triangles) std::swap(t[0], t[1]);
  CHECK_THROWS_WITH(require_closed(inside_out), Contains("is inside out"));

  const auto shifted = [&](const Vec3& by) {
    ClosedSurface s = good;
    for (const Vec3& x : good.x) s.x.push_back(x + by);
    for (const Triangle& t : good.triangles)
      s.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
    std::vector<std::array<Vec3, 3>> corners;
    for (const Triangle& t : s.triangles)
      corners.push_back({s.x[uz(t[0])], s.x[uz(t[1])], s.x[uz(t[2])]});
    return join_corners(corners);
  };
  CHECK_THROWS_WITH(require_closed(shifted({3, 0, 0})),
                    Contains("only 12 of its 24 triangles hang together"));
  CHECK_THROWS_WITH(require_closed(shifted({1, 1, 1})), Contains("touch at the point"));
  CHECK_THROWS_WITH(require_closed(shifted({1, 0, 0})), Contains("in the same direction"));

  CHECK_THROWS_WITH(join_corners({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 1e-12, 0)}}),
                    Contains("triangle 1, with a corner at (0, 0, 0), has no area"));
  CHECK_THROWS_WITH(require_closed({}), Contains("has 0 triangles"));
}

TEST_CASE(
    "a polyhedron that is not its own mirror image is refused, one that is nearly is not",
    "[unit][dem]")
{
  require_symmetric(make_polyhedron(box(2.0, 1.0, 3.0)), 1e-9);
  // Of an odd number of facets only a corner lies on the plane: off by the sagitta.
  const double sagitta = 1.0 - std::cos(pi / 31);
  ClosedSurface odd = revolved({{0, 0}, {1, 1}, {1, 4}}, 31);
  for (Vec3& x : odd.x) x = Vec3(x.y(), x.x(), x.z()); // symmetric about x = 0
  for (Triangle& t : odd.triangles) std::swap(t[0], t[1]);
  const auto polyhedron = make_polyhedron(odd);
  require_symmetric(polyhedron, 1.01 * sagitta);
  CHECK_THROWS_WITH(require_symmetric(polyhedron, 0.1 * sagitta),
                    Contains("is not symmetric about the plane y = 0"));
  ClosedSurface aside = box(2.0, 1.0, 3.0);
  for (Vec3& x : aside.x) x.y() += 0.1;
  CHECK_THROWS_WITH(require_symmetric(make_polyhedron(aside), 0.05),
                    Contains("is not symmetric"));
}

TEST_CASE("at face, edge and corner of a box a particle has one force, along the way to it",
          "[unit][dem]")
{
  const ClosedSurface square = box(2 * mm, 2 * mm, 8 * mm);
  const double d = 0.9 * R;
  for (const Vec3& n :
       {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(1, 1, 0), Vec3(1, 0, -1), Vec3(-1, 1, -1)}) {
    Vec3 at(0.3 * mm, 0.2 * mm, 3 * mm); // a point of the surface
    for (int k = 0; k < 2; ++k)
      if (n[k] != 0.0) at[k] = n[k] * 1 * mm;
    if (n.z() != 0.0) at.z() = 0.0;
    const Vec3 f = force_at(square, at + d * n.normalized());
    CHECK((f - force_of(R - d) * n.normalized()).norm() < 1e-9 * force_of(R - d));
  }
  CHECK(force_at(square, {0, 0, -1.01 * R}) == Vec3::Zero());
}

TEST_CASE("in a corner of a polyhedron both sides act, and a particle that bridges it does "
          "not stick",
          "[unit][dem]")
{
  const Vec3 f = force_at(angle, {0.9 * R, 0.8 * R, 2 * mm});
  CHECK(f.x() == Approx(force_of(0.1 * R)).epsilon(1e-9));
  CHECK(f.y() == Approx(force_of(0.2 * R)).epsilon(1e-9));
  CHECK(std::abs(f.z()) < 1e-9 * force_of(R));
}

TEST_CASE("the far side of a blade that is thinner than an overlap does not act",
          "[unit][dem]")
{
  const ClosedSurface blade = box(2 * mm, 0.1 * R, 8 * mm);
  const Vec3 f = force_at(blade, {0.0, 0.85 * R, 3 * mm}); // 0.8 R from the near side
  CHECK(f.y() == Approx(force_of(0.2 * R)).epsilon(1e-9));
  // Beside a needle: its far side is within reach too.
  const ClosedSurface needle = revolved({{0, 0}, {1 * mm, 8 * mm}, {1 * mm, 9 * mm}}, 100);
  const double half = std::atan(1.0 / 8.0);
  const Vec3 foot = 0.4 * mm * Vec3(std::sin(half), 0, std::cos(half)),
             n(std::cos(half), 0, -std::sin(half));
  const Vec3 g = force_at(needle, foot + 0.7 * R * n);
  CHECK((g - force_of(0.3 * R) * n).norm() < 1e-3 * force_of(0.3 * R)); // of 100 chords
}

TEST_CASE("the work of a smooth polyhedron on a path around it and into a corner is the "
          "energy that its contact loses",
          "[unit][dem]")
{
  RigidWall wall = wall_of(angle);
  Particles p;
  p.add(sphere({-1.3 * mm, 1 * mm, 2 * mm}, R));
  PairLosses losses;
  const auto energy = [&] { return stored_energy(wall, p).value(); };
  double work = 0.0, largest = 0.0, worst = 0.0;
  // Over two ridges, along the inner side, into the corner and out of it.
  const std::vector<Vec3> stations{
      {-1.15 * mm, 1.9 * mm, 2 * mm}, {-0.9 * mm, 2.15 * mm, 2.1 * mm},
      {-0.1 * mm, 2.14 * mm, 2 * mm}, {0.15 * mm, 1.8 * mm, 2 * mm},
      {0.16 * mm, 0.14 * mm, 1 * mm}, {1 * mm, 0.15 * mm, -0.1 * mm},
      {1 * mm, 0.5 * mm, -0.5 * mm}};
  for (const Vec3& to : stations) {
    const Vec3 from = p.state[0].x;
    constexpr int n = 4000;
    for (int k = 1; k <= n; ++k) {
      p.state[0].x = from + double(k) / n * (to - from);
      rebuild_wall(wall, {}, p, 0.1 * mm);
      p.load[0].f.setZero();
      add_wall_forces(wall, {}, 0.0, p, losses);
      work += p.load[0].f.dot(to - from) / n;
      largest = std::max(largest, energy());
      worst = std::max(worst, std::abs(energy() + work));
    }
  }
  CHECK(largest > 0.0);
  CHECK(worst < 1e-3 * largest); // measured 6e-4: steps of 0.4 um, of the first order
  CHECK(energy() == 0.0);
}

TEST_CASE(
    "a polyhedron that is turned and moved with its particles has the same forces, turned",
    "[unit][dem]")
{
  const LinearMaterial rough = contact(1e9, 2.0, 0.3, 0.0);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.3, Vec3(1.0, 2.0, -0.5).normalized()));
  const Vec3 shift(0.4 * mm, -0.2 * mm, 0.1 * mm);
  RigidWall upright = wall_of(angle, rough), turned = upright;
  turned.x = shift;
  turned.rotation = turn;
  upright.reach = turned.reach = 10 * mm;
  Particles a, b;
  std::mt19937_64 random(5);
  while (a.size() < 100) {
    ParticleState s = sphere(2.2 * mm * random_vector(random) + Vec3(0, 0, 2 * mm), R);
    const auto& polyhedron = std::get<Polyhedron>(upright.shape);
    try {
      if (polyhedron.closest_point(s, Vec3::Zero()).gap > 0.0) continue;
    } catch (const mergel::NumericalError&) {
      continue; // inside
    }
    s.v = 0.1 * random_vector(random);
    a.add(s);
    s.x = shift + turn * s.x;
    s.v = turn * s.v;
    b.add(s);
  }
  PairLosses losses;
  rebuild_wall(upright, {}, a, 0.1 * mm);
  rebuild_wall(turned, {}, b, 0.1 * mm);
  add_wall_forces(upright, {}, 1e-7, a, losses);
  add_wall_forces(turned, {}, 1e-7, b, losses);
  int n = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    n += a.load[k].f != Vec3::Zero();
    CHECK((b.load[k].f - turn * a.load[k].f).norm() < 1e-8 * force_of(0.1 * R));
  }
  CHECK(n > 90);
  CHECK((turned.resultant() - turn * upright.resultant()).norm() < 1e-8 * force_of(R));

  // What is read afterwards are those forces.
  for (const WallContact& c : turned.contacts) {
    if (c.overlap <= 0.0) continue;
    Vec3 sum = Vec3::Zero();
    for (const RigidContact& r : read_contacts(turned, c, b)) sum += r.f;
    CHECK((sum - b.load[c.particle].f).norm() < 1e-9 * force_of(R));
  }
}

TEST_CASE("a particle whose centre is inside a polyhedron stops the run", "[unit][dem]")
{
  const ClosedSurface square = box(2 * mm, 2 * mm, 8 * mm);
  for (const Vec3& x : {Vec3(0, 0, 4 * mm), Vec3(0.99 * mm, 0.3 * mm, 4 * mm),
                        Vec3(0.99 * mm, 0.99 * mm, 0.01 * mm)})
    CHECK_THROWS_WITH(force_at(square, x), Contains("its centre is inside a rigid wall"));
}
