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

#include "dem/error.h"
#include "dem/particles/kinematics.h"

namespace mergel::dem {

struct LinearMaterial {
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

/// Stiffnesses [N/m] of one contact.
template <class Real>
struct LinearStiffness {
  Real k_n, k_s;
};

/// @param r smaller radius [m]; @param inv_L one over the sum of radii [1/m]
template <class Real>
LinearStiffness<Real> linear_stiffness(const LinearMaterial& c, const Real& r,
                                       const Real& inv_L)
{
  const Real k_n = c.E * pi * r * r * inv_L;
  return {k_n, k_n * (1.0 / c.kappa)};
}

/// Result of one step of a contact.
template <class Real>
struct LinearContact {
  Real f_n;         ///< compression [N], >= 0
  Triple<Real> f_s; ///< shear force on i, the new history [N]
  Real slip_loss;   ///< energy lost to sliding in this step [J], >= 0
};

/// @param f_s_old shear force of the last step, rotated with the contact frame [N]
/// @param g_a     activation gap of this pair [m]
///
/// Where the contact slips, the loss is the work of the shear force (trapezoidal rule) less
/// the growth of the stored energy, (1-s)/(2 k_s) (f_old.f* + s f*^2) with s = mu f_n/|f*|.
/// A contact that opens loses the energy of its shear spring.
template <class Real>
[[gnu::always_inline]] inline LinearContact<Real>
linear_contact(const LinearMaterial& c, const LinearStiffness<Real>& k, const Real& gap,
               const Real& g_a, const Triple<Real>& du_s, const Triple<Real>& f_s_old)
{
  const auto active = gap < g_a;
  LinearContact<Real> out;
  out.f_n = select(active, k.k_n * (g_a - gap), Real{});
  out.f_s = f_s_old + du_s * k.k_s;
  out.slip_loss = Real{};

  const Real f_max = c.mu * out.f_n;
  const Real trial2 = dot(out.f_s, out.f_s);
  const auto slides = trial2 > f_max * f_max; // an open contact has f_max = 0
  if (any(slides)) {
    const Real s = f_max / sqrt(select(slides, trial2, Real{} + 1.0));
    const Real loss = (1.0 - s) * 0.5 / k.k_s * (dot(f_s_old, out.f_s) + s * trial2);
    const Real stored = dot(f_s_old, f_s_old) * 0.5 / k.k_s;
    out.slip_loss = select(slides, select(active, loss, stored), Real{});
    out.f_s = select(slides, out.f_s * s, out.f_s);
  }
  return out;
}

} // namespace mergel::dem
