#include "dem/pairs/contacts.h"

#include "dem/pairs/batch.h"

namespace mergel::dem {

namespace {

bool is_zero(const Vec3& a)
{
  std::uint64_t bits[3];
  std::memcpy(bits, a.data(), sizeof bits);
  return ((bits[0] | bits[1] | bits[2]) << 1) == 0; // without the sign
}

/// @param number_of the n pairs to examine, ascending
template <class NumberOf>
void choose(double range, const PeriodicCell& cell, const Particles& p,
            const Contacts& contacts, std::vector<Index>& which,
            const std::vector<double>& extra, std::size_t n, NumberOf&& number_of)
{
  const bool is_periodic = cell.is_periodic();
  const Pair* const pairs = contacts.pairs.data();
  const ContactShear* const shear = contacts.shear.data();
  const ParticleState* const state = p.state.data();
  which.resize(n);
  std::size_t n_chosen = 0;
  for (std::size_t k = 0; k < n; ++k) {
    // The numbers of close pairs are too far apart for the processor to foresee them.
    __builtin_prefetch(&pairs[number_of(std::min(k + 2 * prefetch_ahead, n - 1))]);
    const Index soon = number_of(std::min(k + prefetch_ahead, n - 1));
    __builtin_prefetch(&state[pairs[soon].j]);
    __builtin_prefetch(&shear[soon]);
    const Index c = number_of(k);
    const Pair& pair = pairs[c];
    const ParticleState &i = state[pair.i], &j = state[pair.j];
    Vec3 r = j.x - i.x;
    if (is_periodic && (pair.shift[0] | pair.shift[1] | pair.shift[2]) != 0)
      r += cell.offset(pair.shift);
    double reach = i.R + j.R + range * (0.5 * (i.S + j.S));
    if (!extra.empty()) reach += extra[pair.i] + extra[pair.j];
    // A distance of NaN counts as contact: the force is NaN then, and the next kick throws.
    const bool is_apart = r.squaredNorm() >= reach * reach * (1.0 + 1e-12);
    // There is no branch on the distance, because it cannot be predicted.
    which[n_chosen] = c;
    n_chosen += !is_apart | !is_zero(shear[c].f_s);
  }
  which.resize(n_chosen);
}

} // namespace

void choose_contacts(double range, const PeriodicCell& cell, const Particles& p,
                     const Contacts& contacts, std::vector<Index>& which,
                     const std::vector<double>& extra)
{
  if (contacts.is_narrowed)
    choose(range, cell, p, contacts, which, extra, contacts.close.size(),
           [close = contacts.close.data()](std::size_t k) { return close[k]; });
  else
    choose(range, cell, p, contacts, which, extra, contacts.pairs.size(),
           [](std::size_t k) { return static_cast<Index>(k); });
}

} // namespace mergel::dem
