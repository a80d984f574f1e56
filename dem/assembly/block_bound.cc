#include "dem/assembly/block_bound.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace mergel::dem {

namespace {

using Block = Eigen::Matrix<double, 6, 6>;

/// Sums over the springs of one particle, from which its block follows:
///
///   translation   sum k_s I + (k_n - k_s) n n
///   coupling      -[c]x with c = sum a k_s n
///   rotation      sum (k_s a^2 + k_b) I + (k_t - k_s a^2 - k_b) n n
struct BlockSums {
  double forces[6] = {}; ///< sum (k_n - k_s) n n: xx, yy, zz, xy, xz, yz
  double moments[6] = {};
  double c[3] = {};
  double k_s = 0.0, k_r = 0.0;

  /// @param n away from the particle
  void add(const Vec3& n, double a, double k_n, double shear, double k_b, double k_t)
  {
    const double nn[6] = {n.x() * n.x(), n.y() * n.y(), n.z() * n.z(),
                          n.x() * n.y(), n.x() * n.z(), n.y() * n.z()};
    const double bending = shear * a * a + k_b, f = k_n - shear, m = k_t - bending;
    for (int k = 0; k < 6; ++k) {
      forces[k] += f * nn[k];
      moments[k] += m * nn[k];
    }
    for (int k = 0; k < 3; ++k) c[k] += a * shear * n[k];
    k_s += shear;
    k_r += bending;
  }

  Block scaled(const Mobility& by) const
  {
    Block B;
    const auto square = [](const double(&s)[6], double add) {
      Mat3 a;
      a << s[0] + add, s[3], s[4], s[3], s[1] + add, s[5], s[4], s[5], s[2] + add;
      return a;
    };
    Mat3 coupling;
    coupling << 0.0, c[2], -c[1], -c[2], 0.0, c[0], c[1], -c[0], 0.0;
    B << square(forces, k_s), coupling, coupling.transpose(), square(moments, k_r);
    Eigen::Matrix<double, 6, 1> scale;
    scale << Vec3::Constant(by.translation), by.rotation;
    return scale.asDiagonal() * B * scale.asDiagonal();
  }
};

/// Springs of each particle; those to held walls with half their stiffness.
std::vector<BlockSums> sum_springs(const Assembly& assembly, const Springs& springs)
{
  std::vector<BlockSums> sums(assembly.particles.size());
  for (const PairSpring& k : springs.pairs) {
    sums[k.i].add(k.n, k.a_i, k.k_n, k.k_s, k.k_b, k.k_t);
    sums[k.j].add(-k.n, k.a_j, k.k_n, k.k_s, k.k_b, k.k_t);
  }
  for (const WallSpring& k : springs.walls) {
    const double share = k.wall == WallSpring::held ? 0.5 : 1.0;
    sums[k.particle].add(k.n, k.arm, share * k.k_n, share * k.k_s, 0.0, 0.0);
  }
  return sums;
}

/// Not below the largest eigenvalue of a symmetric matrix, by its trace and its norm: with
/// mean mu and variance s^2 of the n eigenvalues, lambda <= mu + s sqrt(n - 1) (Wolkowicz
/// and Styan 1980, Bounds for eigenvalues using traces, Linear Algebra Appl. 29, 471).
double quick_bound(const Block& B)
{
  const double mean = B.trace() / 6.0;
  const double variance = std::max(0.0, B.squaredNorm() / 6.0 - mean * mean);
  return mean + std::sqrt(5.0 * variance);
}

} // namespace

StiffestParticle block_bound(const Assembly& assembly, const Springs& springs)
{
  const std::vector<BlockSums> sums = sum_springs(assembly, springs);
  const std::vector<Mobility> mobility = mobilities(assembly);
  // The margin is above round-off, of which the root of a small variance makes 1e-8: a block
  // that is passed over is not the largest one, whatever the order in which ranks visit them.
  constexpr double margin = 1.0 + 1e-7;
  StiffestParticle most;
  const Particles& p = assembly.particles;
  p.for_owned([&](Index i) {
    const Block B = sums[i].scaled(mobility[i]);
    if (2.0 * quick_bound(B) * margin < most.omega2) return;
    const Eigen::SelfAdjointEigenSolver<Block> solved(B);
    const double omega2 = 2.0 * solved.eigenvalues()[5];
    if (omega2 > most.omega2)
      most = {omega2, p.id[i], p.state[i].S,
              solved.eigenvectors().col(5).tail<3>().squaredNorm()};
  });
  StiffestParticle of_all;
  for (const StiffestParticle& one :
       assembly.comm.gather(std::vector<StiffestParticle>{most}))
    if (one.omega2 > of_all.omega2 ||
        (one.omega2 == of_all.omega2 && one.omega2 > 0.0 && one.id < of_all.id))
      of_all = one;
  return of_all;
}

std::vector<double> block_bounds(const Assembly& assembly, const Springs& springs)
{
  const std::vector<BlockSums> sums = sum_springs(assembly, springs);
  const std::vector<Mobility> mobility = mobilities(assembly);
  std::vector<double> bounds(assembly.particles.size());
  assembly.particles.for_owned([&](Index i) {
    const Block B = sums[i].scaled(mobility[i]);
    bounds[i] =
        2.0 *
        Eigen::SelfAdjointEigenSolver<Block>(B, Eigen::EigenvaluesOnly).eigenvalues()[5];
  });
  return bounds;
}

} // namespace mergel::dem
