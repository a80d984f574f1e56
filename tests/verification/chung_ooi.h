/// The impacts of Chung & Ooi (2011): materials, one impact run by the kernel, and an
/// independent reference for it.
///
/// Source: Y.C. Chung and J.Y. Ooi, "Benchmark tests for verifying discrete element
/// modelling codes at particle impact level", Granular Matter 13 (2011) 643-656.
///
/// The numbers of tests 1 to 4 are from the scripts that come with YADE, those of 5, 7 and
/// 8 from PySPH, not from the article; test 6 has the solids, mu and spins of test 8.
///
/// Their contact is Hertz-Mindlin with a dashpot, ours a linear spring with friction alone.
/// Materials, radii, speeds, spins and friction are theirs. Differences:
/// - k_n makes the linear impact last as long as Hertz's at the test's normal speed. The
///   peak force is then 0.854 of Hertz's: his is 5/4 m* v^2/delta, ours pi m* v/T with
///   T = 2.943 delta/v.
/// - kappa = (2 - nu)/(2 (1 - nu)), Mindlin's ratio of normal to shear stiffness.
/// - There is no dashpot: e = 1 in tests 4 to 8, where they have 0.98, 1 or 0.5. Local
///   damping, which replaces the dashpot in test 3, would brake sliding and spin as well.
#pragma once

#include "tests/support/dem_scene.h"

#include "dem/walls/rigid_wall.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mergel::dem::test::chung_ooi {

struct Solid {
  double E, nu, rho; ///< [Pa], [-], [kg/m^3]
};
inline constexpr Solid glass{48e9, 0.20, 2800.0}, limestone{20e9, 0.25, 2500.0},
    aluminium{70e9, 0.33, 2700.0}, magnesium{40e9, 0.35, 1800.0},
    aluminium_oxide{380e9, 0.23, 4000.0}, cast_iron{100e9, 0.25, 7000.0},
    steel{208e9, 0.30, 7850.0}, polyethylene{1e9, 0.40, 1400.0}, nylon{2.5e9, 0.40, 1000.0},
    copper{120e9, 0.35, 8900.0};

/// A particle and its motion in the plane of the impact: n from i to j, t normal to it,
/// spin about n x t.
struct Ball {
  double R, rho;
  double v_n = 0.0, v_t = 0.0, spin = 0.0;

  double m() const { return sphere_mass(R, rho); }
  double inertia() const { return 0.4 * m() * R * R; }
};

/// Particle i collides with particle j, or with a rigid plane at rest.
struct Impact {
  Ball i;
  std::optional<Ball> j = std::nullopt;
  double k_n = 0.0, kappa = 1.0, mu = 0.0;

  double m_star() const { return j ? 1.0 / (1.0 / i.m() + 1.0 / j->m()) : i.m(); }
  double v_n() const { return i.v_n - (j ? j->v_n : 0.0); } ///< of approach
  double v_t() const { return i.v_t - (j ? j->v_t : 0.0); }
  /// Velocity of i relative to j at the contact point.
  double slip() const { return v_t() + i.R * i.spin + (j ? j->R * j->spin : 0.0); }
  double duration() const { return pi * std::sqrt(m_star() / k_n); }
  double peak_force() const { return v_n() * std::sqrt(m_star() * k_n); }
  double peak_overlap() const { return v_n() * std::sqrt(m_star() / k_n); }
};

/// Hertz impact: delta = (15 m* v^2/(16 E* sqrt(R*)))^(2/5),
/// T = 4 sqrt(pi) Gamma(2/5)/(5 Gamma(9/10)) delta/v (Johnson 1985, eq. 11.24).
inline double hertz_duration(double m_star, double R_star, double E_star, double v)
{
  const double delta =
      std::pow(15.0 * m_star * v * v / (16.0 * E_star * std::sqrt(R_star)), 0.4);
  return 0.8 * std::sqrt(pi) * std::tgamma(0.4) / std::tgamma(0.9) * delta / v;
}

inline double mindlin_kappa(const Solid& s)
{
  return (2.0 - s.nu) / (2.0 * (1.0 - s.nu));
}

/// An impact with the stiffness of the solid: two particles, or one at a rigid plane.
inline Impact impact_of(const Solid& s, double mu, const Ball& i,
                        const std::optional<Ball>& j = std::nullopt)
{
  Impact c{i, j};
  c.mu = mu;
  c.kappa = mindlin_kappa(s);
  const double E_star = s.E / (1.0 - s.nu * s.nu) * (j ? 0.5 : 1.0);
  const double R_star = j ? i.R * j->R / (i.R + j->R) : i.R;
  const double T = hertz_duration(c.m_star(), R_star, E_star, c.v_n());
  c.k_n = c.m_star() * (pi / T) * (pi / T);
  return c;
}

/// Motion of i relative to j after the impact, along the initial n and t, the spins, and
/// the energy lost to friction [J].
struct Rebound {
  double v_n, v_t, spin_i, spin_j, lost;
};

/// Largest difference of velocity and of R times spin over the speed of approach, and of
/// the loss over m* v_n (v_n + |slip|).
inline double difference(const Impact& c, const Rebound& a, const Rebound& b)
{
  const double spin_j = c.j ? c.j->R * std::abs(a.spin_j - b.spin_j) : 0.0;
  const double lost =
      std::abs(a.lost - b.lost) / (c.m_star() * (c.v_n() + std::abs(c.slip())));
  return std::max({std::abs(a.v_n - b.v_n), std::abs(a.v_t - b.v_t),
                   c.i.R * std::abs(a.spin_i - b.spin_i), spin_j, lost}) /
         c.v_n();
}

/// Steps per duration, steps from the start of the run to the first contact, local damping.
///
/// With a whole n the separation lies in its step where the first contact lay in its own,
/// and the leading error of the leapfrog cancels: measurements use a fractional n.
struct Resolution {
  double n = 200.37;
  double phase = 0.5;
  double damping = 0.0;
};

/// The plane of the impact in space.
struct Frame {
  Vec3 n, t;
  Vec3 z() const { return n.cross(t); }
};
inline Frame oblique_frame()
{
  return {Vec3(1, 2, 2) / 3.0, Vec3(2, 1, -2) / 3.0};
}
/// Local damping acts by component: it needs the normal along an axis.
inline Frame axis_frame()
{
  return {-Vec3::UnitZ(), Vec3::UnitX()};
}

/// The linear contact of the impact.
inline ContactLaw linear_law(const Impact& c)
{
  if (!c.j) return contact(c.k_n / (pi * c.i.R), c.kappa, c.mu, 0.0);
  const double r = std::min(c.i.R, c.j->R), L = c.i.R + c.j->R;
  return contact(c.k_n * L / (pi * r * r), c.kappa, c.mu, 0.0);
}

/// Runs the impact with the kernel, under any contact law, until the two have separated.
/// @param watch(t, gap, f) at each step: time since the first contact, gap, force on i
template <class Watch>
Rebound run(const Impact& c, const ContactLaw& law, const Frame& frame,
            const Resolution& how, Watch&& watch)
{
  const double dt = c.duration() / how.n, gap_0 = how.phase * dt * c.v_n();
  Scene s;
  s.motion.free_rotation = true;
  s.motion.damping = how.damping;
  const auto add = [&](const Ball& b, double x_n) {
    ParticleState& particle = s.p.state[s.p.add(sphere(x_n * frame.n, b.R, b.rho))];
    particle.v = b.v_n * frame.n + b.v_t * frame.t;
    particle.omega = b.spin * frame.z();
  };
  add(c.i, -c.i.R - gap_0);
  RigidWall plane = make_rigid_wall(Plane{-frame.n}, Vec3::Zero(), law);
  if (c.j) {
    add(*c.j, c.j->R);
    s.material.contact = law;
    s.add_contacts({{0, 1}});
  } else {
    rebuild_wall(plane, {}, s.p, c.i.R);
    s.add_more = [&](double step) { add_wall_forces(plane, {}, step, s.p, s.losses); };
  }
  const ParticleState& i = s.p.state[0];
  const auto gap = [&] {
    return c.j ? (s.p.state[1].x - i.x).norm() - c.i.R - c.j->R
               : closest_point(plane, i).gap;
  };
  bool has_touched = false;
  for (int k = 0; k < 100 * how.n; ++k) { // a damped rebound takes long, but ends
    s.forces(dt);
    watch((k - how.phase) * dt, gap(), s.p.load[0].f);
    if (gap() < 0.0) has_touched = true;
    if (has_touched && gap() > 0.0) break;
    kick(s.p, s.motion, dt, s.work);
    drift(s.p, dt);
  }
  const Vec3 v = c.j ? Vec3(i.v - s.p.state[1].v) : i.v;
  return {v.dot(frame.n), v.dot(frame.t), i.omega.dot(frame.z()),
          c.j ? s.p.state[1].omega.dot(frame.z()) : 0.0, s.losses.slip.value()};
}

template <class Watch>
Rebound run(const Impact& c, const Frame& frame, const Resolution& how, Watch&& watch)
{
  return run(c, linear_law(c), frame, how, watch);
}

inline Rebound run(const Impact& c, const Resolution& how = {})
{
  return run(c, oblique_frame(), how, [](double, double, const Vec3&) {});
}

/// The same impact as an ordinary differential equation, written without the kernel.
///
///   p' = -u,   u' = F/m*,   omega' = a f/I,   F = -f_n n + f t,   f_n = k_n delta
///   stick: f' = -k_s slip,   slide: f = +-mu f_n,   slip = u.t + a_i omega_i + a_j omega_j
///
/// p from i to j, u of i relative to j, lever arms a, which shrink with the overlap delta.
/// Sticking ends at |f| = mu f_n; sliding ends when the spring would follow the falling
/// limit, |slip| k_s = mu f_n' against f. Runge-Kutta of fourth order from event to event,
/// each found by bisection.
class Reference {
public:
  explicit Reference(const Impact& impact) : c(impact) {}

  /// @param n steps per duration; 1000 leave an error below 1e-11 of the speed of approach
  Rebound rebound(int n = 1000) const
  {
    State y;
    y << c.i.R + (c.j ? c.j->R : 0.0), 0.0, c.v_n(), c.v_t(), c.i.spin,
        c.j ? c.j->spin : 0.0, 0.0;
    const double energy_0 = energy(y);
    double way = 0.0; // sign of f while sliding, 0 while sticking
    if (c.k_n / c.kappa * std::abs(c.slip()) > c.mu * c.k_n * c.v_n())
      way = c.slip() > 0.0 ? -1.0 : 1.0;
    const double h = c.duration() / n;
    for (int k = 0; k < 10 * n; ++k) {
      const State next = advance(y, h, way);
      if (!is_over(next, way)) {
        y = next;
        continue;
      }
      double before = 0.0, after = h;
      for (int b = 0; b < 60; ++b) {
        const double middle = 0.5 * (before + after);
        (is_over(advance(y, middle, way), way) ? after : before) = middle;
      }
      y = advance(y, after, way);
      if (geometry(y).delta < 0.0) break;
      way = way != 0.0 ? 0.0 : std::copysign(1.0, y[6]);
    }
    return {y[2], y[3], y[4], y[5], energy_0 - energy(y)};
  }

private:
  using State = Eigen::Matrix<double, 7, 1>; // p, u, omega_i, omega_j, f
  struct Geometry {
    Eigen::Vector2d n, t;
    double delta, a_i, a_j;
  };

  Geometry geometry(const State& y) const
  {
    const Eigen::Vector2d p = y.head<2>();
    Geometry g;
    g.n = c.j ? Eigen::Vector2d(p.normalized()) : Eigen::Vector2d::UnitX();
    g.t = {-g.n.y(), g.n.x()};
    const double d = p.dot(g.n);
    g.delta = c.i.R + (c.j ? c.j->R : 0.0) - d;
    g.a_i = c.j ? c.i.R - 0.5 * g.delta : d;
    g.a_j = d - g.a_i;
    return g;
  }
  double energy(const State& y) const // kinetic, less that of the centre of mass
  {
    return 0.5 * (c.m_star() * y.segment<2>(2).squaredNorm() + c.i.inertia() * y[4] * y[4] +
                  (c.j ? c.j->inertia() * y[5] * y[5] : 0.0));
  }
  double slip(const State& y, const Geometry& g) const
  {
    return g.t.dot(y.segment<2>(2)) + g.a_i * y[4] + g.a_j * y[5];
  }
  State rate(const State& y, double way) const
  {
    const Geometry g = geometry(y);
    const double f_n = c.k_n * g.delta, f = way != 0.0 ? way * c.mu * f_n : y[6];
    State r;
    r.head<2>() = -y.segment<2>(2);
    r.segment<2>(2) = (f * g.t - f_n * g.n) / c.m_star();
    r[4] = g.a_i * f / c.i.inertia();
    r[5] = c.j ? g.a_j * f / c.j->inertia() : 0.0;
    r[6] = -c.k_n / c.kappa * slip(y, g);
    return r;
  }
  State advance(const State& y, double h, double way) const
  {
    const State k1 = rate(y, way), k2 = rate(y + 0.5 * h * k1, way);
    const State k3 = rate(y + 0.5 * h * k2, way), k4 = rate(y + h * k3, way);
    State next = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    if (way != 0.0) next[6] = way * c.mu * c.k_n * geometry(next).delta;
    return next;
  }
  bool is_over(const State& y, double way) const
  {
    const Geometry g = geometry(y);
    if (g.delta < 0.0) return true;
    if (way == 0.0) return std::abs(y[6]) > c.mu * c.k_n * g.delta;
    const double f_n_rate = c.k_n * g.n.dot(y.segment<2>(2));
    return -way * slip(y, g) * c.k_n / c.kappa < c.mu * f_n_rate;
  }

  Impact c;
};

} // namespace mergel::dem::test::chung_ooi
