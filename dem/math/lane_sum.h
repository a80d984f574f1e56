/// Exact sums of several terms at a time.
#pragma once

#include "dem/math/exact_sum.h"
#include "dem/math/simd.h"

namespace mergel::dem {

/// Terms below this [quanta] are added as 64-bit integers, and so many of them stay below
/// 2^62.
inline constexpr double largest_lane_term = 0x1p51;
inline constexpr int most_lane_terms = 2048;

/// Rounded to 64-bit integers as llrint() does it. @pre below largest_lane_term
template <class V>
[[gnu::always_inline]] inline MaskOf<V> rounded(const V& scaled)
{
  // To this sum the last bit of the significand is worth one.
  const V whole = V{} + 0x1.8p52;
  return reinterpret_cast<MaskOf<V>>(scaled + whole) - reinterpret_cast<MaskOf<V>>(whole);
}

/// Collects terms, one per lane of V, for an ExactSum, and gives it the same bits as if they
/// were added one by one: each term is rounded to the quantum by itself.
///
/// Terms from 2^51 quanta on are added as ExactSum::add() does it. The sum has all of them
/// after flush() and at the end.
template <class V, int exponent>
class LaneSum {
public:
  explicit LaneSum(ExactSum<exponent>& to) : to_(to) {}
  ~LaneSum() { flush(); }
  LaneSum(const LaneSum&) = delete;
  LaneSum& operator=(const LaneSum&) = delete;

  /// @throws NumericalError as ExactSum::add()
  [[gnu::always_inline]] void add(const V& terms)
  {
    const V scaled = terms * ExactSum<exponent>::scale;
    if (any(!(magnitude(scaled) < largest_lane_term))) [[unlikely]] { // or not a number
      add_one_by_one(terms);
      return;
    }
    sum_ += rounded(scaled);
    if (++n_ == most_lane_terms) flush();
  }

  void flush()
  {
    for (int l = 0; l < n_lanes_of<V>; ++l) to_.raw() += sum_[l];
    sum_ = Whole{};
    n_ = 0;
  }

private:
  using Whole = MaskOf<V>; // 64-bit integers

  [[gnu::noinline]] void add_one_by_one(V terms)
  {
    for (int l = 0; l < n_lanes_of<V>; ++l) to_.add(terms[l]);
  }

  ExactSum<exponent>& to_;
  Whole sum_{};
  int n_ = 0;
};

template <class V>
using LaneEnergySum = LaneSum<V, 61>; ///< for EnergySum

} // namespace mergel::dem
