#pragma once
/// Vectors of W lanes on the compiler's vector extensions: arithmetic, comparison and `mask ? a : b` are built in.
/// The pair functions are written once over a value type V and instantiated with these; rounding is that of IEEE
/// arithmetic in every lane, so f(a, b) = -f(b, a) holds bit for bit where the expression is antisymmetric.
#include <cmath>
#include <cstddef>

#include "base/intrinsics.hpp"

namespace ejecta::simd {

template <class T, int W>
struct VectorOf {
  typedef T type __attribute__((vector_size(W * sizeof(T))));
};
/// W lanes of T.
template <class T, int W>
using Vector = typename VectorOf<T, W>::type;

/// Bytes of the widest registers that the compiler may use: wider vectors would be taken apart and live in memory.
#ifdef __AVX512F__
inline constexpr int register_size = 64;
#else
inline constexpr int register_size = 32;
#endif

/// Lanes that fill one register.
template <class T>
inline constexpr int lanes = register_size / sizeof(T);

using Doubles = Vector<double, lanes<double>>;
using Floats = Vector<float, lanes<float>>;

/// A number in all lanes. (The compiler drops "- 0", but not "+ 0", which makes 0 of -0.)
template <class V, class T>
[[gnu::always_inline]] inline V all(T value) {
  return value - V{};
}

#ifdef __AVX512F__
// Masks of every lane: with them the intrinsics are the same instructions as without a mask, but do not begin with a
// vector that GCC 12 warns of as uninitialized.
inline constexpr __mmask8 all_doubles = 0xff;
inline constexpr __mmask16 all_floats = 0xffff;
#endif

inline double max(double a, double b) { return a > b ? a : b; }
inline double min(double a, double b) { return a < b ? a : b; }
#if defined(__AVX512F__)
inline Doubles max(Doubles a, Doubles b) { return (Doubles)_mm512_maskz_max_pd(all_doubles, (__m512d)a, (__m512d)b); }
inline Doubles min(Doubles a, Doubles b) { return (Doubles)_mm512_maskz_min_pd(all_doubles, (__m512d)a, (__m512d)b); }
inline Floats max(Floats a, Floats b) { return (Floats)_mm512_maskz_max_ps(all_floats, (__m512)a, (__m512)b); }
inline Floats min(Floats a, Floats b) { return (Floats)_mm512_maskz_min_ps(all_floats, (__m512)a, (__m512)b); }
/// Bit k: a < b in lane k.
inline unsigned lanes_less(Doubles a, Doubles b) { return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ); }
inline unsigned lanes_less(Floats a, Floats b) { return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ); }
#elif defined(__AVX2__)
inline Doubles max(Doubles a, Doubles b) { return (Doubles)_mm256_max_pd((__m256d)a, (__m256d)b); }
inline Doubles min(Doubles a, Doubles b) { return (Doubles)_mm256_min_pd((__m256d)a, (__m256d)b); }
inline Floats max(Floats a, Floats b) { return (Floats)_mm256_max_ps((__m256)a, (__m256)b); }
inline Floats min(Floats a, Floats b) { return (Floats)_mm256_min_ps((__m256)a, (__m256)b); }
/// Bit k: a < b in lane k.
inline unsigned lanes_less(Doubles a, Doubles b) {
  return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd((__m256d)a, (__m256d)b, _CMP_LT_OQ)));
}
inline unsigned lanes_less(Floats a, Floats b) {
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps((__m256)a, (__m256)b, _CMP_LT_OQ)));
}
#else
template <class V>
inline V max(V a, V b) {
  return a > b ? a : b;
}
template <class V>
inline V min(V a, V b) {
  return a < b ? a : b;
}
/// Bit k: a < b in lane k.
template <class V>
unsigned lanes_less(V a, V b) {
  unsigned bits = 0;
  for (std::size_t k = 0; k < sizeof(V) / sizeof(a[0]); ++k) bits |= static_cast<unsigned>(a[k] < b[k]) << k;
  return bits;
}
#endif
inline unsigned lanes_less(double a, double b) { return a < b; }

/// |a|
template <class V>
inline V magnitude(V a) {
  return max(a, V(-a));
}

/// a b + c, rounded once where the processor can: the same number whatever the compiler makes of the code around it.
#if defined(__AVX512F__)
inline Doubles fused(Doubles a, Doubles b, Doubles c) {
  return (Doubles)_mm512_fmadd_pd((__m512d)a, (__m512d)b, (__m512d)c);
}
inline Floats fused(Floats a, Floats b, Floats c) { return (Floats)_mm512_fmadd_ps((__m512)a, (__m512)b, (__m512)c); }
#elif defined(__AVX2__) && defined(__FMA__)
inline Doubles fused(Doubles a, Doubles b, Doubles c) {
  return (Doubles)_mm256_fmadd_pd((__m256d)a, (__m256d)b, (__m256d)c);
}
inline Floats fused(Floats a, Floats b, Floats c) { return (Floats)_mm256_fmadd_ps((__m256)a, (__m256)b, (__m256)c); }
#else
template <class V>
inline V fused(V a, V b, V c) {
  return a * b + c;
}
#endif
/// True if a < b in any lane.
template <class V>
inline bool any_less(V a, V b) {
  return lanes_less(a, b) != 0;
}

/// Lane k of a vector; a number is its only lane.
inline double lane(double a, int) { return a; }
inline void set_lane(double& a, int, double value) { a = value; }
template <class V>
double lane(const V& a, int k) {
  return a[k];
}
template <class V>
void set_lane(V& a, int k, double value) {
  a[k] = value;
}

inline double square_root(double a) { return std::sqrt(a); }
#if defined(__AVX512F__)
inline Doubles square_root(Doubles a) { return (Doubles)_mm512_maskz_sqrt_pd(all_doubles, (__m512d)a); }
Floats square_root(Floats a);
#elif defined(__AVX2__)
inline Doubles square_root(Doubles a) { return (Doubles)_mm256_sqrt_pd((__m256d)a); }
inline Floats square_root(Floats a) { return (Floats)_mm256_sqrt_ps((__m256)a); }
#else
template <class V>
V square_root(V a) {
  for (std::size_t k = 0; k < sizeof(V) / sizeof(a[0]); ++k) a[k] = std::sqrt(a[k]);
  return a;
}
#endif

/// 1/a and 1/sqrt(a) to a few units in the last place. Where there are estimates of 14 bits they come from them by
/// Newton steps y <- y (2 - a y) and y <- y (1.5 - a/2 y^2), where that is faster: roots and quotients of doubles alone
/// keep to units of their own that work beside the multiplications.
template <class V>
inline V reciprocal(V a) {
  return 1 / a;
}
template <class V>
inline V reciprocal_sqrt(V a) {
  return 1 / square_root(a);
}
#ifdef __AVX512F__
inline Floats reciprocal(Floats a) {
  const Floats y = (Floats)_mm512_maskz_rcp14_ps(all_floats, (__m512)a);
  return y * (2.0f - a * y);
}
inline Doubles reciprocal_sqrt(Doubles a) {
  Doubles y = (Doubles)_mm512_maskz_rsqrt14_pd(all_doubles, (__m512d)a);
  const Doubles half = 0.5 * a;
  y = y * (1.5 - half * y * y);
  return y * (1.5 - half * y * y);
}
inline Floats reciprocal_sqrt(Floats a) {
  const Floats y = (Floats)_mm512_maskz_rsqrt14_ps(all_floats, (__m512)a);
  return y * (1.5f - 0.5f * a * y * y);
}
/// To a few units in the last place; 0 of 0.
inline Floats square_root(Floats a) { return a * reciprocal_sqrt(Floats(a + 1e-37f)); }
#endif

/// The same value, through which the compiler may not fuse a product into a later sum. Needed where a*b + c*d must be
/// the same number as c*d + a*b.
inline double rounded(double a) {
  asm("" : "+x"(a));
  return a;
}
template <class V>
inline V rounded(V a) {
#if defined(__AVX512F__)
  asm("" : "+v"(a));
#elif defined(__AVX2__)
  asm("" : "+x"(a));
#else
  asm volatile("" : "+m"(a));
#endif
  return a;
}

/// A sum in double precision of values that may come in single precision: lanes of double in registers.
template <class T>
struct WideSum;
template <>
struct WideSum<double> {
  Doubles sum{};
  void add(double weight, Doubles value) { sum += weight * value; }
  double lane(int k) const { return sum[k]; }
};
template <>
struct WideSum<float> {
  Doubles low{}, high{};
  void add(double weight, Floats value) {
    low += weight * lower(value);
    high += weight * upper(value);
  }
#if defined(__AVX512F__)
  template <int Half>
  static Doubles half(Floats v) {
    const __m256d floats = _mm512_maskz_extractf64x4_pd(0xf, _mm512_castps_pd((__m512)v), Half);
    return (Doubles)_mm512_maskz_cvtps_pd(all_doubles, _mm256_castpd_ps(floats));
  }
  static Doubles lower(Floats v) { return half<0>(v); }
  static Doubles upper(Floats v) { return half<1>(v); }
#elif defined(__AVX2__)
  static Doubles lower(Floats v) { return (Doubles)_mm256_cvtps_pd(_mm256_castps256_ps128((__m256)v)); }
  static Doubles upper(Floats v) { return (Doubles)_mm256_cvtps_pd(_mm256_extractf128_ps((__m256)v, 1)); }
#else
  static Doubles lower(Floats v) {
    Doubles half;
    for (int k = 0; k < lanes<double>; ++k) half[k] = static_cast<double>(v[k]);
    return half;
  }
  static Doubles upper(Floats v) {
    Doubles half;
    for (int k = 0; k < lanes<double>; ++k) half[k] = static_cast<double>(v[k + lanes<double>]);
    return half;
  }
#endif
  double lane(int k) const { return k < lanes<double> ? low[k] : high[k - lanes<double>]; }
};

}  // namespace ejecta::simd
