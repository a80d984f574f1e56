/// Arithmetic of several pairs at a time (SIMD), for the force kernel.
///
/// A kernel is a template over `Real`: with Real = double it is the scalar law of tests and
/// walls, with Real = Lanes the same source computes one pair per lane of the processor.
/// The IEEE arithmetic of a lane does not depend on the other lanes, and the build switches
/// contraction off: a pair gets the same bits in any lane.
#pragma once

#include "dem/notation.h"

#include <cmath>
#include <cstring>
#include <type_traits>
#ifdef __AVX__
#include <immintrin.h>
#endif

namespace mergel::dem {

/// Eight lanes with AVX-512, else four. With AVX-512 four lanes cost as much time as eight,
/// because the kernel waits for the latency of its operations.
#ifdef __AVX512DQ__
inline constexpr int n_lanes = 8;
#else
inline constexpr int n_lanes = 4;
#endif

using Lanes [[gnu::vector_size(n_lanes * sizeof(double))]] = double;
/// Result of a lane-wise comparison: all bits set where true.
using Mask = decltype(Lanes{} < Lanes{});

/// Four numbers of one record.
using Row [[gnu::vector_size(4 * sizeof(double))]] = double;

/// Two rows of one record, one after the other.
using TwoRows [[gnu::vector_size(8 * sizeof(double))]] = double;

/// The result of a comparison of two V, and its number of lanes.
template <class V>
using MaskOf = decltype(V{} < V{});
template <class V>
inline constexpr int n_lanes_of = sizeof(V) / sizeof(double);

/// Without the sign.
template <class V>
V magnitude(const V& a)
{
  const auto sign = reinterpret_cast<MaskOf<V>>(-V{}); // -0.0: the sign bit alone
  return reinterpret_cast<V>(reinterpret_cast<MaskOf<V>>(a) & ~sign);
}

inline Lanes sqrt(Lanes a)
{
#if defined(__AVX512DQ__)
  return reinterpret_cast<Lanes>(_mm512_maskz_sqrt_pd(0xFF, reinterpret_cast<__m512d>(a)));
#elif defined(__AVX__)
  return reinterpret_cast<Lanes>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(a)));
#else
  for (int k = 0; k < n_lanes; ++k) a[k] = std::sqrt(a[k]);
  return a;
#endif
}
inline double sqrt(double a)
{
  return std::sqrt(a);
}

/// Whether a lane of a mask of any width is set.
template <class M>
requires(sizeof(M) > sizeof(double)) bool any(const M& m)
{
#ifdef __AVX512DQ__
  if constexpr (sizeof(M) == sizeof(__m512i))
    return _mm512_movepi64_mask(reinterpret_cast<__m512i>(m)) != 0;
#endif
#ifdef __AVX__
  if constexpr (sizeof(M) == sizeof(__m256d))
    return _mm256_movemask_pd(reinterpret_cast<__m256d>(m)) != 0;
  if constexpr (sizeof(M) == 2 * sizeof(__m256d))
    return any(__builtin_shufflevector(m, m, 0, 1, 2, 3) |
               __builtin_shufflevector(m, m, 4, 5, 6, 7));
#endif
  long long all = 0;
  for (unsigned k = 0; k < sizeof(M) / sizeof(double); ++k) all |= m[k];
  return all != 0;
}
inline bool any(bool m)
{
  return m;
}

/// The mask of the lanes whose bits are set, the first lane in the lowest bit.
inline Mask lanes_of(unsigned bits)
{
#ifdef __AVX512DQ__
  const Mask bit{1, 2, 4, 8, 16, 32, 64, 128};
#else
  const Mask bit{1, 2, 4, 8};
#endif
  return (bit & static_cast<long long>(bits)) != 0;
}

/// Its inverse.
inline unsigned bits_of(const Mask& m)
{
#if defined(__AVX512DQ__)
  return static_cast<unsigned>(_mm512_movepi64_mask(reinterpret_cast<__m512i>(m)));
#elif defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(m)));
#else
  unsigned bits = 0;
  for (int l = 0; l < n_lanes; ++l) bits |= static_cast<unsigned>(m[l] != 0) << l;
  return bits;
#endif
}

inline Lanes select(Mask m, Lanes a, Lanes b)
{
  return m ? a : b;
}
inline double select(bool m, double a, double b)
{
  return m ? a : b;
}

inline Lanes min(Lanes a, Lanes b)
{
  return select(a < b, a, b);
}
inline double min(double a, double b)
{
  return a < b ? a : b;
}

/// In each group of four lanes: four rows of four numbers to four columns, and back.
inline void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d)
{
#ifdef __AVX512DQ__
  const Lanes ab_low = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes ab_high = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  const Lanes cd_low = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes cd_high = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 8, 9, 4, 5, 12, 13);
  b = __builtin_shufflevector(ab_high, cd_high, 0, 1, 8, 9, 4, 5, 12, 13);
  c = __builtin_shufflevector(ab_low, cd_low, 2, 3, 10, 11, 6, 7, 14, 15);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 10, 11, 6, 7, 14, 15);
#else
  const Lanes ab_low = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Lanes ab_high = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes cd_low = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Lanes cd_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
#endif
}

/// One row per lane to four columns.
inline void columns(const Row (&r)[n_lanes], Lanes& a, Lanes& b, Lanes& c, Lanes& d)
{
#ifdef __AVX512DQ__
  const auto group = [&r](int k) {
    return __builtin_shufflevector(r[k], r[k + 4], 0, 1, 2, 3, 4, 5, 6, 7);
  };
#else
  const auto group = [&r](int k) { return r[k]; };
#endif
  a = group(0);
  b = group(1);
  c = group(2);
  d = group(3);
  transpose(a, b, c, d);
}

/// Four columns to one row per lane.
inline void rows(Lanes a, Lanes b, Lanes c, Lanes d, Row (&r)[n_lanes])
{
  transpose(a, b, c, d);
  const Lanes group[4] = {a, b, c, d};
  for (int k = 0; k < 4; ++k) {
#ifdef __AVX512DQ__
    r[k] = __builtin_shufflevector(group[k], group[k], 0, 1, 2, 3);
    r[k + 4] = __builtin_shufflevector(group[k], group[k], 4, 5, 6, 7);
#else
    r[k] = group[k];
#endif
  }
}

/// Three columns to one row per lane, whose fourth number is 0.
inline void rows(Lanes a, Lanes b, Lanes c, Row (&r)[n_lanes])
{
  Lanes zero{};
#ifdef __AVX512DQ__
  // GCC 12.2 takes c beside a zero that it knows for c beside c (vmovddup).
  asm("" : "+x"(zero));
#endif
  rows(a, b, c, zero, r);
}

/// A vector of the kernel: three numbers of type double or Lanes.
template <class Real>
struct Triple {
  Real x, y, z;

  Triple& operator+=(const Triple& b) { return *this = *this + b; }
  Triple& operator-=(const Triple& b) { return *this = *this - b; }
  friend Triple operator+(const Triple& a, const Triple& b)
  {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend Triple operator-(const Triple& a, const Triple& b)
  {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend Triple operator*(const Triple& a, const Real& s)
  {
    return {a.x * s, a.y * s, a.z * s};
  }
  friend Triple operator*(const Triple& a, double s) requires(!std::is_same_v<Real, double>)
  {
    return {a.x * s, a.y * s, a.z * s};
  }
  friend Real dot(const Triple& a, const Triple& b)
  {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  friend Triple cross(const Triple& a, const Triple& b)
  {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};

template <class Condition, class Real>
Triple<Real> select(const Condition& m, const Triple<Real>& a, const Triple<Real>& b)
{
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}

inline Triple<double> triple(const Vec3& a)
{
  return {a.x(), a.y(), a.z()};
}
inline Vec3 vec3(const Triple<double>& a)
{
  return {a.x, a.y, a.z};
}

/// Read and write one lane.
inline Triple<double> lane(const Triple<Lanes>& a, int k)
{
  return {a.x[k], a.y[k], a.z[k]};
}
inline void set_lane(Triple<Lanes>& a, int k, const Triple<double>& b)
{
  a.x[k] = b.x;
  a.y[k] = b.y;
  a.z[k] = b.z;
}

} // namespace mergel::dem
