/// The bond laws that a run can choose from. A new one is a header beside this one, a name
/// in the list below, its keys in apps/case/material_keys.cc, and its test; whatever it lacks is
/// a compile error.
#pragma once

#include "dem/laws/bond.h"
#include "dem/laws/parallel.h"

#include <concepts>
#include <variant>

namespace mergel::dem {

using BondLaw = std::variant<DamageBond, ParallelBond>;

/// What the force kernel asks of a law: its elastic section, a test that a batch of pairs
/// takes at once, and the step of one bond that fails it.
// clang-format off
template <class Law>
concept IsBondLaw =
    std::derived_from<Law, BondSection> &&
    requires(const Law& law, const BondShape<Lanes>& shapes, const BondShape<double>& shape,
             const EffectiveLoads<Lanes>& many, const EffectiveLoads<double>& loads,
             const BondState& state, double S)
{
  { Law::name } -> std::convertible_to<const char*>;
  law.check();
  { is_elastic(law, shapes, many) } -> std::same_as<Mask>;
  { is_elastic(law, shape, loads) } -> std::convertible_to<bool>;
  { with_strengths_times(S, law) } -> std::same_as<Law>;
  { return_bond(law, shape, S, state, loads, loads) } -> std::same_as<BondReturn>;
  { yield_value(law, shape, loads) } -> std::same_as<double>;
  { break_mode(law, shape, loads) } -> std::same_as<BreakMode>;
  { single_strengths(law, shape) } -> std::same_as<SingleStrengths>;
};
// clang-format on
static_assert(IsBondLaw<DamageBond> && IsBondLaw<ParallelBond>);

/// Elastic part of whichever law it is.
inline const BondSection& section(const BondLaw& bond)
{
  return std::visit([](const auto& law) -> const BondSection& { return law; }, bond);
}

inline BondSection& section(BondLaw& bond)
{
  return std::visit([](auto& law) -> BondSection& { return law; }, bond);
}

} // namespace mergel::dem
