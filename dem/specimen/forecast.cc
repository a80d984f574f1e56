#include "dem/specimen/forecast.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

namespace {

/// The largest squared frequency over that of the shell with its neighbours held: neighbours
/// move too, translation and spin are coupled, and some particle of a specimen has more springs.
/// Measured on pile_small and pile_paper (steps of 7.3e-8 and 3.5e-8 s): 3.9 and 4.3.
constexpr double shell_to_largest = 4.0;

/// Mean of S^-3 over the volume [-].
double mean_inverse_cube(const SpecimenSpec& s)
{
  const auto inverse_cube = [](double S) { return 1.0 / (S * S * S); };
  if (s.scale.S_inner == s.scale.S_outer) return inverse_cube(s.scale.S_inner);
  const Bounds box = bounds(s.region);
  const double R = box.high.x(); // a box has one S
  constexpr int n_rings = 2000;
  double sum = 0.0;
  for (int k = 0; k < n_rings; ++k) {
    const double t = (k + 0.5) / n_rings; // of the radius
    sum += 2.0 * t * inverse_cube(s.scale.at(t * R)) / n_rings;
  }
  return sum;
}

} // namespace

double expected_particles(const SpecimenSpec& s)
{
  return (1.0 - s.porosity) * volume(s.region) * mean_inverse_cube(s) /
         (pi / 6.0 * s.sizes.mean_cube()); // > 0
}

double estimated_stable_step(const SpecimenSpec& s, const PairMaterials& material,
                             double inertia_factor)
{
  const double S = std::min(s.scale.S_inner, s.scale.S_outer);
  const double R = 0.5 * S * s.sizes.smallest();
  const double R_mean = 0.5 * S * std::cbrt(s.sizes.mean_cube());
  const double Z = s.coordination > 0.0 ? s.coordination : granular_coordination;
  const ContactStiffness<double> contact =
      contact_stiffness(material.contact, sides_of_pair(R, R_mean), estimated_overlap * R);
  double k_n = contact.k_n, k_s = contact.k_s, k_b = 0.0, k_t = 0.0;
  if (s.coordination > 0.0) {
    const BondShape<double> bond =
        bond_shape(section(material.bond), R, 1.0 / (R + R_mean));
    k_n += bond.k_n;
    k_s += bond.k_s;
    k_b = bond.k_b;
    k_t = bond.k_t;
  }
  const double m = sphere_mass(R, s.rho), I = 0.4 * m * R * R * inertia_factor;
  const double translation = Z * (k_n + 2.0 * k_s) / (3.0 * m);
  const double rotation = Z * (2.0 * (k_s * R * R + k_b) + k_t) / (3.0 * I);
  return 2.0 / std::sqrt(shell_to_largest * std::max(translation, rotation));
}

} // namespace mergel::dem
