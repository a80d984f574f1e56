/// Sums that do not depend on the order of their terms, and so not on the number of ranks.
#pragma once

#include "dem/error.h"
#include "dem/notation.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace mergel::dem {

__extension__ typedef __int128 ExactWide;

/// Sum in fixed point: terms are rounded to a multiple of the quantum and added as
/// integers (dem/README.md, Parallel execution).
///
/// The quantum is 2^-exponent in the unit of the sum. A term must be below
/// 2^(100-exponent), the sum below 2^27 times that. A term that is larger or not finite
/// throws NumericalError; no term is clipped.
template <int exponent>
class ExactSum {
public:
  void add(double term)
  {
    const double scaled = term * scale;
    if (std::abs(scaled) < 0x1p62) {
      sum_ += static_cast<std::int64_t>(std::llrint(scaled));
      return;
    }
    if (!(std::abs(scaled) < 0x1p100))
      throw NumericalError(
          "a force, power or energy is out of the range of the exact sums: " +
          std::to_string(term) + ", at most " + std::to_string(0x1p100 / scale) +
          " (SI): the run is unstable");
    sum_ += static_cast<ExactWide>(scaled); // from 2^53 on a double is a whole number
  }
  ExactSum& operator+=(const ExactSum& other)
  {
    sum_ += other.sum_;
    return *this;
  }
  double value() const
  {
    // Nearly all sums have 64 bits, for which the processor has an instruction.
    const auto narrow = static_cast<std::int64_t>(sum_);
    const double quanta =
        narrow == sum_ ? static_cast<double>(narrow) : static_cast<double>(sum_);
    return quanta / scale;
  }
  void clear() { sum_ = 0; }
  ExactWide& raw() { return sum_; } ///< in quanta; for the sums over ranks
  const ExactWide& raw() const { return sum_; }

  static constexpr double scale = ///< quanta per unit
      static_cast<double>(std::uint64_t{1} << (exponent / 2)) *
      static_cast<double>(std::uint64_t{1} << (exponent - exponent / 2));

private:
  ExactWide sum_ = 0;
};

using ForceSum = ExactSum<50>;  ///< [N]: quantum 9e-16 N, terms below 1e15 N
using MomentSum = ExactSum<80>; ///< [N m] or [W]: quantum 8e-25, terms below 1e6
using EnergySum = ExactSum<61>; ///< [J]: quantum 4e-19 J, terms below 5e11 J

/// Exact sum of vectors, by components.
template <class Sum>
struct ExactVector {
  Sum x, y, z;

  void add(const Vec3& a)
  {
    x.add(a.x());
    y.add(a.y());
    z.add(a.z());
  }
  Vec3 value() const { return {x.value(), y.value(), z.value()}; }
  void clear() { *this = {}; }
};
using VectorSum = ExactVector<ForceSum>;

/// How the ranks hold a sum.
enum class SumKind {
  by_rank, ///< each rank its part
  forces,  ///< each rank its part until the end of the step, then every rank the total
  by_node, ///< the same, but then each rank the totals of its nodes (NodeShares)
  total    ///< every rank the total
};

/// Call visit(ExactWide&) for each component of a sum, of a vector of sums, of a list.
template <int exponent, class Visit>
void visit_raw(ExactSum<exponent>& s, Visit&& visit)
{
  visit(s.raw());
}
template <int exponent, class Visit>
void visit_raw(const ExactSum<exponent>& s, Visit&& visit)
{
  visit(s.raw());
}
template <class Sum, class Visit>
void visit_raw(ExactVector<Sum>& v, Visit&& visit)
{
  for (Sum* s : {&v.x, &v.y, &v.z}) visit(s->raw());
}
template <class Sum, class Visit>
void visit_raw(const ExactVector<Sum>& v, Visit&& visit)
{
  for (const Sum* s : {&v.x, &v.y, &v.z}) visit(s->raw());
}
template <class Sum, class Visit>
void visit_raw(std::vector<Sum>& list, Visit&& visit)
{
  for (Sum& s : list) visit_raw(s, visit);
}
template <class Sum, class Visit>
void visit_raw(const std::vector<Sum>& list, Visit&& visit)
{
  for (const Sum& s : list) visit_raw(s, visit);
}

} // namespace mergel::dem
