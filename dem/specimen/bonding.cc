#include "dem/specimen/bonding.h"

#include "dem/pairs/neighbours.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

Bonding choose_bonds(const SpecimenSpec& s, const Particles& p, const PeriodicCell& cell)
{
  struct Candidate {
    double gap; ///< over S
    Pair pair;
  };
  std::vector<Candidate> candidates;
  for (const Pair& q : find_pairs(p, cell, s.g_b)) {
    const ParticleState &i = p.state[q.i], &j = p.state[q.j];
    const double gap = (j.x + cell.offset(q.shift) - i.x).norm() - (i.R + j.R);
    candidates.push_back({gap / (0.5 * (i.S + j.S)), q});
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) {
              return a.gap != b.gap ? a.gap < b.gap : a.pair < b.pair;
            });
  const auto wanted = static_cast<std::size_t>(
      std::llround(0.5 * s.coordination * static_cast<double>(p.size())));
  candidates.resize(std::min(wanted, candidates.size()));

  Bonding bonding;
  for (const Candidate& c : candidates) bonding.pairs.push_back(c.pair);
  if (!candidates.empty()) bonding.limit = candidates.back().gap;
  std::sort(bonding.pairs.begin(), bonding.pairs.end());
  return bonding;
}

} // namespace mergel::dem
