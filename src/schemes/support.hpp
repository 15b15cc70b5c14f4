#pragma once
/// Support axis of a scheme: how the smoothing of two particles makes the kernel gradient of their pair. Lanes i
/// against one partner j; the gradient is the mean of those with the smoothing of i and of j, so it is antisymmetric.
#include "schemes/kernels.hpp"
#include "schemes/lane_algebra.hpp"
#include "schemes/pair_records.hpp"

namespace ejecta {

namespace support_detail {
/// A particle is its own partner too: the guard keeps a distance of 0 finite, and x_j - x_i = 0 makes all its terms
/// vanish.
template <class S>
constexpr S guard = sizeof(S) == sizeof(float) ? S(1e-30) : S(1e-200);
}  // namespace support_detail

/// Division is dear: two fractions can share one.
template <class V>
struct Fraction {
  V over, under;
};

/// What the kernels of both make of a pair.
template <class V>
struct KernelValues {
  V own;     ///< W(x_ij, h_i) without its norm
  V moment;  ///< |dW/deta| at eta_i, without its norm
  V others;  ///< W(x_ij, h_j) over the norm of the kernel [1/length_unit^Dim]
};

/// Isotropic smoothing length h (SPH).
template <class V, int Dim, class K, class R>
struct IsotropicSupport {
  using S = kernel_detail::Scalar<V>;
  V h, reach_reciprocal, reach2, slope_norm;  ///< of the lanes i

  template <class Load>
  explicit IsotropicSupport(const Load& load)
      : h(load(R::h)), reach_reciprocal(load(R::reach_reciprocal)), slope_norm(load(R::slope_norm)) {
    reach2 = S(1) / (reach_reciprocal * reach_reciprocal);
  }

  struct Pair {
    V slope;  ///< grad_i W_ij = slope (x_j - x_i); 0 exactly where neither reaches the other
    /// > 0 exactly where one reaches the other.
    V reach() const { return slope; }
    template <class Factor>
    void gradient(const V (&dx)[Dim], Factor factor, V (&g)[Dim]) const {
      const V scaled = factor * slope;
      for (int a = 0; a < Dim; ++a) g[a] = scaled * dx[a];
    }
    /// The same with a direction along the pair: central(...) (x_j - x_i).
    V central(const V (&)[Dim], V) const { return slope; }
  };

  /// r2 = |x_j - x_i|^2; `j` is the record of the partner; moment: |dW/deta| at eta_i = r/h_i, over moment_scale.
  Pair pair(const V (&)[Dim], V r2, const S* j, V& moment) const {
    const V r = simd::square_root(V(K::reduced_over_r ? V(r2 + support_detail::guard<S>) : r2));
    const V a_i = kernel_detail::positive(V(S(1) - r * reach_reciprocal)),
            a_j = kernel_detail::positive(V(S(1) - r * j[R::reach_reciprocal]));
    const V slope_i = K::reduced_slope(a_i), slope_j = K::reduced_slope(a_j);
    // Each product is rounded before the sum, so that the pair seen from j gives the same number.
    V slope = simd::rounded(V(slope_i * slope_norm)) + simd::rounded(V(slope_j * j[R::slope_norm]));
    if constexpr (K::reduced_over_r) {
      slope /= r;
      moment = slope_i;
    } else {
      moment = slope_i - a_i * slope_i;  // q = support (1 - a)
    }
    return {slope};
  }
  static constexpr double moment_scale = K::reduced_scale * (K::reduced_over_r ? 1 : K::support);

  /// The value in lanes whose own kernel reaches the partner, else 0.
  V within(const Pair&, V r2, V value) const { return r2 < reach2 ? value : V{}; }

  /// Speed of approach in Monaghan's viscosity (1992): mu = h v.x / (r^2 + 0.01 h^2) <= 0, with h the mean of both;
  /// `closing` is v.x.
  Fraction<V> approach(const Pair&, V r2, V closing, const S* j) const {
    const V tenth = h + j[R::h];
    return {S(10) * tenth * simd::min(closing, V{}), r2 + tenth * tenth};
  }

  /// h of the particle of a record [unit].
  static double scale(const S* record) { return 20 * static_cast<double>(record[R::h]); }

  KernelValues<V> values(const V (&)[Dim], V r2, const S* j) const {
    const V r = S(K::support) * simd::square_root(V(r2 + support_detail::guard<S>)), q = r * reach_reciprocal;
    const S n = S(K::support) * j[R::reach_reciprocal];
    return {K::value(q), -q * K::slope_over_q(q, V(simd::reciprocal(V(q + support_detail::guard<S>)))),
            (Dim == 2 ? n * n : n * n * n) * K::value(V(r * j[R::reach_reciprocal]))};
  }
  /// Norm of the kernel of lane k [1/unit^Dim].
  double norm(int k) const {
    const double n = K::support * static_cast<double>(reach_reciprocal[k]);
    return K::template norm<Dim> * (Dim == 2 ? n * n : n * n * n);
  }
};

/// Smoothing tensor H by its metric G = H H (ASPH): W = norm det(H) w(|H x|), grad W = norm det(H) w'/|H x| G x
/// [Owen et al. 1998; Owen 2010].
template <class V, int Dim, class K, class R>
struct EllipsoidalSupport {
  using S = kernel_detail::Scalar<V>;
  V metric[symmetric_size<Dim>], slope_norm;  ///< of the lanes i

  template <class Load>
  explicit EllipsoidalSupport(const Load& load) : slope_norm(load(R::slope_norm)) {
    for (int s = 0; s < symmetric_size<Dim>; ++s) metric[s] = load(R::metric + s);
  }

  struct Pair {
    V along[Dim];  ///< grad_i W_ij
    V own;         ///< > 0 exactly where lane i reaches the partner
    V weight;      ///< > 0 exactly where one reaches the other
    V mean_eta;
    V reach() const { return weight; }
    template <class Factor>
    void gradient(const V (&)[Dim], Factor factor, V (&g)[Dim]) const {
      for (int a = 0; a < Dim; ++a) g[a] = factor * along[a];
    }
    /// What the gradient is along the pair, central(...) (x_j - x_i): x.G x > 0 keeps its sign.
    V central(const V (&dx)[Dim], V r2) const {
      V sum = along[0] * dx[0];
      for (int a = 1; a < Dim; ++a) sum += along[a] * dx[a];
      return sum * simd::reciprocal(V(r2 + support_detail::guard<S>));
    }
  };

  /// As above, with eta_i = |H_i x| and without the norm of the kernel.
  Pair pair(const V (&dx)[Dim], V, const S* j, V& moment) const {
    V image_i[Dim], image_j[Dim];  // G x
    const V eta2_i = quadratic_form<Dim>(metric, dx, image_i), eta2_j = quadratic_form<Dim>(j + R::metric, dx, image_j);
    const V q_i = eta_of(eta2_i), q_j = eta_of(eta2_j);
    const V slope_i = slope_of(q_i), slope_j = slope_of(q_j);
    const V weight_i = simd::rounded(V(slope_i * slope_norm)), weight_j = simd::rounded(V(slope_j * j[R::slope_norm]));
    constexpr S half = static_cast<S>(0.5 * K::reduced_scale);
    Pair p;
    // As above: products are rounded before the sum.
    for (int a = 0; a < Dim; ++a)
      p.along[a] = half * (simd::rounded(V(weight_i * image_i[a])) + simd::rounded(V(weight_j * image_j[a])));
    moment = q_i * slope_i;
    p.own = weight_i;
    p.weight = weight_i + weight_j;
    p.mean_eta = S(0.5) * (q_i + q_j);
    return p;
  }

  static constexpr double moment_scale = K::reduced_scale;

  V within(const Pair& p, V, V value) const { return p.own > S(0) ? value : V{}; }

  /// Monaghan's mu with eta, the mean of both, in place of r/h: mu = (v.x/r) eta/(eta^2 + 0.01).
  Fraction<V> approach(const Pair& p, V r2, V closing, const S*) const {
    const V eta = p.mean_eta;
    return {simd::min(closing, V{}) * simd::reciprocal_sqrt(V(r2 + support_detail::guard<S>)) * eta,
            eta * eta + S(0.01)};
  }

  /// G of the particle of a record [1/unit^2].
  static Mat<Dim> scale(const S* record) {
    Symmetric<Dim> g;
    for (int s = 0; s < symmetric_size<Dim>; ++s) g[s] = static_cast<double>(record[R::metric + s]);
    return matrix_of<Dim>(g);
  }

  KernelValues<V> values(const V (&dx)[Dim], V, const S* j) const {
    V image[Dim];
    const V own2 = quadratic_form<Dim>(metric, dx, image), others2 = quadratic_form<Dim>(j + R::metric, dx, image);
    const V reciprocal = simd::reciprocal_sqrt(V(own2 + support_detail::guard<S>)), q = own2 * reciprocal;
    const V other_q = others2 * simd::reciprocal_sqrt(V(others2 + support_detail::guard<S>));
    constexpr S per_norm = static_cast<S>(1 / K::template norm<Dim>);
    return {K::value(q), -q * K::slope_over_q(q, reciprocal), per_norm * j[R::slope_norm] * K::value(other_q)};
  }
  double norm(int k) const { return static_cast<double>(slope_norm[k]); }

 private:
  static V eta_of(V eta2) {
    return simd::square_root(V(K::reduced_over_r ? V(eta2 + support_detail::guard<S>) : eta2));
  }
  /// -W'(q)/q over reduced_scale.
  static V slope_of(V q) {
    constexpr S per_support = static_cast<S>(1 / K::support);
    const V slope = K::reduced_slope(kernel_detail::positive(V(S(1) - per_support * q)));
    return K::reduced_over_r ? V(slope / q) : slope;
  }
};

}  // namespace ejecta
