#pragma once
/// Vectors, tensors and sums of them with a particle in every lane.
#include "base/simd.hpp"
#include "base/types.hpp"

namespace ejecta {

/// y = A x and x.y for a symmetric A (order: base/types.hpp).
template <int Dim, class A, class V>
V quadratic_form(const A& a, const V (&x)[Dim], V (&y)[Dim]) {
  if constexpr (Dim == 2) {
    y[0] = a[0] * x[0] + a[2] * x[1];
    y[1] = a[2] * x[0] + a[1] * x[1];
    return x[0] * y[0] + x[1] * y[1];
  } else {
    y[0] = a[0] * x[0] + a[3] * x[1] + a[4] * x[2];
    y[1] = a[3] * x[0] + a[1] * x[1] + a[5] * x[2];
    y[2] = a[4] * x[0] + a[5] * x[1] + a[2] * x[2];
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
  }
}

namespace pair_detail {

template <int Dim, class V>
V dot(const V (&a)[Dim], const V (&b)[Dim]) {
  V sum = a[0] * b[0];
  for (int k = 1; k < Dim; ++k) sum += a[k] * b[k];
  return sum;
}

/// ((A + Sign B - pressure I) . g)_a with tensors stored row by row, or one number each for isotropic stresses. The
/// same number wherever it is inlined.
template <bool Stress, int Dim, int Sign = 1, class TensorA, class TensorB, class V>
[[gnu::always_inline]] inline void contract(const TensorA& A, const TensorB& B, V pressure, const V (&g)[Dim],
                                            V (&f)[Dim]) {
  const auto both = [&](int k) {
    const V sum = Sign > 0 ? V(A[k] + B[k]) : V(A[k] - B[k]);
    return Sign > 0 && (!Stress || k % (Dim + 1) == 0) ? V(sum - pressure) : sum;
  };
  for (int a = 0; a < Dim; ++a) {
    f[a] = both(Stress ? a * Dim : 0) * g[Stress ? 0 : a];
    if constexpr (Stress)
      for (int b = 1; b < Dim; ++b) f[a] = simd::fused(both(a * Dim + b), g[b], f[a]);
  }
}

/// T : L of lane k for the same storage.
template <bool Stress, int Dim, class V, int N>
double double_contract(const V (&t)[N], int k, const Mat<Dim>& L) {
  if constexpr (!Stress) return static_cast<double>(t[0][k]) * L.trace();
  double sum = 0;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) sum += static_cast<double>(t[Stress ? a * Dim + b : 0][k]) * L(a, b);
  return sum;
}

/// The products x_a x_b in the order of symmetric tensors.
template <class V, int Dim>
struct Squares {
  V products[symmetric_size<Dim>];

  explicit Squares(const V (&x)[Dim]) {
    for (int a = 0, k = Dim; a < Dim; ++a) {
      products[a] = x[a] * x[a];
      for (int b = a + 1; b < Dim; ++b, ++k) products[k] = x[a] * x[b];
    }
  }
  /// x . e x for e with twice what is off its diagonal; the same number seen from either side of a pair.
  V along(const V (&e)[symmetric_size<Dim>]) const {
    return sum_of([&](int k) { return e[k]; });
  }
  template <class T>
  V along(const T* e) const {
    return sum_of([&](int k) { return simd::all<V>(e[k]); });
  }

 private:
  template <class Component>
  V sum_of(Component&& e) const {
    V sum = e(0) * products[0];
    for (int k = 1; k < symmetric_size<Dim>; ++k) sum = simd::fused(e(k), products[k], sum);
    return sum;
  }
};

/// Sum over partners of a b^T.
template <class V, int Dim>
struct TensorSum {
  V sum[Dim * Dim] = {};
  void add(const V (&a)[Dim], const V (&b)[Dim]) {
    for (int r = 0; r < Dim; ++r)
      for (int c = 0; c < Dim; ++c) sum[r * Dim + c] += a[r] * b[c];
  }
  Mat<Dim> of_lane(int lane) const {
    Mat<Dim> m;
    for (int r = 0; r < Dim; ++r)
      for (int c = 0; c < Dim; ++c) m(r, c) = static_cast<double>(sum[r * Dim + c][lane]);
    return m;
  }
};

/// Sum over partners of a b^T where b is along a.
template <class V, int Dim>
struct SymmetricSum {
  V sum[symmetric_size<Dim>] = {};
  void add(const V (&a)[Dim], const V (&b)[Dim]) {
    for (int r = 0, k = Dim; r < Dim; ++r) {
      sum[r] += a[r] * b[r];
      for (int c = r + 1; c < Dim; ++c, ++k) sum[k] += a[r] * b[c];
    }
  }
  Mat<Dim> of_lane(int lane) const {
    Symmetric<Dim> m;
    for (int k = 0; k < symmetric_size<Dim>; ++k) m[k] = static_cast<double>(sum[k][lane]);
    return matrix_of<Dim>(m);
  }
};

/// Sum over partners of (a h)^2 with the own smoothing length, or of |H^-1 a|^2 with the own metric G = H H.
template <class V, int Dim, bool Ellipsoidal>
struct SquareSum {
  V sum{};
  void add(const V (&a)[Dim]) { sum += dot(a, a); }
  double of_lane(int lane, double h) const { return h * h * static_cast<double>(sum[lane]); }
};
template <class V, int Dim>
struct SquareSum<V, Dim, true> {
  SymmetricSum<V, Dim> sum;
  void add(const V (&a)[Dim]) { sum.add(a, a); }
  double of_lane(int lane, const Mat<Dim>& metric) const { return (metric.inverse() * sum.of_lane(lane)).trace(); }
};

}  // namespace pair_detail
}  // namespace ejecta
