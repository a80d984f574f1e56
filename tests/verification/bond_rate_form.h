/// The bond in rate form, integrated by small explicit steps: a reference that shares
/// nothing with the return mapping of the law but Eqs. 2-7 of the paper.
///
///   dq = k (du - Lambda dg/dq)          effective loads q = (N, V, M), elastic stiffness k
///   Lambda from f(q + dq) = 0           linearised at q: forward Euler, its drift
///                                       removed in the next step
///   ds = |du_n^p|/u_c + |du_s^p|/u_c + |dtheta^p|/theta_c,   du^p = du - dq/k
///   loads (1 - D) q,  D = 1 - exp(-s)
///
/// On the edge m = 0 the flow in M keeps M at zero, and f is the ellipse n^2 + v^2 = 1.
#pragma once

#include "tests/support/dem_scene.h"

namespace mergel::dem::test {

using Vec2 = Eigen::Vector2d;

/// Motion of one bond, or an increment of it; shear and bending in the plane of the bond.
struct BondMotion {
  double u_n = 0.0;          ///< [m]
  Vec2 u_s = Vec2::Zero();   ///< [m]
  Vec2 theta = Vec2::Zero(); ///< [rad]

  friend BondMotion operator*(double a, const BondMotion& u)
  {
    return {a * u.u_n, a * u.u_s, a * u.theta};
  }
};

/// True loads over the strengths of the intact bond, and the damage.
struct BondPoint {
  double n;
  Vec2 v, m;
  double D;
};

inline double distance(const BondPoint& a, const BondPoint& b)
{
  return std::max(
      {std::abs(a.n - b.n), (a.v - b.v).norm(), (a.m - b.m).norm(), std::abs(a.D - b.D)});
}

inline double worst(const std::vector<BondPoint>& a, const std::vector<BondPoint>& b)
{
  double d = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) d = std::max(d, distance(a[k], b[k]));
  return d;
}

/// One bond of the paper's Table 1 (R = 30 mm) with the given softening.
struct OneBond {
  DamageBond law = bond_of_table_1();
  BondShape<double> shape;

  OneBond(BendingFlow flow, double u_c, double theta_c)
  {
    law.flow = flow;
    law.u_c = u_c;
    law.theta_c = theta_c;
    law.D_broken = 1.0 - 1e-12;
    shape = bond_shape(law, 30e-3, 1.0 / 60e-3);
  }
  BondStrength strength(double N) const { return bond_strength(law, shape, N); }

  /// Motion that reaches each strength when it acts alone, times n, v, m.
  BondMotion motion(double n, const Vec2& v, const Vec2& m) const
  {
    const BondStrength q = strength(n);
    return {n * q.N / shape.k_n, v * (q.V / shape.k_s), m * (q.M / shape.k_b)};
  }
};

/// The law of dem/laws/bond.h, step by step.
class LawPath {
public:
  explicit LawPath(const OneBond& bond) : b_(bond) {}

  void step(const BondMotion& du)
  {
    const auto& s = b_.shape;
    u_n_ += du.u_n;
    const EffectiveLoads<double> trial{
        s.k_n * (u_n_ - state_.u_p),
        q_.V + triple({du.u_s.x() * s.k_s, du.u_s.y() * s.k_s, 0.0}),
        q_.M + triple({du.theta.x() * s.k_b, du.theta.y() * s.k_b, 0.0})};
    if (is_elastic(b_.law, s, trial)) {
      q_ = trial;
      return;
    }
    const BondReturn r = return_bond(b_.law, s, 1.0, state_, q_, trial);
    q_ = r.loads;
    state_ = r.state;
  }
  BondPoint at() const
  {
    const BondStrength y = b_.strength(q_.N);
    const double d = state_.intact;
    return {d * q_.N / y.N, Vec2(q_.V.x, q_.V.y) * (d / y.V),
            Vec2(q_.M.x, q_.M.y) * (d / y.M), 1.0 - d};
  }
  double s() const { return -std::log(state_.intact); }

private:
  const OneBond& b_;
  double u_n_ = 0.0;
  EffectiveLoads<double> q_{};
  BondState state_;
};

/// The rate form, by explicit steps.
class RateForm {
public:
  explicit RateForm(const OneBond& bond) : b_(bond) {}

  void step(const BondMotion& du)
  {
    const auto& k = b_.shape;
    const Loads trial{q_.N + k.k_n * du.u_n, q_.V + k.k_s * du.u_s,
                      q_.M + k.k_b * du.theta};
    const Loads before = q_;
    q_ = yield(trial) <= 0.0 ? trial : flow(trial, du);
    const double du_n = du.u_n - (q_.N - before.N) / k.k_n;
    const Vec2 du_s = du.u_s - (q_.V - before.V) / k.k_s;
    const Vec2 dtheta = du.theta - (q_.M - before.M) / k.k_b;
    s_ += (std::abs(du_n) + du_s.norm()) / b_.law.u_c + dtheta.norm() / b_.law.theta_c;
  }
  BondPoint at() const
  {
    const BondStrength y = b_.strength(q_.N);
    const double d = std::exp(-s_);
    return {d * q_.N / y.N, d / y.V * q_.V, d / y.M * q_.M, 1.0 - d};
  }
  double s() const { return s_; }

private:
  struct Loads {
    double N = 0.0;
    Vec2 V = Vec2::Zero(), M = Vec2::Zero();
  };

  /// v^2/(1-n^2), the slope parameter of Eq. 5; 1 on the edge m = 0.
  static double h_of(double n2, double v2)
  {
    return v2 > 0.0 ? std::min(1.0, v2 / std::max(1.0 - n2, 1e-300)) : 0.0;
  }

  /// Eq. 5 with m to the power 1, and beyond its ellipse the ellipse.
  double yield(const Loads& q) const
  {
    const BondStrength y = b_.strength(q.N);
    const double n2 = std::pow(q.N / y.N, 2), v2 = std::pow(q.V.norm() / y.V, 2);
    const double m = q.M.norm() / y.M;
    if (n2 + v2 >= 1.0) return m + 2.0 * (n2 + v2 - 1.0);
    return m + n2 + v2 * h_of(n2, v2) - 1.0;
  }

  /// From q_, which lies on the surface or just inside of it.
  Loads flow(const Loads& trial, const BondMotion& du) const
  {
    const auto& k = b_.shape;
    const BondStrength y = b_.strength(q_.N);
    // Eq. 7: dtheta^p = Lambda dg/dM, or Lambda dg/d(M/R_b) = Lambda R_b dg/dM
    const double k_flow = b_.law.flow == BendingFlow::conjugate ? k.k_b : k.k_b * k.R_b;
    const double n = q_.N / y.N, v2 = q_.V.squaredNorm() / (y.V * y.V);
    const Vec2 along = q_.M.norm() > 0.0
                           ? q_.M.normalized()
                           : (trial.M.norm() > 0.0 ? trial.M.normalized() : Vec2(0.0, 0.0));
    // with a gradient g: Lambda = (f + g.k du)/(g.k g)
    const auto flowed = [&](double h, bool m_flows) {
      const double g_N = 2.0 * n * (1.0 + h * h) / y.N;
      const Vec2 g_V = 4.0 * h / (y.V * y.V) * q_.V;
      const Vec2 g_M = m_flows ? Vec2(along / y.M) : Vec2(0.0, 0.0);
      const double f = m_flows ? yield(q_) : 2.0 * (n * n + v2 - 1.0);
      const double rate =
          g_N * k.k_n * du.u_n + k.k_s * g_V.dot(du.u_s) + k.k_b * g_M.dot(du.theta);
      const double gkg =
          g_N * k.k_n * g_N + k.k_s * g_V.squaredNorm() + k_flow * g_M.squaredNorm();
      const double lambda = std::max(0.0, (f + rate) / gkg);
      Loads out{trial.N - lambda * k.k_n * g_N, trial.V - lambda * k.k_s * g_V, trial.M};
      const double m = trial.M.norm(), spent = lambda * k_flow / y.M;
      out.M = m > spent ? Vec2(trial.M * (1.0 - spent / m)) : Vec2(0.0, 0.0);
      return out;
    };
    const Loads q = flowed(h_of(n * n, v2), true);
    return q.M == Vec2::Zero() ? flowed(1.0, false) : q;
  }

  const OneBond& b_;
  Loads q_;
  double s_ = 0.0;
};

constexpr int n_checks = 20; ///< times on each stage at which states are compared

/// Appends the states of `at` along one straight stage, with n steps between two of them.
template <class Integrator>
void follow_stage(Integrator& at, const BondMotion& stage, int n,
                  std::vector<BondPoint>& states)
{
  const BondMotion du = (1.0 / (n_checks * n)) * stage;
  for (int step = 1; step <= n_checks * n; ++step) {
    at.step(du);
    if (step % n == 0) states.push_back(at.at());
  }
}

} // namespace mergel::dem::test
