#pragma once
/// Another flux than that of the program: the acoustic Riemann problem of two gases, as in Godunov SPH. Where the waves
/// of both meet pressure and velocity along the pair are
///   p* = (Z_j p_i + Z_i p_j - Z_i Z_j (u_j - u_i))/(Z_i + Z_j),   u* = (Z_i u_i + Z_j u_j - (p_j - p_i))/(Z_i + Z_j),
/// Z = rho c; i heats by F_ij.(v* - v_i) [Inutsuka 2002; Cha & Whitworth 2003].
#include "base/simd.hpp"
#include "schemes/columns.hpp"
#include "schemes/flux.hpp"
#include "schemes/kernels.hpp"
#include "schemes/pair_pass.hpp"

namespace ejecta {

struct AcousticFlux {
  static constexpr bool whole = false, uneven = true, closing_only = false;

  template <int Dim, bool Strained>
  class Record {
   public:
    static constexpr int pressure = 0, size = 1;
    Record(const Particles<Dim>& particles, const RecordScales&) : pressure_(particles, Field::pressure) {}
    template <class T>
    void pack(std::size_t i, T* places) const {
      places[pressure] = static_cast<T>(pressure_(0, i));
    }
    template <class T>
    static void mirror(T*, int) {}

   private:
    Columns<Dim, const double> pressure_;
  };

  /// For pressures alone, and weights by mass.
  template <class V, int Dim, class R, bool Strained>
  class Lanes {
    using T = kernel_detail::Scalar<V>;

   public:
    template <class Load>
    Lanes(Load&& load, const PairPassSettings&)
        : pressure_(load(R::flux)),
          impedance_(load(R::density) * load(R::sound_speed)),
          expansion_(load(R::expansion)) {
      for (int a = 0; a < Dim; ++a) v_[a] = load(R::v + a);
    }
    Jump<V> jump(const V (&)[Dim], V along, const T*) const { return {along, V{} + T(1)}; }

    template <class Support, class Partner>
    UnevenPairFlux<V> between(const Support&, const Partner& p, V closing, V share) const {
      const T* j = p.record;
      const T p_j = j[R::flux], Z_j = j[R::density] * j[R::sound_speed], r_j = j[R::expansion];
      const V per_r = T(1) / simd::square_root(V(p.r2 + T(1e-20))), jump = closing * per_r, Z = impedance_ + Z_j;
      // Rounded, as what the pair makes of i and of j must be the same number.
      const V left = simd::rounded(V(Z_j * pressure_)), right = simd::rounded(V(impedance_ * p_j));
      const V star = (left + right - simd::rounded(V(impedance_ * Z_j)) * jump) / Z;
      UnevenPairFlux<V> flux;
      flux.pressure = share * (expansion_ * r_j) * (T(2) * star - (pressure_ + p_j));
      flux.approach = simd::min(jump, V{});
      // Along the pair: F.e, and u* beyond the mean of both velocities.
      V g[Dim], across{};
      p.kernel_gradient(g);
      for (int a = 0; a < Dim; ++a) across += g[a] * p.dx[a];
      across *= per_r;
      const V ours = expansion_ * expansion_ * pressure_;
      const T theirs = r_j * r_j * p_j;
      const V force = -(ours + theirs + flux.pressure) * across;
      const V drift = (T(0.5) * (Z_j - impedance_) * jump - (p_j - pressure_)) / Z;
      // The loop gives either side the work of its own pressure; what it should be is F.(v* - v_i).
      V work{};
      for (int a = 0; a < Dim; ++a) work += g[a] * (j[R::v + a] - v_[a]);
      flux.uneven = T(2) * force * drift + (ours - theirs) * work;
      return flux;
    }

   private:
    V pressure_, impedance_, expansion_, v_[Dim];
  };
};

}  // namespace ejecta
