#include "dem/assembly/overlaps.h"

#include "dem/text.h"

#include <algorithm>

namespace mergel::dem {

void Overlaps::add(const Overlaps& other)
{
  largest = std::max(largest, other.largest);
  beyond_mark = std::max(beyond_mark, other.beyond_mark);
  beyond_high_mark = std::max(beyond_high_mark, other.beyond_high_mark);
}

namespace {

/// Over the smaller radius; negative for particles apart [-].
double overlap(const Assembly& assembly, const Pair& q)
{
  const ParticleState &i = assembly.particles.state[q.i],
                      &j = assembly.particles.state[q.j];
  return (i.R + j.R - (j.x + assembly.cell.offset(q.shift) - i.x).norm()) /
         std::min(i.R, j.R);
}

} // namespace

Overlaps check_overlaps(const Assembly& assembly)
{
  const double limit = assembly.motion.largest_overlap;
  Overlaps found;
  const auto check = [&](const Pair& q) {
    const double here = overlap(assembly, q);
    if (!(here <= limit))
      throw NumericalError(
          "particles " + std::to_string(assembly.particles.id[q.i]) + " and " +
          std::to_string(assembly.particles.id[q.j]) + " overlap by " + shortest(here) +
          " of the smaller radius (at most " + shortest(limit) +
          "): the contact is too soft for this load: raise its modulus, or "
          "`Motion/largest overlap`, which a restart may change");
    found.largest = std::max(found.largest, here);
    if (here <= Overlaps::mark || !assembly.particles.owns(q.i)) return;
    ++found.beyond_mark;
    found.beyond_high_mark += here > Overlaps::high_mark;
  };
  Fault fault = assembly.fault; // may hold an earlier one that is not reported yet
  fault.run([&] {
    for (const Pair& q : assembly.bonds.pairs) check(q);
    for (const Pair& q : assembly.contacts.pairs) check(q);
  });
  assembly.comm.agree_on(fault);
  found.largest = assembly.comm.global_max(found.largest);
  found.beyond_mark = assembly.comm.global_sum(found.beyond_mark);
  found.beyond_high_mark = assembly.comm.global_sum(found.beyond_high_mark);
  return found;
}

} // namespace mergel::dem
