#include "dem/element/controlled_pair.h"

#include "dem/particles/integrate.h"

#include <algorithm>
#include <array>

namespace mergel::dem {

namespace {

/// Time step of the imposed motion [s]; no law here depends on time.
constexpr double dt = 1.0;

ParticleState resting_particle(double x, double R, double S)
{
  ParticleState b;
  b.x = {x, 0.0, 0.0};
  b.R = R;
  b.S = S;
  b.m = 1.0; // imposed motion: never used
  return b;
}

} // namespace

ControlledPair::ControlledPair(const ControlledPairSpec& spec)
    : material_(spec.material), gap_0_(spec.gap_0),
      shape_(bond_shape(section(spec.material.bond), std::min(spec.R_i, spec.R_j),
                        1.0 / (spec.R_i + spec.R_j)))
{
  particles_.add(resting_particle(0.0, spec.R_i, spec.S));
  particles_.add(resting_particle(spec.R_i + spec.R_j + spec.gap_0, spec.R_j, spec.S));
  bonds_ = make_bonds(particles_, PeriodicCell{}, {{0, 1}});
}

void ControlledPair::move_to(const RelativeMotion& motion)
{
  ParticleState &i = particles_.state[0], &j = particles_.state[1];
  const double du_n = motion.u_n - at_.u_n, du_s = motion.u_s - at_.u_s,
               dtheta = motion.theta - at_.theta;
  const auto loads = [this] {
    const ControlledPairReading r = read();
    return std::array{r.N - r.f_n, r.V + r.f_s, r.M};
  };
  const auto before = loads();

  const double gap = gap_0_ + motion.u_n;
  j.x.x() = i.R + j.R + gap; // from gap_0, not step by step: no drift
  j.v.x() = du_n / dt;
  // Spins about z that move the contact points apart by du_s along y and rotate j by dtheta
  // relative to i:
  //   -(a_i w_i + a_j w_j) dt = du_s,   (w_j - w_i) dt = dtheta
  const double a_i = i.R + 0.5 * gap, a_j = j.R + 0.5 * gap;
  i.omega.z() = -(du_s + a_j * dtheta) / ((a_i + a_j) * dt);
  j.omega.z() = i.omega.z() + dtheta / dt;
  at_ = motion;

  clear_loads(particles_);
  add_bond_forces(material_, PeriodicCell{}, dt, particles_, bonds_, losses_);
  if (bonds_.intact(0) > 0.0) {
    const EffectiveLoads<double> q = effective_loads();
    u_p_ = {bonds_.blocks[0].u_p[0], at_.u_s - q.V.y / shape_.k_s,
            at_.theta - q.M.z / shape_.k_b};
  }

  const auto after = loads();
  const double moved[] = {du_n, du_s, dtheta};
  for (std::size_t k = 0; k < 3; ++k) work_ += 0.5 * (before[k] + after[k]) * moved[k];
}

EffectiveLoads<double> ControlledPair::effective_loads() const
{
  const BondBlock& b = bonds_.blocks[0];
  if (b.intact[0] == 0.0) return {};
  const ParticleState &i = particles_.state[0], &j = particles_.state[1];
  const double gap = (j.x - i.x).norm() - (i.R + j.R);
  return {shape_.k_n * (gap - b.gap_0[0] - b.u_p[0]), lane(b.V, 0), lane(b.M, 0), b.T[0]};
}

ControlledPairReading ControlledPair::read() const
{
  const PeriodicCell cell;
  const BondReading bond = read_bond(bonds_, 0, particles_, cell, material_.bond);
  const Vec3 f_s = contact_shear_of(bonds_, 0);
  const ContactReading contact =
      read_contact(bonds_.pairs[0], f_s, particles_, cell, material_.contact);
  const double f = std::visit(
      [this](const auto& law) { return yield_value(law, shape_, effective_loads()); },
      material_.bond);
  return {bond.N, bond.V.y(),  bond.M.z(),
          bond.D, contact.f_n, f_s.y(),
          f,      u_p_,        bond.energy + contact.energy};
}

double ControlledPair::dissipated() const
{
  return losses_.plastic.value() + losses_.breakage_release.value() + losses_.slip.value();
}

} // namespace mergel::dem
