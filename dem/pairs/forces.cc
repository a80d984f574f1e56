#include "dem/pairs/forces.h"

#include "dem/pairs/strength.h"

#include <algorithm>
#include <cstring>

namespace mergel::dem {

namespace {

constexpr std::size_t prefetch_ahead = 16;

Row row(const double* four)
{
  Row r;
  std::memcpy(&r, four, sizeof r);
  return r;
}

/// One particle of each pair of a batch, transposed from the records.
[[gnu::always_inline]] inline End<Lanes> gather(const ParticleState* state, const Index* at)
{
  const auto rows = [&](auto member, Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
    Row r[n_lanes];
    for (int l = 0; l < n_lanes; ++l) r[l] = row((state[at[l]].*member).data());
    columns(r, a, b, c, d);
  };
  End<Lanes> e;
  Lanes m; // the mass is in the row of the spin
  rows(&ParticleState::x, e.x.x, e.x.y, e.x.z, e.R);
  rows(&ParticleState::v, e.v.x, e.v.y, e.v.z, e.S);
  rows(&ParticleState::omega, e.omega.x, e.omega.y, e.omega.z, m);
  return e;
}

/// Forces on i and torques of a batch of pairs, one row for each.
struct Rows {
  Row f[n_lanes], t_i[n_lanes], t_j[n_lanes];
};

/// @param F force on i at the contact point, -F acts on j; @param M moment on i, -M on j
[[gnu::always_inline]] inline Rows to_rows(const PairMotion<Lanes>& k,
                                           const Triple<Lanes>& F, const Triple<Lanes>& M)
{
  const Triple<Lanes> nF = cross(k.n, F);
  const Triple<Lanes> t_i = nF * k.a_i + M, t_j = nF * k.a_j - M;
  Rows r;
  const auto set = [](Row(&out)[n_lanes], const Triple<Lanes>& a) {
    rows(a.x, a.y, a.z, Lanes{}, out);
  };
  set(r.f, F);
  set(r.t_i, t_i);
  set(r.t_j, t_j);
  return r;
}

void add_row(double* four, Row a)
{
  Row sum;
  std::memcpy(&sum, four, sizeof sum);
  sum += a;
  std::memcpy(four, &sum, sizeof sum);
}

/// Add the lanes to the particles one after the other: each particle adds its pairs in
/// their order.
[[gnu::always_inline]] inline void scatter(Load* load, const Index* i, const Index* j,
                                           int count, const Rows& r)
{
  for (int l = 0; l < count; ++l) {
    add_row(load[i[l]].f.data(), r.f[l]);
    add_row(load[i[l]].t.data(), r.t_i[l]);
    add_row(load[j[l]].f.data(), -r.f[l]);
    add_row(load[j[l]].t.data(), r.t_j[l]);
  }
}

/// The pairs of one batch. Missing pairs of the last batch repeat the last pair; they are
/// not scattered.
struct Batch {
  Index i[n_lanes], j[n_lanes];
  int count;
};

[[gnu::always_inline]] inline Batch batch_of(const std::vector<Pair>& pairs,
                                             const std::size_t* which, std::size_t first,
                                             std::size_t end)
{
  Batch q;
  q.count = static_cast<int>(std::min<std::size_t>(n_lanes, end - first));
  for (int l = 0; l < n_lanes; ++l) {
    const std::size_t k = first + static_cast<std::size_t>(std::min(l, q.count - 1));
    const Pair& pair = pairs[which ? which[k] : k];
    q.i[l] = pair.i;
    q.j[l] = pair.j;
  }
  return q;
}

void shift_images(const std::vector<Pair>& pairs, const std::size_t* which,
                  std::size_t first, const Batch& q, const PeriodicCell& cell,
                  Triple<Lanes>& x)
{
  for (int l = 0; l < q.count; ++l) {
    const std::size_t k = first + static_cast<std::size_t>(l);
    const Shift& shift = pairs[which ? which[k] : k].shift;
    if ((shift[0] | shift[1] | shift[2]) == 0) continue; // x + 0 is x
    const Vec3 offset = cell.offset(shift);
    x.x[l] += offset.x();
    x.y[l] += offset.y();
    x.z[l] += offset.z();
  }
}

/// In a strain-controlled cell v is relative to the cell: add to j the velocity of the cell
/// at j relative to that at i.
[[gnu::always_inline]] inline void add_cell_motion(const Vec3& rate, const End<Lanes>& i,
                                                   End<Lanes>& j)
{
  const Triple<Lanes> r = j.x - i.x;
  j.v += {r.x * rate.x(), r.y * rate.y(), r.z * rate.z()};
}

/// Not inlined, with arguments by value, so that it costs nothing without a
/// strain-controlled cell. @param r from i to j; @param F force on i
[[gnu::noinline]] void add_virial(Triple<Lanes> r, Triple<Lanes> F, const Batch& q,
                                  const Particles& p, PairLosses& losses)
{
  const Triple<Lanes> w{F.x * r.x, F.y * r.y, F.z * r.z};
  for (int l = 0; l < q.count; ++l)
    if (p.owns(q.i[l])) losses.virial.add(vec3(lane(w, l)));
}

void prefetch(const Particles& p, Index j)
{
  const char* b = reinterpret_cast<const char*>(&p.state[j]);
  __builtin_prefetch(b);
  __builtin_prefetch(b + 64);
  __builtin_prefetch(&p.load[j], 1);
}

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
    for (int l = 0; l < n_lanes; ++l) f[l] = strength_between(p, q.i[l], q.j[l]); // > 0
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
                  EffectiveLoads<Lanes>& load, BondBlock& h, const Pair* pairs,
                  Particles& p, PairLosses& losses)
{
  for (int l = 0; l < q.count; ++l) {
    if (!yields[l]) continue;
    const BondShape<double> shape{s.R_b[l], s.A[l], s.k_n[l], s.k_s[l], s.k_b[l], s.k_t[l]};
    const auto loads = [l](const EffectiveLoads<Lanes>& q) {
      return EffectiveLoads<double>{q.N[l], lane(q.V, l), lane(q.M, l), q.T[l]};
    };
    const Law& b = Strengths::of(law, p, q.i[l], q.j[l]);
    const BondReturn r =
        return_bond(b, shape, S[l], {h.u_p[l], h.intact[l]}, loads(old), loads(load));
    load.N[l] = r.loads.N;
    set_lane(load.V, l, r.loads.V);
    set_lane(load.M, l, r.loads.M);
    load.T[l] = r.loads.T;
    h.u_p[l] = r.state.u_p;
    h.intact[l] = r.state.intact;
    const bool counts = p.owns(q.i[l]);
    if (counts) {
      ++losses.yielded;
      losses.plastic.add(r.loss);
    }
    if (r.state.intact > 0.0) continue;
    --p.n_bonds[q.i[l]];
    --p.n_bonds[q.j[l]];
    if (!counts) continue;
    losses.breakage_release.add(r.breakage_release);
    ++losses.broken;
    const BreakMode mode = break_mode(b, shape, r.loads);
    ++losses.broken_by[static_cast<std::size_t>(mode)];
    losses.breakages.push_back(
        {pairs[l], 0.5 * (p.state[q.i[l]].x + p.state[q.j[l]].x), mode});
  }
}

void add_slip(const Lanes& loss, const Batch& q, const Particles& p, PairLosses& losses)
{
  if (!any(loss != Lanes{})) return;
  for (int l = 0; l < q.count; ++l)
    if (loss[l] != 0.0 && p.owns(q.i[l])) losses.slip.add(loss[l]);
}

template <class Strengths, IsBondLaw Law>
void add_forces_of(const Law& law, const LinearMaterial& contact_law,
                   const PeriodicCell& cell, double dt, Particles& p, Bonds& bonds,
                   PairLosses& losses)
{
  const Law bond = law; // copies, so that no store below can alias them
  const LinearMaterial beside = contact_law;
  const bool is_periodic = cell.is_periodic(),
             is_strain_controlled = cell.is_strain_controlled;
  const Vec3 rate = cell.rate;
  const std::size_t n = bonds.size();
  for (std::size_t first = 0; first < n; first += n_lanes) {
    for (std::size_t a = first + prefetch_ahead; a < first + prefetch_ahead + n_lanes; ++a)
      if (a < n) prefetch(p, bonds.pairs[a].j);

    const Batch q = batch_of(bonds.pairs, nullptr, first, n);
    const End<Lanes> i = gather(p.state.data(), q.i);
    End<Lanes> j = gather(p.state.data(), q.j);
    if (is_periodic) shift_images(bonds.pairs, nullptr, first, q, cell, j.x);
    if (is_strain_controlled) add_cell_motion(rate, i, j);
    const PairMotion<Lanes> k = pair_motion(i, j, dt);

    BondBlock& h = bonds.blocks[first / n_lanes];
    const Lanes r = min(i.R, j.R), S = 0.5 * (i.S + j.S);

    // bond
    const BondShape<Lanes> shape = bond_shape(bond, r, k.inv_L);
    const Triple<Lanes> V = rotated_with_contact(h.V, k), M = rotated_with_contact(h.M, k);
    EffectiveLoads<Lanes> load{shape.k_n * (k.gap - h.gap_0 - h.u_p),
                               V + k.du_s * shape.k_s, M + k.dtheta * shape.k_b,
                               h.T + k.dphi * shape.k_t};
    const Mask yields = Strengths::yields(bond, shape, load, q, p) & (h.intact > Lanes{});
    if (any(yields)) {
      const EffectiveLoads<Lanes> old{load.N - shape.k_n * k.du_n, V, M, h.T};
      return_lanes<Strengths>(bond, shape, S, yields, q, old, load, h, &bonds.pairs[first],
                              p, losses);
    }
    const Mask lives = h.intact > Lanes{};
    const Triple<Lanes> zero{};
    h.V = select(lives, load.V, zero);
    h.M = select(lives, load.M, zero);
    h.T = select(lives, load.T, Lanes{});

    // contact of the same pair
    const auto contact =
        linear_contact(beside, linear_stiffness(beside, r, k.inv_L), k.gap, beside.g_a * S,
                       k.du_s, rotated_with_contact(h.f_s, k));
    h.f_s = contact.f_s;
    add_slip(contact.slip_loss, q, p, losses);

    const Lanes N = select(lives, load.N, Lanes{});
    const Triple<Lanes> F =
        k.n * (h.intact * N - contact.f_n) + h.V * h.intact + contact.f_s;
    const Triple<Lanes> on_i = (h.M + k.n * h.T) * h.intact;
    scatter(p.load.data(), q.i, q.j, q.count, to_rows(k, F, on_i));
    if (is_strain_controlled) add_virial(k.n * (k.a_i + k.a_j), F, q, p, losses);
  }
}

bool is_zero(const Vec3& a)
{
  std::uint64_t bits[3];
  std::memcpy(bits, a.data(), sizeof bits);
  return ((bits[0] | bits[1] | bits[2]) << 1) == 0; // without the sign
}

/// Choose the pairs that go through the kernel: those in contact, and those that still have
/// a shear force. Most candidates are neither. Writes their numbers to `which` and returns
/// their count. There is no branch on the distance, because it cannot be predicted.
std::size_t choose_in_contact(double g_a, const PeriodicCell& cell, const Particles& p,
                              const Contacts& contacts, std::size_t* which)
{
  const bool is_periodic = cell.is_periodic();
  const Pair* const pairs = contacts.pairs.data();
  const ContactShear* const shear = contacts.shear.data();
  const ParticleState* const state = p.state.data();
  const std::size_t n = contacts.pairs.size();
  std::size_t n_in_contact = 0;
  for (std::size_t c = 0; c < n; ++c) {
    __builtin_prefetch(&state[pairs[std::min(c + prefetch_ahead, n - 1)].j]);
    const Pair& pair = pairs[c];
    const ParticleState &i = state[pair.i], &j = state[pair.j];
    Vec3 r = j.x - i.x;
    if (is_periodic && (pair.shift[0] | pair.shift[1] | pair.shift[2]) != 0)
      r += cell.offset(pair.shift);
    const double reach = i.R + j.R + g_a * (0.5 * (i.S + j.S));
    // A distance of NaN counts as contact: the force is NaN then, and the next kick throws.
    const bool is_apart = r.squaredNorm() >= reach * reach * (1.0 + 1e-12);
    which[n_in_contact] = c;
    n_in_contact += !is_apart | !is_zero(shear[c].f_s);
  }
  return n_in_contact;
}

} // namespace

void add_bond_forces(const PairMaterials& material, const PeriodicCell& cell, double dt,
                     Particles& p, Bonds& bonds, PairLosses& losses)
{
  std::visit(
      [&](const auto& law) {
        const auto& add =
            p.strength.empty()
                ? add_forces_of<UniformStrengths, std::decay_t<decltype(law)>>
                : add_forces_of<VariableStrengths, std::decay_t<decltype(law)>>;
        add(law, material.contact, cell, dt, p, bonds, losses);
      },
      material.bond);
}

void add_contact_forces(const LinearMaterial& material, const PeriodicCell& cell, double dt,
                        Particles& p, Contacts& contacts, PairLosses& losses)
{
  const bool is_periodic = cell.is_periodic(),
             is_strain_controlled = cell.is_strain_controlled;
  const Vec3 rate = cell.rate;
  const std::size_t n = contacts.pairs.size();

  static thread_local std::vector<std::size_t> in_contact;
  in_contact.resize(n);
  std::size_t* const which = in_contact.data();
  const std::size_t n_in_contact =
      choose_in_contact(material.g_a, cell, p, contacts, which);

  for (std::size_t first = 0; first < n_in_contact; first += n_lanes) {
    for (std::size_t a = first + prefetch_ahead; a < first + prefetch_ahead + n_lanes; ++a)
      if (a < n_in_contact) {
        prefetch(p, contacts.pairs[which[a]].j);
        __builtin_prefetch(&contacts.shear[which[a]], 1);
      }
    const Batch q = batch_of(contacts.pairs, which, first, n_in_contact);
    const End<Lanes> i = gather(p.state.data(), q.i);
    End<Lanes> j = gather(p.state.data(), q.j);
    if (is_periodic) shift_images(contacts.pairs, which, first, q, cell, j.x);
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

    const Lanes r = min(i.R, j.R), S = 0.5 * (i.S + j.S);
    const auto contact =
        linear_contact(material, linear_stiffness(material, r, k.inv_L), k.gap,
                       material.g_a * S, k.du_s, rotated_with_contact(f_s, k));
    add_slip(contact.slip_loss, q, p, losses);

    const Triple<Lanes> F = contact.f_s - k.n * contact.f_n;
    const Rows rows = to_rows(k, F, Triple<Lanes>{});
    scatter(p.load.data(), q.i, q.j, q.count, rows);
    if (is_strain_controlled) add_virial(k.n * (k.a_i + k.a_j), F, q, p, losses);
    for (int l = 0; l < q.count; ++l)
      contacts.shear[which[first + static_cast<std::size_t>(l)]].f_s =
          vec3(lane(contact.f_s, l));
  }
}

ContactReading read_contact(const Pair& pair, const Vec3& f_s, const Particles& p,
                            const PeriodicCell& cell, const LinearMaterial& material)
{
  const ParticleState &i = p.state[pair.i], &j = p.state[pair.j];
  const double L = i.R + j.R;
  const double gap = (j.x + cell.offset(pair.shift) - i.x).norm() - L;
  const double closed = material.g_a * 0.5 * (i.S + j.S) - gap;
  if (closed <= 0.0) return {0.0, 0.0};
  const auto k = linear_stiffness(material, std::min(i.R, j.R), 1.0 / L);
  return {k.k_n * closed, 0.5 * (k.k_n * closed * closed + f_s.squaredNorm() / k.k_s)};
}

Vec3 contact_shear_of(const Bonds& bonds, std::size_t b)
{
  return vec3(lane(bonds.blocks[b / n_lanes].f_s, static_cast<int>(b % n_lanes)));
}

PairEnergy pair_energy(const PairMaterials& material, const PeriodicCell& cell,
                       const Particles& p, const Bonds& bonds, const Contacts& contacts)
{
  PairEnergy e;
  const auto add_contact = [&](const Pair& pair, const Vec3& f_s) {
    e.contacts.add(read_contact(pair, f_s, p, cell, material.contact).energy);
  };
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    if (!p.owns(bonds.pairs[b].i)) continue;
    e.bonds.add(read_bond(bonds, b, p, cell, material.bond).energy);
    add_contact(bonds.pairs[b], contact_shear_of(bonds, b));
  }
  for (std::size_t c = 0; c < contacts.pairs.size(); ++c)
    if (p.owns(contacts.pairs[c].i)) add_contact(contacts.pairs[c], contacts.shear[c].f_s);
  return e;
}

} // namespace mergel::dem
