/// The force of a pair, for a batch of pairs: what the laws say, apart from the loops that
/// call it (forces.cc).
#pragma once

#include "dem/laws/bond_step.h"
#include "dem/laws/contact_law.h"
#include "dem/math/lane_sum.h"
#include "dem/pairs/batch.h"
#include "dem/pairs/forces.h"
#include "dem/pairs/strength.h"

namespace mergel::dem {

/// The losses of a loop over pairs, with those of a batch at a time.
struct LoopLosses {
  explicit LoopLosses(PairLosses& of_rank) : all(of_rank) {}

  PairLosses& all;
  LaneEnergySum<Lanes> slip{all.slip};
  LaneEnergySum<Lanes> virial_x{all.virial.x}, virial_y{all.virial.y},
      virial_z{all.virial.z};
};

/// Force and moment on i; the opposite acts on j.
struct PairForce {
  Triple<Lanes> F; ///< at the contact point [N]
  Triple<Lanes> M; ///< [N m]
};

/// All bonds have the strengths of their law.
struct UniformStrengths {
  template <IsBondLaw Law>
  [[gnu::always_inline]] static Mask yields(const Law& law, const BondShape<Lanes>& shape,
                                            const EffectiveLoads<Lanes>& load, const Batch&,
                                            const Particles&)
  {
    return ~is_elastic(law, shape, load);
  }
  template <IsBondLaw Law>
  [[gnu::always_inline]] static const Law& of(const Law& law, const Particles&, Index,
                                              Index)
  {
    return law;
  }
};

/// Each bond has a factor f of its strengths; the loads are divided by f instead.
struct VariableStrengths {
  template <IsBondLaw Law>
  [[gnu::always_inline]] static Mask yields(const Law& law, const BondShape<Lanes>& shape,
                                            const EffectiveLoads<Lanes>& load,
                                            const Batch& q, const Particles& p)
  {
    Lanes f;
    for (int l = 0; l < n_lanes; ++l) f[l] = strength_between(p, q[l].i, q[l].j); // > 0
    return ~is_elastic(law, shape, load * (1.0 / f));
  }
  template <IsBondLaw Law>
  static Law of(const Law& law, const Particles& p, Index i, Index j)
  {
    return with_strengths_times(strength_between(p, i, j), law);
  }
};

/// Return the lanes whose trial is outside the yield surface, one at a time.
template <class Strengths, IsBondLaw Law>
void return_lanes(const Law& law, const BondShape<Lanes>& s, const Lanes& S,
                  const Mask& yields, const Batch& q, const EffectiveLoads<Lanes>& old,
                  EffectiveLoads<Lanes>& load, BondBlock& h, Particles& p,
                  PairLosses& losses)
{
  for (int l = 0; l < q.count; ++l) {
    if (!yields[l]) continue;
    const BondShape<double> shape{s.R_b[l], s.A[l], s.k_n[l], s.k_s[l], s.k_b[l], s.k_t[l]};
    const auto loads = [l](const EffectiveLoads<Lanes>& of) {
      return EffectiveLoads<double>{of.N[l], lane(of.V, l), lane(of.M, l), of.T[l]};
    };
    const bool counts = p.owns(q[l].i);
    EffectiveLoads<double> now = loads(load);
    BondState state{h.u_p[l], h.intact[l]};
    const BondChange change = bond_step(Strengths::of(law, p, q[l].i, q[l].j), shape, S[l],
                                        loads(old), now, state, counts ? &losses : nullptr);
    load.N[l] = now.N;
    set_lane(load.V, l, now.V);
    set_lane(load.M, l, now.M);
    load.T[l] = now.T;
    h.u_p[l] = state.u_p;
    h.intact[l] = state.intact;
    if (!change.breaks) continue;
    --p.n_bonds[q[l].i];
    --p.n_bonds[q[l].j];
    if (counts)
      losses.breakages.push_back(
          {q[l], 0.5 * (p.state[q[l].i].x + p.state[q[l].j].x), change.mode});
  }
}

/// The contact of a pair over the step: updates its shear force f_s and counts its slip. The
/// force on i is f_s - f_n n.
template <IsContactLaw Contact>
[[gnu::always_inline]] inline ContactStep<Lanes>
step_contact(const Contact& law, const Batch& q, const End<Lanes>& i, const End<Lanes>& j,
             const PairMotion<Lanes>& k, Triple<Lanes>& f_s, const Particles& p,
             LoopLosses& losses)
{
  const Lanes S = 0.5 * (i.S + j.S);
  const auto contact = contact_step(law, sides_of_pair(i.R, j.R, k.inv_L), S,
                                    {k.gap, k.du_n, k.du_s, rotated_with_contact(f_s, k)});
  f_s = contact.f_s;
  if (any(contact.slip_loss != Lanes{}))
    losses.slip.add(select(counted(q, p), contact.slip_loss, Lanes{}));
  return contact;
}

/// Bond and contact of a pair: updates the histories h of both.
template <class Strengths, IsBondLaw Law, IsContactLaw Contact>
[[gnu::always_inline]] inline PairForce
pair_force(const Law& bond, const Contact& beside, const Batch& q, const End<Lanes>& i,
           const End<Lanes>& j, const PairMotion<Lanes>& k, BondBlock& h, Particles& p,
           LoopLosses& losses)
{
  const Lanes r = min(i.R, j.R), S = 0.5 * (i.S + j.S);
  const BondShape<Lanes> shape = bond_shape(bond, r, k.inv_L);
  const Triple<Lanes> V = rotated_with_contact(h.V, k), M = rotated_with_contact(h.M, k);
  EffectiveLoads<Lanes> load{shape.k_n * (k.gap - h.gap_0 - h.u_p), V + k.du_s * shape.k_s,
                             M + k.dtheta * shape.k_b, h.T + k.dphi * shape.k_t};
  const Mask yields = Strengths::yields(bond, shape, load, q, p) & (h.intact > Lanes{});
  if (any(yields)) {
    const EffectiveLoads<Lanes> old{load.N - shape.k_n * k.du_n, V, M, h.T};
    return_lanes<Strengths>(bond, shape, S, yields, q, old, load, h, p, losses.all);
  }
  const Mask lives = h.intact > Lanes{};
  const Triple<Lanes> zero{};
  h.V = select(lives, load.V, zero);
  h.M = select(lives, load.M, zero);
  h.T = select(lives, load.T, Lanes{});

  const auto contact = step_contact(beside, q, i, j, k, h.f_s, p, losses);
  const Lanes N = select(lives, load.N, Lanes{});
  return {k.n * (h.intact * N - contact.f_n) + h.V * h.intact + contact.f_s,
          (h.M + k.n * h.T) * h.intact};
}

} // namespace mergel::dem
