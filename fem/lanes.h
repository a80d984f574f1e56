/// Arithmetic of several elements at a time (SIMD), for a kernel that is a template over
/// `Real`: double, or Lanes with one element a lane. A lane gets the same bits as a double.
#pragma once

#include <cmath>

namespace mergel::fem {

/// As many as the processor has in one register.
#ifdef __AVX512F__
inline constexpr int n_lanes = 8;
#else
inline constexpr int n_lanes = 4;
#endif
using Lanes [[gnu::vector_size(n_lanes * sizeof(double))]] = double;
using LaneMask = decltype(Lanes{} < Lanes{}); ///< all bits set where true

inline double square_root(double a)
{
  return std::sqrt(a);
}
inline Lanes square_root(const Lanes& a)
{
  alignas(
      sizeof(Lanes)) double each[n_lanes]; // a loop over an array becomes one instruction
  __builtin_memcpy(each, &a, sizeof each);
  for (double& x : each) x = std::sqrt(x);
  Lanes root;
  __builtin_memcpy(&root, each, sizeof root);
  return root;
}

inline double choose(bool m, double a, double b)
{
  return m ? a : b;
}
inline Lanes choose(const LaneMask& m, const Lanes& a, const Lanes& b)
{
  return m ? a : b;
}

/// Three numbers, each of type double or Lanes.
template <class Real>
struct Vector {
  Real x, y, z;

  friend Vector operator+(const Vector& a, const Vector& b)
  {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend Vector operator-(const Vector& a, const Vector& b)
  {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend Vector operator*(const Vector& a, const Real& s)
  {
    return {a.x * s, a.y * s, a.z * s};
  }
  friend Real dot(const Vector& a, const Vector& b)
  {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  friend Vector cross(const Vector& a, const Vector& b)
  {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};

} // namespace mergel::fem
