#include "dem/assembly/largest_frequency.h"

#include "dem/math/random.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace mergel::dem {

namespace {

/// Translation and rotation of one particle.
struct Motion6 {
  Vec3 u = Vec3::Zero(), theta = Vec3::Zero();

  double dot(const Motion6& b) const { return u.dot(b.u) + theta.dot(b.theta); }
};

/// A vector of the iteration: amplitudes M^1/2 u of owned particles, and of the system of
/// the walls.
struct Amplitudes {
  std::vector<Motion6> particles;
  std::vector<double> walls;
};

using DotSum = ExactSum<80>; // terms are of order 1, and must be below 2^20

/// The linear system M^-1/2 K M^-1/2 over a scale. Masses are in units of the largest
/// one, so that the exact sums of nodal forces keep their digits.
class LinearSystem {
public:
  LinearSystem(const Assembly& assembly, const Springs& springs, double omega2_scale,
               const WallSystem* system)
      : assembly_(assembly), springs_(springs), scale_(omega2_scale),
        system_(system && system->size() > 0 ? system : nullptr),
        mobility_(mobilities(assembly)), moved_(assembly.particles),
        ghosts_(assembly.ghosts)
  {
    double heaviest = 0.0;
    moved_.for_owned([&](Index i) { heaviest = std::max(heaviest, moved_.state[i].m); });
    root_m_ = std::sqrt(assembly.comm.global_max(heaviest));
    if (root_m_ == 0.0) root_m_ = 1.0; // no particles
    for (Mobility& m : mobility_) {
      m.translation *= root_m_;
      m.rotation *= root_m_;
    }
    if (system_) scale_ = std::max(scale_, frequency2_of_walls());
    per_scale_ = 1.0 / (scale_ * root_m_ * root_m_);
    if (!system_) return;
    for (const Wall& w : assembly.walls) {
      u_nodes_.emplace_back(w.x.size(), Vec3::Zero());
      f_nodes_.emplace_back(w.x.size());
    }
  }

  double scale() const { return scale_; }

  Amplitudes start() const
  {
    Amplitudes y = zero();
    constexpr std::uint64_t seed = 0x6d65726765; // any
    const auto draw = [](std::uint64_t id, std::uint64_t k) {
      return 2.0 * uniform(seed, id, k) - 1.0;
    };
    moved_.for_owned([&](Index i) {
      const std::uint64_t id = moved_.id[i];
      y.particles[i] = {{draw(id, 0), draw(id, 1), draw(id, 2)},
                        {draw(id, 3), draw(id, 4), draw(id, 5)}};
    });
    for (std::size_t k = 0; k < y.walls.size(); ++k) y.walls[k] = draw(k, 6);
    return y;
  }

  Amplitudes zero() const
  {
    return {std::vector<Motion6>(moved_.size()),
            std::vector<double>(system_ ? system_->size() : 0)};
  }

  double dot(const Amplitudes& a, const Amplitudes& b) const
  {
    DotSum sum;
    moved_.for_owned([&](Index i) { sum.add(a.particles[i].dot(b.particles[i])); });
    ExactReduction all;
    all.add(sum);
    all.run(assembly_.comm);
    double of_walls = 0.0;
    for (std::size_t k = 0; k < a.walls.size(); ++k) of_walls += a.walls[k] * b.walls[k];
    return sum.value() + of_walls;
  }

  /// to += factor * a
  void add(double factor, const Amplitudes& a, Amplitudes& to) const
  {
    moved_.for_owned([&](Index i) {
      to.particles[i].u += factor * a.particles[i].u;
      to.particles[i].theta += factor * a.particles[i].theta;
    });
    for (std::size_t k = 0; k < a.walls.size(); ++k) to.walls[k] += factor * a.walls[k];
  }

  void scale(double factor, Amplitudes& a) const
  {
    moved_.for_owned([&](Index i) {
      a.particles[i].u *= factor;
      a.particles[i].theta *= factor;
    });
    for (double& y : a.walls) y *= factor;
  }

  Amplitudes product(const Amplitudes& y)
  {
    moved_.for_owned([&](Index i) { // the motions travel to ghosts as velocities
      moved_.state[i].v = mobility_[i].translation * y.particles[i].u;
      moved_.state[i].omega = mobility_[i].rotation.cwiseProduct(y.particles[i].theta);
    });
    ghosts_.update(moved_, assembly_.comm);
    clear_loads(moved_);
    for (const PairSpring& k : springs_.pairs) add(k);
    if (system_) {
      system_->move(y.walls, u_nodes_);
      for (auto& wall : u_nodes_)
        for (Vec3& u : wall) u *= root_m_;
      for (auto& wall : f_nodes_)
        for (VectorSum& f : wall) f.clear();
    }
    for (const WallSpring& k : springs_.walls) add(k);

    Amplitudes z = zero();
    moved_.for_owned([&](Index i) {
      const Load& load = moved_.load[i];
      z.particles[i] = {per_scale_ * mobility_[i].translation * load.f,
                        per_scale_ * mobility_[i].rotation.cwiseProduct(load.t)};
    });
    if (system_) multiply_system(y, z);
    return z;
  }

private:
  /// Squared frequency of the system of the walls by itself, within a factor of two or so:
  /// a few steps of a power iteration [1/s^2].
  double frequency2_of_walls() const
  {
    constexpr int n_steps = 10;
    std::vector<std::vector<Vec3>> no_force;
    for (const Wall& w : assembly_.walls) no_force.emplace_back(w.x.size(), Vec3::Zero());
    std::vector<double> y = start().walls, z(y.size());
    const auto length = [](const std::vector<double>& a) {
      double squares = 0.0;
      for (const double x : a) squares += x * x;
      return std::sqrt(squares);
    };
    double omega2 = 0.0;
    for (int k = 0; k < n_steps; ++k) {
      system_->multiply(y, no_force, z);
      const double of_y = length(y), of_z = length(z);
      if (!(of_z > 0.0)) return 0.0;
      omega2 = of_z / of_y;
      for (std::size_t a = 0; a < y.size(); ++a) y[a] = z[a] / of_z;
    }
    return omega2;
  }

  void add(const PairSpring& k)
  {
    const ParticleState &i = moved_.state[k.i], &j = moved_.state[k.j];
    const Vec3 u = j.v - i.v, bend = j.omega - i.omega;
    const double u_n = u.dot(k.n), twist = bend.dot(k.n);
    const Vec3 u_s = u - u_n * k.n - (k.a_i * i.omega + k.a_j * j.omega).cross(k.n);
    const Vec3 f = k.k_n * u_n * k.n + k.k_s * u_s;
    const Vec3 turn = k.k_s * k.n.cross(u_s);
    const Vec3 m = k.k_b * (bend - twist * k.n) + k.k_t * twist * k.n;
    Load &on_i = moved_.load[k.i], &on_j = moved_.load[k.j];
    on_i.f -= f;
    on_j.f += f;
    on_i.t -= k.a_i * turn + m;
    on_j.t -= k.a_j * turn - m;
  }

  void add(const WallSpring& k)
  {
    const bool is_held = !system_ || k.wall == WallSpring::held;
    const ParticleState& i = moved_.state[k.particle];
    Vec3 u = -i.v;
    if (!is_held) u += at(u_nodes_[k.wall], assembly_.walls[k.wall].topology, k.at);
    const double u_n = u.dot(k.n);
    const Vec3 u_s = u - u_n * k.n - k.arm * i.omega.cross(k.n);
    const Vec3 f = k.k_n * u_n * k.n + k.k_s * u_s;
    moved_.load[k.particle].f -= f;
    moved_.load[k.particle].t -= k.arm * k.k_s * k.n.cross(u_s);
    if (is_held) return;
    const Triangle& t = assembly_.walls[k.wall].topology.triangles[uz(k.at.triangle)];
    for (int c = 0; c < 3; ++c)
      f_nodes_[k.wall][uz(t[uz(c)])].add(per_scale_ * k.at.weight[c] * f);
  }

  void multiply_system(const Amplitudes& y, Amplitudes& z)
  {
    ExactReduction all;
    for (auto& wall : f_nodes_) all.add(wall);
    all.run(assembly_.comm);
    std::vector<std::vector<Vec3>> f;
    for (const auto& wall : f_nodes_) {
      f.emplace_back();
      for (const VectorSum& node : wall)
        f.back().push_back(scale_ * root_m_ * node.value());
    }
    system_->multiply(y.walls, f, z.walls);
    for (double& a : z.walls) a /= scale_;
  }

  const Assembly& assembly_;
  const Springs& springs_;
  double scale_;
  const WallSystem* system_;
  std::vector<Mobility> mobility_; ///< in units of the largest mass
  double root_m_ = 0.0;            ///< of the largest mass [kg^1/2]
  double per_scale_ = 0.0;         ///< 1/(scale root_m^2) [s^2/kg]
  Particles moved_; ///< velocities and spins are the motions, loads resist them
  Ghosts ghosts_;
  std::vector<std::vector<Vec3>> u_nodes_;
  std::vector<std::vector<VectorSum>> f_nodes_; ///< over omega2_scale and the largest mass
};

double largest_eigenvalue(const std::vector<double>& diagonal,
                          const std::vector<double>& beside)
{
  const auto n = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), n),
                                Eigen::Map<const Eigen::VectorXd>(beside.data(), n - 1),
                                Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[n - 1];
}

} // namespace

double largest_frequency2(const Assembly& assembly, const Springs& springs,
                          double omega2_scale, const WallSystem* system)
{
  constexpr int most_products = 60;
  constexpr double small_rise = 1e-4;
  constexpr double nothing = 1e-8; // far above the quantum of the exact sums
  LinearSystem A(assembly, springs, omega2_scale, system);
  Amplitudes q = A.start(), before = A.zero();
  const double length = std::sqrt(A.dot(q, q));
  if (length == 0.0) return 0.0; // no particles
  A.scale(1.0 / length, q);

  std::vector<double> diagonal, beside;
  double largest = 0.0;
  for (int k = 1; k <= most_products; ++k) {
    Amplitudes w = A.product(q);
    if (k > 1) A.add(-beside.back(), before, w);
    diagonal.push_back(A.dot(w, q));
    A.add(-diagonal.back(), q, w);
    const double beta = std::sqrt(A.dot(w, w));
    const bool is_last = beta <= nothing || k == most_products;
    if (k % 2 == 0 || is_last) {
      const double now = largest_eigenvalue(diagonal, beside);
      const bool has_settled = now - largest <= small_rise * now;
      largest = now;
      if (has_settled || is_last) break;
    }
    beside.push_back(beta);
    A.scale(1.0 / beta, w);
    before = std::move(q);
    q = std::move(w);
  }
  return A.scale() * std::max(0.0, largest);
}

} // namespace mergel::dem
