/// Helpers for the rows of a state's arrays: vectors as three columns, ascending order.
#pragma once

#include "dem/io/state/state_file.h"
#include "dem/notation.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

namespace mergel::dem {

inline void append(std::vector<double>& to, const Vec3& a)
{
  to.insert(to.end(), {a.x(), a.y(), a.z()});
}

inline Vec3 vec_at(const std::vector<double>& from, std::size_t k)
{
  return {from[k], from[k + 1], from[k + 2]};
}

/// True for a history that has a bit other than zero.
inline bool is_nonzero(const Vec3& f, double overlap)
{
  const std::array<double, 4> all{f.x(), f.y(), f.z(), overlap}, nothing{};
  return std::memcmp(all.data(), nothing.data(), sizeof all) != 0;
}

/// Row numbers in ascending order of `key`.
/// @throws InputError when a key occurs twice
template <class Key>
std::vector<std::size_t> ascending(const std::string& name, std::size_t n, Key&& key)
{
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  for (std::size_t k = 1; k < n; ++k)
    if (!(key(order[k - 1]) < key(order[k]))) State::refuse(name, "has an entry twice");
  return order;
}

} // namespace mergel::dem
