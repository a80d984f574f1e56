// A third bond law compiles where it is handled, and only there (third_law.cmake).
#include "apps/case/law_keys.h"
#include "dem/laws/bond_law.h"

namespace mergel::dem {

/// A bond that breaks at one tensile force.
struct ThirdBond : BondSection {
  static constexpr const char* name = "third";
  double sigma = 0.0; ///< [Pa]
};
template <class Real>
auto is_elastic(const ThirdBond& b, const BondShape<Real>& s, const EffectiveLoads<Real>& q)
{
  return q.N < b.sigma * s.A;
}
inline ThirdBond with_strengths_times(double factor, ThirdBond b)
{
  b.sigma *= factor;
  return b;
}
inline double yield_value(const ThirdBond& b, const BondShape<double>& s,
                          const EffectiveLoads<double>& q)
{
  return q.N / (b.sigma * s.A) - 1.0;
}
inline BreakMode break_mode(const ThirdBond&, const BondShape<double>&,
                            const EffectiveLoads<double>&)
{
  return BreakMode::tension;
}
inline SingleStrengths single_strengths(const ThirdBond& b, const BondShape<double>& s)
{
  return {b.sigma * s.A, 0.0, 0.0, 0.0};
}
#ifdef HAS_FUNCTIONS
inline BondReturn return_bond(const ThirdBond&, const BondShape<double>&, double,
                              const BondState& state, const EffectiveLoads<double>&,
                              const EffectiveLoads<double>& trial)
{
  return {trial, {state.u_p, 0.0}, 0.0, 0.0};
}
#endif
static_assert(IsBondLaw<ThirdBond>);

} // namespace mergel::dem

namespace mergel::apps {

void declare_law(CaseFile& file, dem::DamageBond& bond);
void declare_law(CaseFile& file, dem::ParallelBond& bond);
#ifdef HAS_KEYS
void declare_law(CaseFile& file, dem::ThirdBond& bond);
#endif

void declare_all(CaseFile& file)
{
  LawKeys<std::variant<dem::DamageBond, dem::ParallelBond, dem::ThirdBond>> keys;
  declare_laws(file, "bond law", keys);
}

} // namespace mergel::apps
