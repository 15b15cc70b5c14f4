#pragma once
#include "base/simd.hpp"
#include "schemes/columns.hpp"
#include "schemes/flux.hpp"
#include "schemes/kernels.hpp"
#include "schemes/lane_algebra.hpp"
#include "schemes/pair_pass.hpp"
#include "schemes/support.hpp"

namespace ejecta {

namespace pair_detail {

/// How fast the strain x.e x that a pair shares closes its gap, where it is what closes it (`along`, v.x): the harmonic
/// mean of both sides, 0 where one side opens, and fading where it differs by more than `trust` from what happens.
/// Of either side twice the strain is handed in: the mean is their product over their sum.
template <class V>
[[gnu::always_inline]] inline V smooth_closing(V ours, V theirs, V along) {
  using T = kernel_detail::Scalar<V>;
  constexpr T trust = T(0.3), guard = sizeof(T) == sizeof(float) ? T(1e-15) : T(1e-60);
  ours = simd::min(ours, V{});
  theirs = simd::min(theirs, V{});
  const V product = ours * theirs, sum = (ours + theirs) - guard;  // mean = product / sum <= 0
  const V trusted = trust * simd::magnitude(along) + guard;
  const V quotient = simd::reciprocal(V(sum * trusted));               // one division for both
  const V off = simd::magnitude(V(product - along * sum)) * quotient;  // <= 0
  return product * trusted * quotient * simd::max(simd::min(V(T(2) + off), V{} + T(1)), V{});
}

/// The symmetric part of a velocity gradient [1/s], with what is off its diagonal twice.
template <int Dim>
Symmetric<Dim> rate_of_strain(const Mat<Dim>& L) {
  Symmetric<Dim> e;
  for (int a = 0, k = Dim; a < Dim; ++a) {
    e[a] = L(a, a);
    for (int b = a + 1; b < Dim; ++b, ++k) e[k] = L(a, b) + L(b, a);
  }
  return e;
}

}  // namespace pair_detail

/// Monaghan's viscosity (1992), q_ij of PairPass::rates: f rho_ij (-alpha c mu + beta mu^2).
struct MonaghanViscosity {
  static constexpr bool whole = false, uneven = false, closing_only = true;

  /// Reads where they exist viscosity_factor, shock_switch and velocity_gradient.
  template <int Dim, bool Strained>
  class Record {
   public:
    static constexpr int factor = 0;                            ///< half of viscosity_factor
    static constexpr int smooth = factor + 1;                   ///< half of 1 - shock_switch, if strained
    static constexpr int strain = smooth + (Strained ? 1 : 0);  ///< 2 e_xx, 2 e_yy, 4 e_xy | ..., times length_unit
    static constexpr int size = strain + (Strained ? symmetric_size<Dim> : 0);

    Record(const Particles<Dim>& particles, const RecordScales& scales)
        : particles_(particles),
          factor_(particles, Field::viscosity_factor),
          shocked_(particles, Field::shock_switch),
          length_unit_(scales.length_unit) {}

    template <class T>
    void pack(std::size_t i, T* places) const {
      places[factor] = factor_.count ? static_cast<T>(0.5 * factor_(0, i)) : T(0.5);
      if constexpr (Strained) {
        places[smooth] = shocked_.count ? static_cast<T>(0.5 * (1 - shocked_(0, i))) : T(0);
        const Symmetric<Dim> rate = pair_detail::rate_of_strain<Dim>(particles_.tensor(Field::velocity_gradient, i));
        for (int k = 0; k < symmetric_size<Dim>; ++k) places[strain + k] = static_cast<T>(2 * rate[k] * length_unit_);
      }
    }
    template <class T>
    static void mirror(T* places, int axis) {
      if constexpr (Strained) mirror_symmetric<Dim>(places + strain, axis);
    }

   private:
    const Particles<Dim>& particles_;
    Columns<Dim, const double> factor_, shocked_;
    double length_unit_;
  };

  template <class V, int Dim, class R, bool Strained>
  class Lanes {
    using T = kernel_detail::Scalar<V>;
    using Places = Record<Dim, Strained>;

   public:
    template <class Load>
    Lanes(Load&& load, const PairPassSettings& settings)
        : density_(load(R::density)),
          twice_reference_(T(2) * load(R::reference)),
          sound_speed_(load(R::sound_speed)),
          factor_(load(R::flux + Places::factor)),
          half_alpha_(static_cast<T>(0.5 * settings.viscosity_alpha)),
          beta_(static_cast<T>(settings.viscosity_beta)) {
      if constexpr (Strained) {
        smooth_ = load(R::flux + Places::smooth);
        for (int s = 0; s < symmetric_size<Dim>; ++s) strain_[s] = load(R::flux + Places::strain + s);
      }
    }

    [[gnu::always_inline]] Jump<V> jump(const V (&dx)[Dim], V along, const T* j) const {
      const T* places = j + R::flux;
      Jump<V> jump{along, factor_ + places[Places::factor]};
      if constexpr (Strained) {
        const pair_detail::Squares<V, Dim> squares(dx);
        const V shared =
            pair_detail::smooth_closing(squares.along(strain_), squares.along(places + Places::strain), along);
        jump.closing -= simd::rounded(V((smooth_ + places[Places::smooth]) * shared));
      }
      return jump;
    }

    template <class Support, class Partner>
    [[gnu::always_inline]] PairFlux<V> between(const Support& support, const Partner& p, V closing, V share) const {
      const T* j = p.record;
      const Fraction<V> approach = support.approach(p.pair, p.r2, closing, j);
      const V densities = density_ + j[R::density], quotient = simd::reciprocal(V(approach.under * densities));
      const V mu = approach.over * (densities * quotient);
      // r_i r_j rho_ij, with rho_ij the harmonic mean of both
      const V mean_density = twice_reference_ * j[R::reference] * (approach.under * quotient);
      return {share * mean_density * (mu * (beta_ * mu - half_alpha_ * (sound_speed_ + j[R::sound_speed]))), mu};
    }

   private:
    V density_, twice_reference_, sound_speed_, factor_, smooth_{}, strain_[symmetric_size<Dim>]{};
    T half_alpha_, beta_;
  };
};

}  // namespace ejecta
