// The contact of a particle with a smooth patch of triangles has one energy, whose gradient is the
// force on particle and nodes (dem/README.md, Walls).
#include "tests/support/catch.h"
#include "tests/support/wall_patches.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

/// Closed path over the middle of a wall, at a height at which the particle touches.
class ClosedPath {
public:
  explicit ClosedPath(std::uint64_t seed)
  {
    std::mt19937_64 random(seed);
    const auto coefficient = [&]() -> Vec3 {
      return random_vector(random).cwiseProduct(Vec3(0.25 * R, 0.25 * R, 0.01 * R));
    };
    for (int k = 0; k < 3; ++k) {
      cosine_.push_back(coefficient());
      sine_.push_back(coefficient());
    }
  }
  /// @param s from 0 to 1
  Vec3 at(double s, double height) const
  {
    Vec3 x(0.1 * R, 0.2 * R, height);
    for (std::size_t k = 0; k < cosine_.size(); ++k) {
      const double a = 2.0 * pi * (k + 1.0) * s;
      x += cosine_[k] * std::cos(a) + sine_[k] * std::sin(a);
    }
    return x;
  }

private:
  std::vector<Vec3> cosine_, sine_;
};

/// Height of a centre above (x, y) at which the particle is pressed by this overlap.
double height_above(Probe& probe, const Vec3& at, double overlap)
{
  double low = 0.5 * R, high = 2.0 * R; // of which the first presses more
  const double wanted = contact_energy(probe.wall.material, sides_at_wall(R), overlap, 0.0);
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (low + high);
    probe.force_at({at.x(), at.y(), middle});
    (probe.stored() > wanted ? low : high) = middle;
  }
  return low;
}

struct Closure {
  double open = 0.0;    ///< largest difference of work and stored energy on the path [J]
  double largest = 0.0; ///< stored energy [J]
  int n_several = 0;    ///< places with several features
};

/// Work of the contact on a frictionless particle that is moved along a path, by the
/// trapezoidal rule, against its stored energy.
Closure closure(const Wall& wall, const ClosedPath& path, double height, int n)
{
  Probe probe(wall);
  Vec3 x = path.at(0.0, height), f = probe.force_at(x);
  const double start = probe.stored();
  Closure c;
  double work = 0.0;
  for (int k = 1; k <= n; ++k) {
    const Vec3 x_new = path.at(double(k) / n, height), f_new = probe.force_at(x_new);
    work += 0.5 * (f + f_new).dot(x_new - x);
    x = x_new;
    f = f_new;
    const double stored = probe.stored();
    c.open = std::max(c.open, std::abs(work + stored - start));
    c.largest = std::max(c.largest, std::abs(stored));
    c.n_several += probe.wall.contact_forces.size() > 1;
  }
  return c;
}

} // namespace

TEST_CASE("Work of a patch of triangles on a particle is what its contact stored",
          "[verification][dem]")
{
  const ContactLaw law = GENERATE(ContactLaw(smooth), ContactLaw(hertz(0.0)));
  constexpr int n = 2000;
  int n_several_in_all = 0;
  for (const NamedWall& w : walls(law)) {
    REQUIRE(w.wall.topology.n_patches == 1);
    Probe probe(w.wall);
    double coarse = 0.0, fine = 0.0; // over the largest stored energy
    int n_several = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const ClosedPath path(seed);
      const Vec3 start = path.at(0.0, 0.0);
      const double height = height_above(probe, start, 0.03 * R) - start.z();
      const Closure by_n = closure(w.wall, path, height, n),
                    by_8n = closure(w.wall, path, height, 8 * n);
      coarse = std::max(coarse, by_n.open / by_n.largest);
      fine = std::max(fine, by_8n.open / by_8n.largest);
      n_several += by_8n.n_several;
    }
    CAPTURE(w.name, coarse, fine, n_several);
    // Second order is 1/64; how the steps meet the kinks of the force is chance.
    CHECK(fine < coarse / 20.0);
    CHECK(fine < 1e-5);
    n_several_in_all += n_several;
  }
  CHECK(n_several_in_all > 100000);
}

TEST_CASE("Forces of a patch on the nodes are the gradient of its stored energy",
          "[verification][dem]")
{
  const ContactLaw law = GENERATE(ContactLaw(smooth), ContactLaw(hertz(0.0)));
  constexpr double h = 1e-6 * R;
  for (const NamedWall& w : walls(law)) {
    Probe probe(w.wall);
    double worst = 0.0;
    int n_several = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      Vec3 x = ClosedPath(seed).at(0.0, 0.0);
      x.z() = height_above(probe, x, 0.03 * R);
      const double size = probe.force_at(x).norm();
      n_several += probe.wall.contact_forces.size() > 1;
      std::vector<Vec3> f;
      for (std::size_t k = 0; k < probe.wall.f.size(); ++k)
        f.push_back(probe.wall.f.value(k));
      for (std::size_t node = 0; node < f.size(); ++node)
        for (int d = 0; d < 3; ++d) {
          const double at = probe.wall.x[node][d];
          const auto stored_at = [&](double to) {
            probe.wall.x[node][d] = to;
            probe.force_at(x);
            return probe.stored();
          };
          const double gradient = (stored_at(at + h) - stored_at(at - h)) / (2.0 * h);
          probe.wall.x[node][d] = at;
          worst = std::max(worst, std::abs(f[node][d] + gradient) / size);
        }
    }
    CAPTURE(w.name, worst, n_several);
    CHECK(worst < 1e-6);
  }
}

TEST_CASE("A particle over several pits stores an energy below 0", "[verification][dem]")
{
  // Of the parts of the wall in reach, one in the middle with holes in it counts less than 0.
  const ContactLaw law = GENERATE(ContactLaw(rough), ContactLaw(hertz(0.3)));
  Probe probe(four_pits(law));
  probe.p.state[0].v = {0.1, 0.05, 0.0};
  int n_shear = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec3 x(1e-7 * k, 5e-8 * k, R * (1.01 - 0.06 * k / 200));
    probe.force_at(x, 1e-6);
    const Load& load = probe.p.load[0];
    Vec3 force = load.f, moment = x.cross(load.f) + load.t;
    for (std::size_t node = 0; node < probe.wall.x.size(); ++node) {
      force += probe.wall.f.value(node);
      moment += probe.wall.x[node].cross(probe.wall.f.value(node));
    }
    CHECK(force.norm() <= 1e-11 * load.f.norm()); // 0 before they touch
    CHECK(moment.norm() <= 1e-11 * R * load.f.norm());
    const bool sticks = probe.wall.contacts.at(0).f_s != Vec3::Zero();
    CHECK(sticks == (probe.stored() > 0.0));
    n_shear += sticks;
  }
  CHECK(probe.stored() < 0.0);
  CHECK(n_shear > 20);
  CHECK(probe.losses.slip.value() > 0.0); // it has what the shear force had stored
}
