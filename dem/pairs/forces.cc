#include "dem/pairs/forces.h"

#include "dem/pairs/pair_force.h"

namespace mergel::dem {

namespace {

/// Not inlined, with arguments by value, so that it costs nothing without a
/// strain-controlled cell. @param r from i to j; @param F force on i
[[gnu::noinline]] void add_virial(Triple<Lanes> r, Triple<Lanes> F, const Batch& q,
                                  const Particles& p, LoopLosses& losses)
{
  const Mask counts = counted(q, p);
  losses.virial_x.add(select(counts, F.x * r.x, Lanes{}));
  losses.virial_y.add(select(counts, F.y * r.y, Lanes{}));
  losses.virial_z.add(select(counts, F.z * r.z, Lanes{}));
}

template <class Strengths, IsBondLaw Law, IsContactLaw Contact>
void add_bonded_pairs(const Law& law, const Contact& contact_law, const PeriodicCell& cell,
                      double dt, Particles& p, Bonds& bonds, PairLosses& of_rank)
{
  LoopLosses losses(of_rank);
  const Law bond = law; // copies, so that no store below can alias them
  const Contact beside = contact_law;
  const bool is_periodic = cell.is_periodic(),
             is_strain_controlled = cell.is_strain_controlled;
  const Vec3 rate = cell.rate;
  const std::size_t n = bonds.size();
  for (std::size_t first = 0; first < n; first += n_lanes) {
    for (std::size_t a = first + prefetch_ahead; a < first + prefetch_ahead + n_lanes; ++a)
      if (a < n) prefetch(p, bonds.pairs[a].j);

    const Batch q(bonds.pairs, nullptr, first, n);
    const End<Lanes> i = gather(p.state.data(), q, &Pair::i);
    End<Lanes> j = gather(p.state.data(), q, &Pair::j);
    if (is_periodic) shift_images(q, cell, j.x);
    if (is_strain_controlled) add_cell_motion(rate, i, j);
    const PairMotion<Lanes> k = pair_motion(i, j, dt);

    const PairForce on_i = pair_force<Strengths>(bond, beside, q, i, j, k,
                                                 bonds.blocks[first / n_lanes], p, losses);
    scatter(p.load.data(), q, to_rows(k, on_i.F, on_i.M));
    if (is_strain_controlled) add_virial(k.n * (k.a_i + k.a_j), on_i.F, q, p, losses);
  }
}

template <IsContactLaw Contact>
void add_other_pairs(const Contact& contact_law, const PeriodicCell& cell, double dt,
                     Particles& p, Contacts& contacts, PairLosses& of_rank,
                     const std::vector<Index>& which)
{
  LoopLosses losses(of_rank);
  const Contact law = contact_law;
  const bool is_periodic = cell.is_periodic(),
             is_strain_controlled = cell.is_strain_controlled;
  const Vec3 rate = cell.rate;
  const std::size_t n = which.size();
  for (std::size_t first = 0; first < n; first += n_lanes) {
    for (std::size_t a = first + prefetch_ahead; a < first + prefetch_ahead + n_lanes; ++a)
      if (a < n) {
        prefetch(p, contacts.pairs[which[a]].j);
        __builtin_prefetch(&contacts.shear[which[a]], 1);
      }
    const Batch q(contacts.pairs, which.data(), first, n);
    const End<Lanes> i = gather(p.state.data(), q, &Pair::i);
    End<Lanes> j = gather(p.state.data(), q, &Pair::j);
    if (is_periodic) shift_images(q, cell, j.x);
    if (is_strain_controlled) add_cell_motion(rate, i, j);
    const PairMotion<Lanes> k = pair_motion(i, j, dt);

    Row shear[n_lanes];
    for (int l = 0; l < n_lanes; ++l)
      shear[l] =
          l < q.count
              ? row(contacts.shear[which[first + static_cast<std::size_t>(l)]].f_s.data())
              : Row{};
    Triple<Lanes> f_s;
    Lanes pad;
    columns(shear, f_s.x, f_s.y, f_s.z, pad);

    const auto contact = step_contact(law, q, i, j, k, f_s, p, losses);
    const Triple<Lanes> F = contact.f_s - k.n * contact.f_n;
    const Rows rows = to_rows(k, F, Triple<Lanes>{});
    scatter(p.load.data(), q, rows);
    if (is_strain_controlled) add_virial(k.n * (k.a_i + k.a_j), F, q, p, losses);
    for (int l = 0; l < q.count; ++l)
      contacts.shear[which[first + static_cast<std::size_t>(l)]].f_s = vec3(lane(f_s, l));
  }
}

} // namespace

void add_bond_forces(const PairMaterials& material, const PeriodicCell& cell, double dt,
                     Particles& p, Bonds& bonds, PairLosses& losses)
{
  std::visit(
      [&](const auto& bond, const auto& contact) {
        using Bond = std::decay_t<decltype(bond)>;
        using Contact = std::decay_t<decltype(contact)>;
        const auto& add = p.strength.empty()
                              ? add_bonded_pairs<UniformStrengths, Bond, Contact>
                              : add_bonded_pairs<VariableStrengths, Bond, Contact>;
        add(bond, contact, cell, dt, p, bonds, losses);
      },
      material.bond, material.contact);
}

void add_contact_forces(const ContactLaw& law, const PeriodicCell& cell, double dt,
                        Particles& p, Contacts& contacts, PairLosses& losses)
{
  static thread_local std::vector<Index> in_contact;
  choose_contacts(activation_gap(law), cell, p, contacts, in_contact);
  std::visit(
      [&](const auto& contact) {
        add_other_pairs(contact, cell, dt, p, contacts, losses, in_contact);
      },
      law);
}

ContactReading read_contact(const Pair& pair, const Vec3& f_s, const Particles& p,
                            const PeriodicCell& cell, const ContactLaw& law)
{
  const ParticleState &i = p.state[pair.i], &j = p.state[pair.j];
  const double L = i.R + j.R;
  const double gap = (j.x + cell.offset(pair.shift) - i.x).norm() - L;
  const double overlap = activation_gap(law) * 0.5 * (i.S + j.S) - gap;
  if (overlap <= 0.0) return {0.0, 0.0};
  const auto sides = sides_of_pair(i.R, j.R, 1.0 / L);
  return {normal_force(law, sides, overlap),
          contact_energy(law, sides, overlap, f_s.squaredNorm())};
}

Vec3 contact_shear_of(const Bonds& bonds, std::size_t b)
{
  return vec3(lane(bonds.blocks[b / n_lanes].f_s, static_cast<int>(b % n_lanes)));
}

} // namespace mergel::dem
