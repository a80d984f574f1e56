#include "dem/pairs/pair_sums.h"

#include "dem/math/lane_sum.h"
#include "dem/pairs/batch.h"

namespace mergel::dem {

namespace {

/// Adds a batch of pairs at a time.
class Sums {
public:
  Sums(PairSums& to, const PeriodicCell& cell, const Particles& p)
      : p_(p), cell_(cell), bonds_(to.bonds), contacts_(to.contacts), forces_(to.forces)
  {
  }

  template <IsBondLaw Law, IsContactLaw Contact>
  void add_bonded(const Law& law, const Contact& contact, const Bonds& bonds)
  {
    for (std::size_t first = 0; first < bonds.size(); first += n_lanes) {
      const Batch q(bonds.pairs, nullptr, first, bonds.size());
      const BondBlock& h = bonds.blocks[first / n_lanes];
      const Separation s = separation(q);
      const auto shape = bond_shape(section(law), min(s.R_i, s.R_j), s.inv_L);
      const EffectiveLoads<Lanes> load{shape.k_n * (s.gap - h.gap_0 - h.u_p), h.V, h.M,
                                       h.T};
      const Mask counts = counted(q, p_), lives = counts & (h.intact > Lanes{});
      bonds_.add(select(lives, h.intact * spring_energy(shape, load), Lanes{}));
      const Lanes size = h.intact * sqrt(load.N * load.N + dot(load.V, load.V));
      forces_.add(select(lives, 2.0 * size, Lanes{}));
      add_contact(contact, s, h.f_s, counts);
    }
  }

  template <IsContactLaw Contact>
  void add_others(const Contact& contact, const Contacts& contacts)
  {
    for (std::size_t first = 0; first < contacts.pairs.size(); first += n_lanes) {
      const Batch q(contacts.pairs, nullptr, first, contacts.pairs.size());
      Triple<Lanes> f_s{};
      for (int l = 0; l < q.count; ++l)
        set_lane(f_s, l, triple(contacts.shear[first + static_cast<std::size_t>(l)].f_s));
      add_contact(contact, separation(q), f_s, counted(q, p_));
    }
  }

private:
  struct Separation {
    Lanes R_i, R_j, inv_L; ///< radii [m], one over their sum [1/m]
    Lanes gap;             ///< [m]
    Lanes S;               ///< of the pair [-]
  };

  Separation separation(const Batch& q) const
  {
    const End<Lanes> i = gather(p_.state.data(), q, &Pair::i);
    End<Lanes> j = gather(p_.state.data(), q, &Pair::j);
    if (cell_.is_periodic()) shift_images(q, cell_, j.x);
    const Triple<Lanes> r = j.x - i.x;
    const Lanes L = i.R + j.R;
    return {i.R, j.R, 1.0 / L, sqrt(dot(r, r)) - L, 0.5 * (i.S + j.S)};
  }

  template <IsContactLaw Contact>
  void add_contact(const Contact& law, const Separation& s, const Triple<Lanes>& f_s,
                   const Mask& counts)
  {
    const Lanes overlap = activation_gap(law) * s.S - s.gap;
    const Mask closed = counts & (overlap > Lanes{});
    if (!any(closed)) return;
    const auto sides = sides_of_pair(s.R_i, s.R_j, s.inv_L);
    contacts_.add(
        select(closed, contact_energy(law, sides, overlap, dot(f_s, f_s)), Lanes{}));
    forces_.add(select(closed, 2.0 * normal_force(law, sides, overlap), Lanes{}));
  }

  const Particles& p_;
  const PeriodicCell& cell_;
  LaneEnergySum<Lanes> bonds_, contacts_;
  LaneSum<Lanes, 50> forces_;
};

} // namespace

PairSums sum_pairs(const PairMaterials& material, const PeriodicCell& cell,
                   const Particles& p, const Bonds& bonds, const Contacts& contacts)
{
  PairSums sums;
  {
    Sums all(sums, cell, p);
    std::visit(
        [&](const auto& bond, const auto& contact) {
          all.add_bonded(bond, contact, bonds);
          all.add_others(contact, contacts);
        },
        material.bond, material.contact);
  } // here the sums are complete
  return sums;
}

} // namespace mergel::dem
