/// The list of bond laws. To add one: a header beside this one, its name in the list below,
/// its keys in apps/case/material_keys.cc, and a test (dem/laws/README.md, Adding a bond
/// law). A missing function is a compile error.
#pragma once

#include "dem/laws/bond.h"
#include "dem/laws/parallel.h"

#include <concepts>
#include <variant>

namespace mergel::dem {

using BondLaw = std::variant<DamageBond, ParallelBond>;

/// What the force kernel needs of a law: its elastic section, an elastic test for a batch
/// of pairs, and the inelastic step of one bond that fails the test.
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

/// Elastic part of the law.
inline const BondSection& section(const BondLaw& bond)
{
  return std::visit([](const auto& law) -> const BondSection& { return law; }, bond);
}

inline BondSection& section(BondLaw& bond)
{
  return std::visit([](auto& law) -> BondSection& { return law; }, bond);
}

} // namespace mergel::dem
