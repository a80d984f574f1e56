/// Exact sums of forces by node of a wall.
#pragma once

#include "dem/math/exact_sum.h"
#include "dem/math/lane_sum.h"
#include "dem/math/simd.h"

#include <algorithm>
#include <vector>

namespace mergel::dem {

/// A force for each node, with the bits of a VectorSum each: every term is rounded to the
/// quantum by itself. Nearly all sums have room in 64 bits; what has not goes to wide sums, which
/// exist from then on.
///
/// At most most_lane_terms terms below largest_lane_term are added to a node without a look at
/// its sum: together they stay below 2^62. Any other term stays in 64 bits where the sum is then
/// below 2^61.
class NodalSums {
public:
  explicit NodalSums(std::size_t n_nodes = 0) : narrow_(n_nodes, Quanta{}) {}

  std::size_t size() const { return narrow_.size(); }

  void clear()
  {
    std::fill(narrow_.begin(), narrow_.end(), Quanta{});
    wide_.clear();
  }

  /// @param force [N]; its fourth number is 0
  /// @throws NumericalError as ExactSum::add()
  [[gnu::always_inline]] void add(std::size_t node, const Row& force)
  {
    const Row scaled = force * ForceSum::scale;
    Quanta& sum = narrow_[node];
    if (any(!(magnitude(scaled) < largest_lane_term)) || sum[n_terms] == most_lane_terms)
        [[unlikely]] // or not a number
      return add_checked(node, force);
    sum += rounded(scaled) + Quanta{0, 0, 0, 1};
  }

  /// The sum at a node, of this rank or of all (ExactReduction) [N].
  Vec3 value(std::size_t node) const
  {
    if (!wide_.empty()) return sum(node).value();
    const Row row = narrow_row(node);
    return {row[0], row[1], row[2]};
  }
  /// The sum over the nodes of the sums times the vectors of a list: in [W] with velocities.
  double dot(const std::vector<Vec3>& v) const
  {
    Row products{};
    for (std::size_t k = 0; k < size(); ++k) {
      const Row row{v[k].x(), v[k].y(), v[k].z(), 0.0};
      products += row * (wide_.empty() ? narrow_row(k) : row_of(sum(k).value()));
    }
    return products[0] + products[1] + products[2];
  }
  VectorSum sum(std::size_t node) const
  {
    VectorSum all = wide_.empty() ? VectorSum{} : wide_[node];
    all.x.raw() += narrow_[node][0];
    all.y.raw() += narrow_[node][1];
    all.z.raw() += narrow_[node][2];
    return all;
  }
  void set(std::size_t node, const VectorSum& sum)
  {
    if (wide_.empty()) wide_.resize(size());
    wide_[node] = sum;
    narrow_[node] = Quanta{};
  }

  /// Append all sums to a list, if they are 64-bit integers below a limit.
  /// @returns whether they are
  bool append_narrow(std::vector<std::int64_t>& to, std::int64_t limit) const
  {
    if (!wide_.empty()) return false;
    const std::size_t first = to.size();
    to.resize(first + 3 * size());
    std::int64_t* next = to.data() + first;
    Quanta is_too_large{};
    for (const Quanta& quanta : narrow_) {
      is_too_large |= (quanta >= limit) | (quanta <= -limit);
      for (int c = 0; c < 3; ++c) *next++ = quanta[c];
    }
    return !any(is_too_large);
  }
  /// Take the sums of append_narrow(). @returns the first number behind them
  const std::int64_t* take_narrow(const std::int64_t* from)
  {
    wide_.clear();
    for (Quanta& quanta : narrow_) {
      quanta = Quanta{from[0], from[1], from[2], 0};
      from += 3;
    }
    return from;
  }

private:
  using Quanta = MaskOf<Row>; ///< 64-bit integers; the fourth is the number of terms
  static constexpr int n_terms = 3;

  static Row row_of(const Vec3& a) { return Row{a.x(), a.y(), a.z(), 0.0}; }
  Row narrow_row(std::size_t node) const
  {
    constexpr double unit = 1.0 / ForceSum::scale; // a power of 2
    return __builtin_convertvector(narrow_[node], Row) * unit;
  }

  [[gnu::noinline]] void add_checked(std::size_t node, const Row& force)
  {
    VectorSum term;
    term.add({force[0], force[1], force[2]});
    Quanta& quanta = narrow_[node];
    const ExactWide room = ExactWide{1} << 61, x = quanta[0] + term.x.raw(),
                    y = quanta[1] + term.y.raw(), z = quanta[2] + term.z.raw();
    if (std::max({x, y, z}) < room && std::min({x, y, z}) > -room) {
      quanta[0] = static_cast<std::int64_t>(x);
      quanta[1] = static_cast<std::int64_t>(y);
      quanta[2] = static_cast<std::int64_t>(z);
      return;
    }
    VectorSum all = sum(node);
    all.x += term.x;
    all.y += term.y;
    all.z += term.z;
    set(node, all);
  }

  std::vector<Quanta> narrow_;
  std::vector<VectorSum> wide_; ///< empty: all are 0
};

/// Call visit(ExactWide&) for each component, as of a list of sums.
template <class Visit>
void visit_raw(NodalSums& sums, Visit&& visit)
{
  for (std::size_t k = 0; k < sums.size(); ++k) {
    VectorSum sum = sums.sum(k);
    visit_raw(sum, visit);
    sums.set(k, sum);
  }
}
template <class Visit>
void visit_raw(const NodalSums& sums, Visit&& visit)
{
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const VectorSum sum = sums.sum(k);
    visit_raw(sum, visit);
  }
}

} // namespace mergel::dem
