#pragma once
/// Vectors of W lanes on the compiler's vector extensions: arithmetic, comparison and `mask ? a : b` are built in.
/// The pair functions are written once over a value type V and instantiated with these; rounding is that of IEEE
/// arithmetic in every lane, so f(a, b) = -f(b, a) holds bit for bit where the expression is antisymmetric.
#if defined(__AVX512F__) || defined(__AVX2__)
#include <immintrin.h>
#endif
#include <cmath>
#include <cstddef>

namespace ejecta::simd {

template <class T, int W>
struct VectorOf {
  typedef T type __attribute__((vector_size(W * sizeof(T))));
};
/// W lanes of T.
template <class T, int W>
using Vector = typename VectorOf<T, W>::type;

/// Lanes that fill one 64-byte vector: 8 doubles, 16 floats.
template <class T>
inline constexpr int lanes = 64 / sizeof(T);

using Double8 = Vector<double, 8>;
using Float16 = Vector<float, 16>;

inline double max(double a, double b) { return a > b ? a : b; }
inline double min(double a, double b) { return a < b ? a : b; }
#ifdef __AVX512F__
inline Double8 max(Double8 a, Double8 b) { return (Double8)_mm512_max_pd((__m512d)a, (__m512d)b); }
inline Double8 min(Double8 a, Double8 b) { return (Double8)_mm512_min_pd((__m512d)a, (__m512d)b); }
inline Float16 max(Float16 a, Float16 b) { return (Float16)_mm512_max_ps((__m512)a, (__m512)b); }
inline Float16 min(Float16 a, Float16 b) { return (Float16)_mm512_min_ps((__m512)a, (__m512)b); }
/// Bit k: a < b in lane k.
inline unsigned lanes_less(Double8 a, Double8 b) { return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ); }
/// True if a < b in any lane.
inline bool any_less(Double8 a, Double8 b) { return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ) != 0; }
inline bool any_less(Float16 a, Float16 b) { return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ) != 0; }
#else
template <class V>
inline V max(V a, V b) {
  return a > b ? a : b;
}
template <class V>
inline V min(V a, V b) {
  return a < b ? a : b;
}
/// True if a < b in any lane.
template <class V>
bool any_less(V a, V b) {
  bool any = false;
  for (std::size_t k = 0; k < sizeof(V) / sizeof(a[0]); ++k) any |= a[k] < b[k];
  return any;
}
/// Bit k: a < b in lane k.
inline unsigned lanes_less(Double8 a, Double8 b) {
  unsigned bits = 0;
  for (unsigned k = 0; k < 8; ++k) bits |= static_cast<unsigned>(a[k] < b[k]) << k;
  return bits;
}
#endif
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
inline bool any_less(double a, double b) { return a < b; }
inline unsigned lanes_less(double a, double b) { return a < b; }

inline double reciprocal_sqrt(double a) { return 1.0 / std::sqrt(a); }
inline double reciprocal(double a) { return 1.0 / a; }

/// 1/sqrt(a) to a few units in the last place: the 14-bit estimate and Newton steps y <- y (1.5 - a/2 y^2).
inline Double8 reciprocal_sqrt(Double8 a) {
#ifdef __AVX512F__
  Double8 y = (Double8)_mm512_rsqrt14_pd((__m512d)a);
  const Double8 half = 0.5 * a;
  y = y * (1.5 - half * y * y);
  return y * (1.5 - half * y * y);
#else
  Double8 y;
  for (int k = 0; k < 8; ++k) y[k] = 1.0 / std::sqrt(a[k]);
  return y;
#endif
}
inline Float16 reciprocal_sqrt(Float16 a) {
#ifdef __AVX512F__
  const Float16 y = (Float16)_mm512_rsqrt14_ps((__m512)a);
  return y * (1.5f - 0.5f * a * y * y);
#else
  Float16 y;
  for (int k = 0; k < 16; ++k) y[k] = 1.0f / std::sqrt(a[k]);
  return y;
#endif
}

/// 1/a to a few units in the last place.
inline Double8 reciprocal(Double8 a) {
#ifdef __AVX512F__
  Double8 y = (Double8)_mm512_rcp14_pd((__m512d)a);
  y = y * (2.0 - a * y);
  return y * (2.0 - a * y);
#else
  return 1.0 / a;
#endif
}
inline Float16 reciprocal(Float16 a) {
#ifdef __AVX512F__
  const Float16 y = (Float16)_mm512_rcp14_ps((__m512)a);
  return y * (2.0f - a * y);
#else
  return 1.0f / a;
#endif
}

inline double square_root(double a) { return std::sqrt(a); }
inline Double8 square_root(Double8 a) {
#ifdef __AVX512F__
  return (Double8)_mm512_sqrt_pd((__m512d)a);
#else
  for (int k = 0; k < 8; ++k) a[k] = std::sqrt(a[k]);
  return a;
#endif
}
inline Float16 square_root(Float16 a) {
#ifdef __AVX512F__
  return (Float16)_mm512_sqrt_ps((__m512)a);
#else
  for (int k = 0; k < 16; ++k) a[k] = std::sqrt(a[k]);
  return a;
#endif
}

/// The same value, through which the compiler may not fuse a product into a later sum. Needed where a*b + c*d must be
/// the same number as c*d + a*b.
inline double rounded(double a) {
  asm("" : "+x"(a));
  return a;
}
template <class V>
inline V rounded(V a) {
#ifdef __AVX512F__
  asm("" : "+v"(a));
#else
  asm volatile("" : "+m"(a));
#endif
  return a;
}

/// A sum in double precision of values that may come in single precision: W lanes of double in registers.
template <class T>
struct WideSum;
template <>
struct WideSum<double> {
  Double8 sum{};
  void add(double weight, Double8 value) { sum += weight * value; }
  void add_product(double weight, Double8 a, Double8 b) { sum += weight * (a * b); }
  double lane(int k) const { return sum[k]; }
};
template <>
struct WideSum<float> {
  Double8 low{}, high{};
  void add(double weight, Float16 value) {
    low += weight * lower(value);
    high += weight * upper(value);
  }
  /// The product itself is not rounded to single precision.
  void add_product(double weight, Float16 a, Float16 b) {
    low += weight * (lower(a) * lower(b));
    high += weight * (upper(a) * upper(b));
  }
#ifdef __AVX512F__
  static Double8 lower(Float16 v) { return (Double8)_mm512_cvtps_pd(_mm512_castps512_ps256((__m512)v)); }
  static Double8 upper(Float16 v) {
    return (Double8)_mm512_cvtps_pd(_mm256_castpd_ps(_mm512_extractf64x4_pd(_mm512_castps_pd((__m512)v), 1)));
  }
#else
  static Double8 lower(Float16 v) {
    Double8 half;
    for (int k = 0; k < 8; ++k) half[k] = static_cast<double>(v[k]);
    return half;
  }
  static Double8 upper(Float16 v) {
    Double8 half;
    for (int k = 0; k < 8; ++k) half[k] = static_cast<double>(v[k + 8]);
    return half;
  }
#endif
  double lane(int k) const { return k < 8 ? low[k] : high[k - 8]; }
};

}  // namespace ejecta::simd
