/// The force of a contact with several features of a surface (dem/README.md, Walls).
#pragma once

#include "dem/walls/patch_features.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mergel::dem {

/// A feature of the contact at hand, and what acts there.
struct ActingFeature {
  const PatchFeature* feature;
  Vec3 v;                    ///< of the wall there [m/s]
  double f_n = 0.0;          ///< its normal force; negative for a saddle [N]
  Vec3 force = Vec3::Zero(); ///< on the particle [N]
};

/// Normal forces of all features, each along its own normal, and the one contact that has their
/// energy.
struct FeatureSums {
  const PatchFeature* nearest = nullptr;
  Vec3 pressure = Vec3::Zero(); ///< sum of the normal forces, towards the wall [N]
  Vec3 x = Vec3::Zero();        ///< where the shear force acts [m]
  Vec3 v = Vec3::Zero();        ///< velocity of the wall there [m/s]
  double energy = 0.0;          ///< of all [J]; negative where saddles prevail
  double overlap = 0.0;         ///< that has this energy, by its size [m]
  double all = 0.0,
         at_nearest = 0.0; ///< shares of the shear force: f_n/all, and more there
};

/// Set f_n of each feature. @pre there is one; overlaps are positive
template <class Law>
FeatureSums sum_features(const Law& law, std::vector<ActingFeature>& acting, double R)
{
  const ContactSides<double> sides = sides_at_wall(R);
  const ActingFeature& nearest =
      *std::max_element(acting.begin(), acting.end(), [](const auto& a, const auto& b) {
        return a.feature->overlap < b.feature->overlap;
      });
  const double overlap = nearest.feature->overlap;
  const double f_nearest = normal_force(law, sides, overlap),
               e_nearest = contact_energy(law, sides, overlap, 0.0);
  FeatureSums sums;
  sums.nearest = nearest.feature;
  double pressing = 0.0;
  for (ActingFeature& a : acting) {
    const PatchFeature& f = *a.feature;
    a.f_n = f.sign * normal_force(law, sides, f.overlap);
    sums.pressure += a.f_n * f.n;
    sums.energy += f.sign * contact_energy(law, sides, f.overlap, 0.0);
    pressing += a.f_n;
    sums.x += a.f_n * f.point;
    sums.v += a.f_n * a.v;
  }
  // What presses in all is at least the force of the nearest feature, but where the particle
  // bridges several pits: there the nearest one makes up for it.
  sums.all = std::max(pressing, f_nearest);
  sums.at_nearest = 1.0 - pressing / sums.all;
  sums.x = sums.x / sums.all + sums.at_nearest * nearest.feature->point;
  sums.v = sums.v / sums.all + sums.at_nearest * nearest.v;
  // The energy of a law grows with a power of the overlap: f_n overlap/energy.
  const double power = f_nearest * overlap / e_nearest;
  sums.overlap = overlap * std::pow(std::abs(sums.energy) / e_nearest, 1.0 / power);
  return sums;
}

/// Set the force of each feature. @param f_s shear force of all [N]
inline void share_forces(std::vector<ActingFeature>& acting, const FeatureSums& sums,
                         const Vec3& f_s)
{
  for (ActingFeature& a : acting) {
    a.force = a.f_n / sums.all * f_s - a.f_n * a.feature->n;
    if (a.feature == sums.nearest) a.force += sums.at_nearest * f_s;
  }
}

/// For one feature this is the contact law.
template <IsContactLaw Law>
void step_shear(const Law& law, const FeatureSums& sums, double dt,
                const ParticleState& particle, WallContact& contact, PairLosses& losses)
{
  const ContactSides<double> sides = sides_at_wall(particle.R);
  const double size = sums.pressure.norm();
  const WallPoint<double> at{
      triple(size > 0.0 ? Vec3(sums.pressure / size) : sums.nearest->n),
      activation_gap(law) * particle.S - sums.overlap, triple(sums.x), triple(sums.v)};
  ContactMotion<double> by = motion_at_wall(end_of(particle), at, triple(contact.f_s), dt);
  by.du_n = contact.overlap - sums.overlap;
  Law bounded = law;
  bounded.mu *= size / normal_force(law, sides, sums.overlap);
  const ContactStep<double> now = contact_step(bounded, sides, particle.S, by);
  if (now.slip_loss != 0.0) losses.slip.add(now.slip_loss);
  contact.f_s = vec3(now.f_s);
  contact.overlap = sums.overlap;
}

/// Add the force of the features to the particle, set that of each, and update the history over
/// the step dt [s]. Their resultant bounds the one shear force, whose spring has the overlap
/// that has their energy.
template <IsContactLaw Law>
void add_feature_forces(const Law& law, std::vector<ActingFeature>& acting, double dt,
                        const ParticleState& particle, Load& load, WallContact& contact,
                        PairLosses& losses)
{
  const FeatureSums sums = sum_features(law, acting, particle.R);
  if (sums.energy > 0.0)
    step_shear(law, sums, dt, particle, contact, losses);
  else {
    open_contact(law, particle.R, contact, losses);
    contact.overlap = -sums.overlap;
  }
  load.t += (sums.x - particle.x).cross(contact.f_s); // normals pass through the centre
  share_forces(acting, sums, contact.f_s);
  for (const ActingFeature& a : acting) load.f += a.force;
}

} // namespace mergel::dem
