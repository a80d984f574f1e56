/// Far-field contact: a linear spring with Coulomb friction that acts before the surfaces
/// of the particles touch.
///
///   active   gap < g_a          g_a = g_a1 (S_i + S_j)/2
///   normal   f_n = k_n (g_a - gap),   k_n = E pi r^2/L,  r = min(R_i, R_j), L = R_i + R_j
///   shear    f_s += k_s du_s,         k_s = k_n / kappa,    |f_s| <= mu f_n
///
/// Source: paper, section 2.1.2 and Table 1; the activation gap stands for irregular grains
/// and bond debris (Hentz et al. 2004). Against a wall r = R and L = R. See dem/README.md,
/// Far-field contact.
#pragma once

#include "dem/laws/contact_sides.h"
#include "dem/notation.h"

namespace mergel::dem {

struct LinearMaterial {
  static constexpr const char* name = "linear"; ///< name in case files and summaries

  double E = 0.0;     ///< effective modulus [Pa], > 0
  double kappa = 1.0; ///< normal-to-shear stiffness ratio [-], > 0
  double mu = 0.0;    ///< friction coefficient [-], >= 0
  double g_a = 0.0;   ///< activation gap at S = 1 [m], >= 0; scales with S, Eq. 8

  /// @throws InputError when out of range
  void check() const
  {
    require(E > 0.0, "contact modulus must be positive");
    require(kappa > 0.0, "contact stiffness ratio must be positive");
    require(mu >= 0.0, "contact friction must not be negative");
    require(g_a >= 0.0, "activation gap must not be negative");
  }
};

/// Modulus of the same grains at a rigid wall: only one side yields [Pa].
inline double modulus_at_rigid_wall(const LinearMaterial& c)
{
  return 2.0 * c.E;
}

/// The same without an activation gap: surfaces must touch.
inline LinearMaterial without_gap(LinearMaterial c)
{
  c.g_a = 0.0;
  return c;
}

/// Gap below which a contact acts, at S = 1 [m].
inline double activation_gap(const LinearMaterial& c)
{
  return c.g_a;
}

/// The same for every overlap.
template <class Real>
[[gnu::always_inline]] inline ContactStiffness<Real>
contact_stiffness(const LinearMaterial& c, const ContactSides<Real>& s, const Real&)
{
  const Real k_n = c.E * pi * s.r * s.r * s.inv_L;
  return {k_n, k_n * (1.0 / c.kappa)};
}

/// Normal force under an overlap g_a S - gap > 0 [N].
template <class Real>
Real normal_force(const LinearMaterial& c, const ContactSides<Real>& s, const Real& overlap)
{
  return contact_stiffness(c, s, overlap).k_n * overlap;
}

/// Stored by a contact of this overlap > 0 and shear force [J].
template <class Real>
Real contact_energy(const LinearMaterial& c, const ContactSides<Real>& s,
                    const Real& overlap, const Real& f_s_squared)
{
  const auto k = contact_stiffness(c, s, overlap);
  return 0.5 * (k.k_n * overlap * overlap + f_s_squared / k.k_s);
}

/// @param S upscaling ratio of the pair [-]
///
/// Where the contact slips, the loss is the work of the shear force (trapezoidal rule) less
/// the growth of the stored energy, (1-s)/(2 k_s) (f_old.f* + s f*^2) with s = mu f_n/|f*|.
/// A contact that opens loses the energy of its shear spring.
template <class Real>
[[gnu::always_inline]] inline ContactStep<Real>
contact_step(const LinearMaterial& c, const ContactSides<Real>& sides, const Real& S,
             const ContactMotion<Real>& by)
{
  const auto k = contact_stiffness(c, sides, by.gap);
  const Real g_a = c.g_a * S;
  const auto active = by.gap < g_a;
  ContactStep<Real> out;
  out.f_n = select(active, k.k_n * (g_a - by.gap), Real{});
  out.f_s = by.f_s_old + by.du_s * k.k_s;
  out.slip_loss = Real{};

  const Real f_max = c.mu * out.f_n;
  const Real trial2 = dot(out.f_s, out.f_s);
  const auto slides = trial2 > f_max * f_max; // an open contact has f_max = 0
  if (any(slides)) {
    const Real s = f_max / sqrt(select(slides, trial2, Real{} + 1.0));
    const Real compliance = 0.5 / k.k_s;
    const Real loss = (1.0 - s) * compliance * (dot(by.f_s_old, out.f_s) + s * trial2);
    const Real stored = dot(by.f_s_old, by.f_s_old) * compliance;
    out.slip_loss = select(slides, select(active, loss, stored), Real{});
    out.f_s = select(slides, out.f_s * s, out.f_s);
  }
  return out;
}

} // namespace mergel::dem
