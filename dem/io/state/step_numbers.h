/// The stable step of a run as named numbers of a checkpoint.
#pragma once

#include "dem/assembly/timestep.h"
#include "dem/io/state/named_numbers.h"

namespace mergel::dem {

/// Append all numbers of `s`, a const one to save only.
template <class Numbers, class Step>
void append_stable_step(Numbers& to, Step& s)
{
  to.insert(to.end(),
            {{"stable step [s]", &s.limit},
             {"squared frequency at the last evaluation [1/s2]", &s.omega2},
             {"block bound at the last evaluation [1/s2]", &s.bound2},
             {"rise of the block bound since then [-]", &s.largest_rise},
             {"stiffness at moving walls at the last evaluation [N/m]", &s.wall_stiffness},
             {"block bound [1/s2]", &s.stiffest.omega2},
             {"S of the stiffest particle [-]", &s.stiffest.S},
             {"share of rotation in its motion [-]", &s.stiffest.rotation}});
}
/// The same for counts.
template <class Counts, class Step>
void append_stable_step_counts(Counts& to, Step& s)
{
  to.push_back({"stiffest particle", &s.stiffest.id});
  to.push_back({"stiffest particle at the last evaluation", &s.stiffest_then});
  to.push_back({"evaluations of the largest frequency", &s.n_evaluations});
}

} // namespace mergel::dem
