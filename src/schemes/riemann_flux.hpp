#pragma once
/// Godunov SPH: two neighbours exchange what the Riemann problem between them gives, on the line between them, of
/// states that limited linear slopes bring to its middle. With a face that is a gradient of kernels [Inutsuka 2002, J.
/// Comput. Phys. 179, 238; Cha & Whitworth 2003, Mon. Not. R. Astron. Soc. 340, 73] or one whose gradients are exact
/// for linear fields [Lanson & Vila 2008, SIAM J. Numer. Anal. 46, 1912; Hopkins 2015, Mon. Not. R. Astron. Soc. 450,
/// 53]:
///   m_i dv_i/dt = -sum_j 2 V_i V_j p* a_ij,   m_i du_i/dt = -sum_j 2 V_i V_j p* a_ij.(v* - v_i),
///   a_ij = g_ij/(that of the lattice) or (B_i + B_j)/2 g_ij,
/// v* the mean of both velocities, but along the pair that between the waves.
#include <limits>

#include "base/simd.hpp"
#include "schemes/columns.hpp"
#include "schemes/flux.hpp"
#include "schemes/kernels.hpp"
#include "schemes/lane_algebra.hpp"
#include "schemes/monaghan_viscosity.hpp"
#include "schemes/pair_pass.hpp"
#include "schemes/riemann_star.hpp"
#include "schemes/support.hpp"

namespace ejecta {

namespace pair_detail {

/// The least of three of one sign, else 0. Odd: of the negatives it is the negative.
template <class V>
[[gnu::always_inline]] inline V least_of_one_sign(V a, V b, V c) {
  return simd::max(simd::min(simd::min(a, b), c), V{}) + simd::min(simd::max(simd::max(a, b), c), V{});
}

/// How much a quantity changes from a particle to its neighbour, of which half is taken to the middle: by its own
/// slope, limited by twice the difference of both and twice what the slope makes of the particle on the other side, s -
/// (d - s) [van Leer 1977, J. Comput. Phys. 23, 276].
template <class V>
[[gnu::always_inline]] inline V monotonised_central(V slope, V difference) {
  using T = kernel_detail::Scalar<V>;
  return least_of_one_sign(slope, V(T(2) * (T(2) * slope - difference)), V(T(2) * difference));
}

}  // namespace pair_detail

struct RiemannFlux {
  static constexpr bool whole = true;

  /// Reads pressure, density, sound_speed, where they exist density_gradient, pressure_gradient, velocity_gradient,
  /// face_correction and wall, and with conduction specific_energy and smoothing_length.
  template <int Dim, bool Strained>
  class Record {
   public:
    static constexpr int pressure = 0;
    static constexpr int gamma = pressure + 1;         ///< rho c^2/P
    static constexpr int wall = gamma + 1;             ///< 1: nothing passes to others that have it too
    static constexpr int density_gradient = wall + 1;  ///< gradients by length_unit
    static constexpr int pressure_gradient = density_gradient + Dim;
    static constexpr int strain = pressure_gradient + Dim;  ///< e_xx e_yy 2 e_xy | ...
    static constexpr int correction = strain + symmetric_size<Dim>;
    static constexpr int energy = correction + Dim * Dim;  ///< specific
    static constexpr int conduction = energy + 1;          ///< H
    static constexpr int size = conduction + 1;

    Record(const Particles<Dim>& particles, const RecordScales& scales)
        : particles_(particles),
          pressure_(particles, Field::pressure),
          density_(particles, Field::density),
          sound_speed_(particles, Field::sound_speed),
          density_gradient_(particles, Field::density_gradient),
          pressure_gradient_(particles, Field::pressure_gradient),
          correction_(particles, Field::face_correction),
          wall_(particles, Field::wall),
          energy_(particles, Field::specific_energy),
          h_(particles, Field::smoothing_length),
          scales_(scales) {}

    template <class T>
    void pack(std::size_t i, T* places) const {
      const double p = std::max(pressure_(0, i), std::numeric_limits<double>::min()), c = sound_speed_(0, i);
      places[pressure] = static_cast<T>(p);
      places[gamma] = static_cast<T>(std::clamp(density_(0, i) * c * c / p, least_gamma, most_gamma));
      places[wall] = wall_.count == 0 ? T(0) : static_cast<T>(wall_(0, i));
      for (int k = density_gradient; k < size; ++k) places[k] = T(0);
      if (density_gradient_.count == 0) return;
      for (std::size_t a = 0; a < Dim; ++a) {
        places[density_gradient + a] = static_cast<T>(density_gradient_(a, i) * scales_.length_unit);
        places[pressure_gradient + a] = static_cast<T>(pressure_gradient_(a, i) * scales_.length_unit);
      }
      const Symmetric<Dim> rate = pair_detail::rate_of_strain<Dim>(particles_.tensor(Field::velocity_gradient, i));
      for (int k = 0; k < symmetric_size<Dim>; ++k) places[strain + k] = static_cast<T>(rate[k] * scales_.length_unit);
      for (std::size_t k = 0; k < Dim * Dim; ++k) places[correction + k] = static_cast<T>(correction_(k, i));
      if (scales_.linear_conduction == 0 && scales_.quadratic_conduction == 0) return;
      places[energy] = static_cast<T>(energy_(0, i));
      const double h = h_(0, i), closing = std::max(0.0, -particles_.tensor(Field::velocity_gradient, i).trace());
      places[conduction] =
          static_cast<T>(scales_.linear_conduction * h * c + 2 * scales_.quadratic_conduction * h * h * closing);
    }
    template <class T>
    static void mirror(T* places, int axis) {
      places[density_gradient + axis] *= -1;
      places[pressure_gradient + axis] *= -1;
      mirror_symmetric<Dim>(places + strain, axis);
      for (int other = 0; other < Dim; ++other) {
        if (other == axis) continue;
        places[correction + axis * Dim + other] *= -1;
        places[correction + other * Dim + axis] *= -1;
      }
    }

   private:
    /// Matter without pressure has no adiabatic index; gases have one between these.
    static constexpr double least_gamma = 1 + 1e-6, most_gamma = 10;
    const Particles<Dim>& particles_;
    Columns<Dim, const double> pressure_, density_, sound_speed_, density_gradient_, pressure_gradient_, correction_,
        wall_, energy_, h_;
    RecordScales scales_;
  };

  template <class V, int Dim, class R, bool Strained>
  class Lanes {
    using T = kernel_detail::Scalar<V>;
    using Places = Record<Dim, Strained>;

   public:
    template <class Load>
    Lanes(Load&& load, const PairPassSettings& settings)
        : settings_(*settings.godunov),
          density_(load(R::density)),
          sound_speed_(load(R::sound_speed)),
          expansion_(load(R::expansion)),
          pressure_(load(R::flux + Places::pressure)),
          gamma_(load(R::flux + Places::gamma)),
          wall_(load(R::flux + Places::wall)),
          energy_(load(R::flux + Places::energy)),
          conduction_(load(R::flux + Places::conduction)),
          per_lattice_(static_cast<T>(1 / settings.godunov->lattice_gradient)) {
      for (int a = 0; a < Dim; ++a) {
        density_gradient_[a] = load(R::flux + Places::density_gradient + a);
        pressure_gradient_[a] = load(R::flux + Places::pressure_gradient + a);
      }
      for (int k = 0; k < symmetric_size<Dim>; ++k) strain_[k] = load(R::flux + Places::strain + k);
      for (int k = 0; k < Dim * Dim; ++k) correction_[k] = load(R::flux + Places::correction + k);
    }

    template <class Partner>
    [[gnu::always_inline]] WholeFlux<V, Dim> across(const Partner& p, V along) const {
      const T* j = p.record;
      const T* theirs = j + R::flux;
      WholeFlux<V, Dim> flux;
      set_face(p, theirs, flux.face);
      const V per_r = simd::reciprocal_sqrt(V(p.r2 + support_detail::guard<T>)), apart = along * per_r;
      const States states = settings_.limiter == PairLimiter::none ? as_they_are(theirs, j, apart)
                                                                   : in_the_middle(p, theirs, j, per_r, apart);
      StarState<V> star;
      if (settings_.riemann == PairRiemann::exact) [[unlikely]]
        star = exact_star(states.ours, states.theirs, states.apart);
      else
        star = approximate_star(states.ours, states.theirs, states.apart);
      flux.pressure = T(2) * (expansion_ * j[R::expansion]) * (T(1) - wall_ * theirs[Places::wall]) * star.pressure;
      // u* beyond the mean of both velocities along the pair.
      const V drift = T(0.5) * ((star.faster_right - star.faster_left) + states.faster);
      flux.drift = drift * per_r * pair_detail::dot(flux.face, p.dx);
      flux.approach = simd::min(apart, V{});
      return flux;
    }

    /// Times m_j it is what the specific energy of i gains by conduction; seen from j, the negative.
    template <class Partner>
    [[gnu::always_inline]] V conducted(const Partner& p) const {
      const T* theirs = p.record + R::flux;
      const V density = density_ + p.record[R::density], both = conduction_ + theirs[Places::conduction];
      return T(2) * both * simd::reciprocal(density) * (theirs[Places::energy] - energy_) * p.central();
    }

   private:
    struct States {
      MeetingGas<V> ours, theirs;
      V apart;   ///< velocity of theirs less ours, along the pair
      V faster;  ///< by how much the mean of both is faster than that of the particles
    };

    template <class Partner>
    void set_face(const Partner& p, const T* theirs, V (&face)[Dim]) const {
      V g[Dim];
      p.kernel_gradient(g);
      if (settings_.faces == PairFaces::kernel) {
        for (int a = 0; a < Dim; ++a) face[a] = per_lattice_ * g[a];
        return;
      }
      for (int a = 0; a < Dim; ++a) {
        V sum{};
        for (int b = 0; b < Dim; ++b) {
          const int k = a * Dim + b;
          sum = simd::fused(V(correction_[k] + theirs[Places::correction + k]), g[b], sum);
        }
        face[a] = T(0.5) * sum;
      }
    }

    States as_they_are(const T* theirs, const T* j, V apart) const {
      return {
          {density_, pressure_, gamma_},
          {simd::all<V>(j[R::density]), simd::all<V>(theirs[Places::pressure]), simd::all<V>(theirs[Places::gamma])},
          apart,
          V{}};
    }

    template <class Partner>
    [[gnu::always_inline]] States in_the_middle(const Partner& p, const T* theirs, const T* j, V per_r, V apart) const {
      States s = as_they_are(theirs, j, apart);
      const pair_detail::Squares<V, Dim> squares(p.dx);
      const V rho_i = slope(density_gradient_, p.dx), rho_j = slope(theirs + Places::density_gradient, p.dx),
              p_i = slope(pressure_gradient_, p.dx), p_j = slope(theirs + Places::pressure_gradient, p.dx),
              u_i = squares.along(strain_) * per_r, u_j = squares.along(theirs + Places::strain) * per_r;
      const V more_density = s.theirs.density - s.ours.density, more_pressure = s.theirs.pressure - s.ours.pressure;
      if (settings_.limiter == PairLimiter::inutsuka) {
        // Inutsuka (2002, sect. 3.4): no slopes of the velocity where they differ in sign, and none at all in strong
        // compression, nor where they would leave no density or pressure.
        const V alike = u_i * u_j > T(0) ? V{} + T(1) : V{};
        const V sound = simd::min(sound_speed_, simd::all<V>(j[R::sound_speed]));
        V keep = T(-3) * apart > sound ? V{} : V{} + T(1);
        const V least = simd::min(simd::min(V(s.ours.density + T(0.5) * rho_i), V(s.theirs.density - T(0.5) * rho_j)),
                                  simd::min(V(s.ours.pressure + T(0.5) * p_i), V(s.theirs.pressure - T(0.5) * p_j)));
        keep = least > T(0) ? keep : V{};
        bring(s, keep * rho_i, keep * rho_j, keep * p_i, keep * p_j, alike * keep * u_i, alike * keep * u_j);
      } else {
        using pair_detail::monotonised_central;
        bring(s, monotonised_central(rho_i, more_density), monotonised_central(rho_j, more_density),
              monotonised_central(p_i, more_pressure), monotonised_central(p_j, more_pressure),
              monotonised_central(u_i, apart), monotonised_central(u_j, apart));
      }
      return s;
    }
    [[gnu::always_inline]] static void bring(States& s, V rho_i, V rho_j, V p_i, V p_j, V u_i, V u_j) {
      s.ours.density += T(0.5) * rho_i;
      s.theirs.density -= T(0.5) * rho_j;
      s.ours.pressure += T(0.5) * p_i;
      s.theirs.pressure -= T(0.5) * p_j;
      s.apart -= T(0.5) * (u_i + u_j);
      s.faster = T(0.5) * (u_i - u_j);
    }

    /// The same number seen from either side, but for its sign.
    template <class Gradient>
    static V slope(const Gradient& gradient, const V (&dx)[Dim]) {
      V sum = gradient[0] * dx[0];
      for (int a = 1; a < Dim; ++a) sum = simd::fused(V(gradient[a] - V{}), dx[a], sum);
      return sum;
    }

    GodunovSettings settings_;
    V density_, sound_speed_, expansion_, pressure_, gamma_, wall_, energy_, conduction_;
    T per_lattice_;
    V density_gradient_[Dim], pressure_gradient_[Dim], strain_[symmetric_size<Dim>], correction_[Dim * Dim];
  };
};

}  // namespace ejecta
