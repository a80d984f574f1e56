#include "dem/periodic_packing.h"

#include "dem/random.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace mergel::dem {

namespace {

/// Overlapping shells pushed apart, with a memory of the last sweep.
class Sweeps {
public:
  Sweeps(PeriodicPacking& packing, double g_a)
      : packing_(packing), g_a_(g_a), move_(packing.particles.size(), Vec3::Zero())
  {
    for (const Body& b : packing.particles.body) step_ = std::max(step_, 0.1 * b.R);
  }

  /// At this share of the sizes; returns the largest overlap over the pair's distance.
  double sweep(double share)
  {
    Particles& p = packing_.particles;
    if (moved_ > 0.5 * step_) { // of the margin of two steps
      pairs_ = find_pairs(p, packing_.cell, g_a_ + 2.0 * step_ / p.body[0].S);
      moved_ = 0.0;
    }
    std::vector<Vec3> push(p.size(), Vec3::Zero());
    double worst = 0.0;
    for (const Pair& q : pairs_) {
      const Body &i = p.body[q.i], &j = p.body[q.j];
      const double reach = share * (i.R + j.R + g_a_ * 0.5 * (i.S + j.S));
      const Vec3 r = j.x + packing_.cell.offset(q.shift) - i.x;
      const double d = r.norm();
      if (d >= reach) continue;
      worst = std::max(worst, (reach - d) / reach);
      const Vec3 n = d > 0.0 ? Vec3(r / d) : Vec3::UnitX();
      push[q.i] -= 0.5 * (reach - d) * n;
      push[q.j] += 0.5 * (reach - d) * n;
    }
    double most = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      move_[i] = 0.8 * move_[i] + 0.3 * push[i];
      const double length = move_[i].norm();
      if (length > 0.5 * step_) move_[i] *= 0.5 * step_ / length;
      p.body[i].x += move_[i];
      most = std::max(most, move_[i].norm());
    }
    moved_ += most;
    return worst;
  }

private:
  PeriodicPacking& packing_;
  double g_a_, step_ = 0.0;
  double moved_ = 1e300; ///< bound of the motion since the pairs were found [m]
  std::vector<Pair> pairs_;
  std::vector<Vec3> move_;
};

} // namespace

PeriodicPacking pack_periodic(const SpecimenSpec& spec, double S, std::size_t n)
{
  PeriodicPacking packing;
  std::vector<Body> bodies(n);
  double solid = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const auto draw = [&](std::uint64_t purpose) { return uniform(spec.seed, k, purpose); };
    Body& b = bodies[k];
    b.x = {draw(0), draw(1), draw(2)};
    b.R = 0.5 * S * (spec.d_min + (spec.d_max - spec.d_min) * draw(3));
    b.S = S;
    b.m = sphere_mass(b.R, spec.rho);
    solid += sphere_mass(b.R, 1.0);
  }
  std::sort(bodies.begin(), bodies.end(),
            [](const Body& a, const Body& b) { return a.x.x() < b.x.x(); });
  const double edge = std::cbrt(solid / (1.0 - spec.porosity));
  packing.cell.size = Vec3::Constant(edge);
  for (Body& b : bodies) {
    b.x *= edge;
    packing.particles.add(b);
  }

  Sweeps sweeps(packing, spec.g_a);
  constexpr int n_growing = 200, n_most = 4000;
  for (int k = 0; k < n_growing; ++k) sweeps.sweep(0.6 + 0.4 * k / n_growing);
  double worst = 1.0;
  for (int k = 0; k < n_most && worst > 1e-3; ++k) worst = sweeps.sweep(1.0);
  require(worst <= 1e-3,
          "the spheres with their far-field shells do not find room at this porosity: an "
          "overlap "
          "of " +
              std::to_string(worst) +
              " of the distance is left; raise the porosity, or lower the activation gap");
  return packing;
}

} // namespace mergel::dem
