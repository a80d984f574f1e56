/// Hertz-Mindlin contact: the elastic contact of spheres, with Coulomb friction.
///
///   active   overlap d > 0
///   normal   f_n = 4/3 E* sqrt(R* d) d
///   shear    f_s += k_s du_s,   k_s = 8 G* sqrt(R* d),   |f_s| <= mu f_n
///   sides    of one material: E* = E/(2 (1 - nu^2)), G* = E/(4 (1 + nu)(2 - nu)),
///            R* = R_i R_j/(R_i + R_j); against a rigid wall E* and G* are twice that and
///            R* = R
///
/// Sources: Hertz (1882); Mindlin (1949), J. Appl.
/// Mech. 16, 259, for k_s without slip. Where the overlap falls, f_s falls with k_s, so that
/// no energy is made (Thornton, Cummins and Cleary 2013, An investigation of the comparative
/// behaviour of alternative contact force models during inelastic collisions, Powder
/// Technol. 233, 30). There is no activation gap, and partial slip is left out. See
/// dem/laws/README.md, Hertz-Mindlin contact.
#pragma once

#include "dem/laws/contact_sides.h"
#include "dem/notation.h"

#include <cmath>

namespace mergel::dem {

struct HertzMaterial {
  static constexpr const char* name = "hertz"; ///< name in case files and summaries

  double E = 0.0;  ///< Young's modulus of the grains [Pa], > 0
  double nu = 0.0; ///< Poisson's ratio of the grains [-], from 0 to 0.5
  double mu = 0.0; ///< friction coefficient [-], >= 0

  /// @throws InputError when out of range
  void check() const
  {
    require(E > 0.0, "Young's modulus of the contact must be positive");
    require(nu >= 0.0 && nu <= 0.5, "Poisson's ratio of the contact must be from 0 to 0.5");
    require(mu >= 0.0, "contact friction must not be negative");
  }
  double E_star(double n_elastic) const { return E / (1.0 - nu * nu) / n_elastic; }
  double G_star(double n_elastic) const
  {
    return 0.5 * E / ((1.0 + nu) * (2.0 - nu)) / n_elastic;
  }
};

/// That of the grains: a wall is rigid by the law itself.
inline double modulus_at_rigid_wall(const HertzMaterial& c)
{
  return c.E;
}

inline HertzMaterial without_gap(const HertzMaterial& c)
{
  return c;
}

inline double activation_gap(const HertzMaterial&)
{
  return 0.0;
}

/// Tangent stiffness at an overlap >= 0 [m].
template <class Real>
[[gnu::always_inline]] inline ContactStiffness<Real>
contact_stiffness(const HertzMaterial& c, const ContactSides<Real>& s, const Real& overlap)
{
  const Real a = sqrt(s.R_star * overlap); // radius of the contact area
  return {2.0 * c.E_star(s.n_elastic) * a, 8.0 * c.G_star(s.n_elastic) * a};
}

template <class Real>
Real normal_force(const HertzMaterial& c, const ContactSides<Real>& s, const Real& overlap)
{
  return 2.0 / 3.0 * contact_stiffness(c, s, overlap).k_n * overlap;
}

template <class Real>
Real contact_energy(const HertzMaterial& c, const ContactSides<Real>& s,
                    const Real& overlap, const Real& f_s_squared)
{
  const auto k = contact_stiffness(c, s, overlap);
  return 4.0 / 15.0 * k.k_n * overlap * overlap + 0.5 * f_s_squared / k.k_s;
}

/// The loss is the work of the shear force (trapezoidal rule) less the growth of
/// f_s^2/(2 k_s): by sliding, by a k_s that changes under f_s, and by opening.
template <class Real>
[[gnu::always_inline]] inline ContactStep<Real>
contact_step(const HertzMaterial& c, const ContactSides<Real>& sides, const Real&,
             const ContactMotion<Real>& by)
{
  const auto active = by.gap < Real{};
  const Real overlap = select(active, -by.gap, Real{});
  const Real before = by.du_n - by.gap; // overlap at the start of the step
  const auto was_active = before > Real{};
  const auto k = contact_stiffness(c, sides, overlap);
  // Where rounding leaves none, a force that is there had some overlap, however small.
  const Real tiny = sides.R_star * 1e-9;
  const Real known = select(was_active, before, overlap);
  const auto k_before = contact_stiffness(c, sides, select(known > tiny, known, tiny));
  const Real one = Real{} + 1.0;
  const Real k_s = select(active, k.k_s, one), k_s_before = k_before.k_s;

  ContactStep<Real> out;
  out.f_n = 2.0 / 3.0 * k.k_n * overlap;
  const Triple<Real> kept = by.f_s_old * min(one, k.k_s / k_s_before);
  const Triple<Real> trial = kept + by.du_s * k.k_s;
  const Real f_max = c.mu * out.f_n;
  const Real trial2 = dot(trial, trial);
  const auto slides = trial2 > f_max * f_max;
  out.f_s = select(slides, trial * (f_max / sqrt(select(slides, trial2, one))), trial);
  const Real work = select(active, 0.5 * dot(by.f_s_old + out.f_s, by.du_s), Real{});
  out.slip_loss = work - 0.5 * dot(out.f_s, out.f_s) / k_s +
                  0.5 * dot(by.f_s_old, by.f_s_old) / k_s_before;
  return out;
}

} // namespace mergel::dem
