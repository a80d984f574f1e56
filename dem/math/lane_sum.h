/// Exact sums of several terms at a time.
#pragma once

#include "dem/math/exact_sum.h"
#include "dem/math/simd.h"

namespace mergel::dem {

/// Collects terms, one per lane of V, for an ExactSum, and gives it the same bits as if they
/// were added one by one: each term is rounded to the quantum by itself.
///
/// Terms below 2^51 quanta are added as 64-bit integers, larger ones as ExactSum::add() does
/// it. The sum has them after flush() and at the end.
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
    if (any(!(magnitude(scaled) < 0x1p51))) [[unlikely]] { // or not a number
      add_one_by_one(terms);
      return;
    }
    // To this sum the last bit of the significand is worth one: it rounds as llrint() does.
    const V whole = V{} + 0x1.8p52;
    sum_ += reinterpret_cast<Whole>(scaled + whole) - reinterpret_cast<Whole>(whole);
    if (++n_ == most) flush();
  }

  void flush()
  {
    for (int l = 0; l < n_lanes_of<V>; ++l) to_.raw() += sum_[l];
    sum_ = Whole{};
    n_ = 0;
  }

private:
  using Whole = MaskOf<V>;          // 64-bit integers
  static constexpr int most = 2048; // 2^11 terms below 2^51 stay below 2^62

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
