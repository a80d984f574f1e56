/// Exact sums of forces by node of a wall.
#pragma once

#include "dem/math/exact_sum.h"
#include "dem/math/lane_sum.h"
#include "dem/math/simd.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace mergel::dem {

/// Nodes that the ranks share: a block of consecutive nodes each.
struct NodeShares {
  /// Of each rank its first node, and at the end the number of nodes; empty: not shared.
  std::vector<std::size_t> first;
  std::size_t rank = 0; ///< this one

  bool are_shared() const { return first.size() > 2; }
};

/// Nodes [first, end).
struct NodeRange {
  std::size_t first, end;
};

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

  /// Over ranks each then gets the sums of its nodes only (ExactReduction); those of the other
  /// nodes are its own part still.
  void share(NodeShares shares) { shares_ = std::move(shares); }
  const NodeShares& shares() const { return shares_; }
  bool is_shared() const { return shares_.are_shared(); }
  /// Nodes whose sums a rank gets; without sharing all.
  NodeRange nodes_of(std::size_t rank) const
  {
    if (!is_shared()) return {0, size()};
    return {shares_.first[rank], shares_.first[rank + 1]};
  }
  NodeRange own() const { return nodes_of(shares_.rank); }

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
    const Row f = row(node);
    return {f[0], f[1], f[2]};
  }
  /// The same, with any fourth number.
  Row row(std::size_t node) const
  {
    if (!wide_.empty()) [[unlikely]]
      return row_of(sum(node).value());
    constexpr double unit = 1.0 / ForceSum::scale; // a power of 2
    return __builtin_convertvector(narrow_[node], Row) * unit;
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

  /// Whether the sums at these nodes are 64-bit integers below a limit.
  bool are_narrow(const NodeRange& nodes, std::int64_t limit) const
  {
    Quanta is_too_large{};
    for (std::size_t k = nodes.first; k < nodes.end; ++k)
      is_too_large |= (narrow_[k] >= limit) | (narrow_[k] <= -limit);
    return wide_.empty() && !any(is_too_large);
  }
  /// Write the sums at these nodes to a list, three numbers each, and move its place behind them.
  /// @returns whether are_narrow(); else they are wrong
  bool write_narrow(const NodeRange& nodes, std::int64_t limit, std::int64_t*& to) const
  {
    Quanta is_too_large{};
    std::int64_t* next = to;
    for (std::size_t k = nodes.first; k < nodes.end; ++k) {
      const Quanta& quanta = narrow_[k];
      is_too_large |= (quanta >= limit) | (quanta <= -limit);
      for (int c = 0; c < 3; ++c) *next++ = quanta[c];
    }
    to = next;
    return wide_.empty() && !any(is_too_large);
  }
  /// Take the sums at all nodes from such a list. @returns the place behind them
  const std::int64_t* take_narrow(const std::int64_t* from)
  {
    wide_.clear();
    for (Quanta& quanta : narrow_) {
      quanta = Quanta{from[0], from[1], from[2], 0};
      from += 3;
    }
    return from;
  }
  /// Add those at its own nodes. @pre all are_narrow() with room for those of all ranks
  const std::int64_t* add_narrow(const std::int64_t* from)
  {
    const auto [first, end] = own();
    for (std::size_t k = first; k < end; ++k) {
      narrow_[k] += Quanta{from[0], from[1], from[2], 0};
      from += 3;
    }
    return from;
  }

private:
  using Quanta = MaskOf<Row>; ///< 64-bit integers; the fourth is the number of terms
  static constexpr int n_terms = 3;

  static Row row_of(const Vec3& a) { return Row{a.x(), a.y(), a.z(), 0.0}; }

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
  NodeShares shares_;
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

/// Call visit(ExactWide) for each component of this rank's part of a sum: those of all ranks
/// add up to the total.
template <class Sum, class Visit>
void visit_part(const Sum& sum, Visit&& visit)
{
  visit_raw(sum, visit);
}
template <class Visit>
void visit_part(const NodalSums& sums, Visit&& visit)
{
  const auto [first, end] = sums.own();
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const VectorSum sum = k >= first && k < end ? sums.sum(k) : VectorSum{};
    visit_raw(sum, visit);
  }
}

} // namespace mergel::dem
