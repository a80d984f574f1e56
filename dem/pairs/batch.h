/// How the pair kernels read and write: a batch of pairs at a time, one pair per lane.
#pragma once

#include "dem/pairs/pairs.h"
#include "dem/particles/kinematics.h"
#include "dem/particles/particles.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace mergel::dem {

inline Row row(const double* four)
{
  Row r;
  std::memcpy(&r, four, sizeof r);
  return r;
}

/// The pairs of one batch. Missing pairs of the last batch repeat the last pair; they are
/// not scattered.
class Batch {
public:
  /// The pairs from `first` up to `end`, or those whose numbers `which` has there.
  [[gnu::always_inline]] Batch(const std::vector<Pair>& pairs, const Index* which,
                               std::size_t first, std::size_t end)
      : count(static_cast<int>(std::min<std::size_t>(n_lanes, end - first)))
  {
    if (!which && count == n_lanes) { // as they lie: a copy would cost more than the rest
      pairs_ = &pairs[first];
      return;
    }
    for (int l = 0; l < n_lanes; ++l) {
      const std::size_t k = first + static_cast<std::size_t>(std::min(l, count - 1));
      copies_[l] = pairs[which ? which[k] : k];
    }
    pairs_ = copies_;
  }
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  const Pair& operator[](int l) const { return pairs_[l]; }

  const int count; ///< without padding

private:
  const Pair* pairs_;
  Pair copies_[n_lanes];
};

/// Particles transposed from the records. @param index_of that of a lane
template <class IndexOf>
[[gnu::always_inline]] inline End<Lanes> gather(const ParticleState* state,
                                                IndexOf&& index_of)
{
  const auto rows = [&](auto member, Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
    Row r[n_lanes];
    for (int l = 0; l < n_lanes; ++l) r[l] = row((state[index_of(l)].*member).data());
    columns(r, a, b, c, d);
  };
  End<Lanes> e;
  Lanes m; // the mass is in the row of the spin
  rows(&ParticleState::x, e.x.x, e.x.y, e.x.z, e.R);
  rows(&ParticleState::v, e.v.x, e.v.y, e.v.z, e.S);
  rows(&ParticleState::omega, e.omega.x, e.omega.y, e.omega.z, m);
  return e;
}

/// One particle of each pair of a batch. @param end which one, &Pair::i or &Pair::j
[[gnu::always_inline]] inline End<Lanes> gather(const ParticleState* state, const Batch& q,
                                                Index Pair::*end)
{
  return gather(state, [&](int l) { return q[l].*end; });
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
    rows(a.x, a.y, a.z, out);
  };
  set(r.f, F);
  set(r.t_i, t_i);
  set(r.t_j, t_j);
  return r;
}

inline void add_row(double* four, Row a)
{
  Row sum;
  std::memcpy(&sum, four, sizeof sum);
  sum += a;
  std::memcpy(four, &sum, sizeof sum);
}

/// Add the lanes to the particles one after the other: each particle adds its pairs in
/// their order.
[[gnu::always_inline]] inline void scatter(Load* load, const Batch& q, const Rows& r)
{
  for (int l = 0; l < q.count; ++l) {
    Load &on_i = load[q[l].i], &on_j = load[q[l].j];
    add_row(on_i.f.data(), r.f[l]);
    add_row(on_i.t.data(), r.t_i[l]);
    add_row(on_j.f.data(), -r.f[l]);
    add_row(on_j.t.data(), r.t_j[l]);
  }
}

/// The pairs that count on this rank: those that are no padding and whose first particle it
/// owns.
inline Mask counted(const Batch& q, const Particles& p)
{
  unsigned bits = (1u << q.count) - 1u;
  if (p.n_owned() != p.size()) {
    unsigned owned = 0;
    for (int l = 0; l < n_lanes; ++l) owned |= static_cast<unsigned>(p.owns(q[l].i)) << l;
    bits &= owned;
  }
  return lanes_of(bits);
}

inline void shift_images(const Batch& q, const PeriodicCell& cell, Triple<Lanes>& x)
{
  for (int l = 0; l < q.count; ++l) {
    const Shift& shift = q[l].shift;
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

/// Pairs ahead of the present one whose second particle is fetched.
inline constexpr std::size_t prefetch_ahead = 16;

/// Inlined, for GCC drops the call of a function that only fetches.
[[gnu::always_inline]] inline void prefetch(const Particles& p, Index j)
{
  const char* b = reinterpret_cast<const char*>(&p.state[j]);
  __builtin_prefetch(b);
  __builtin_prefetch(b + 64);
  __builtin_prefetch(&p.load[j], 1);
}

} // namespace mergel::dem
