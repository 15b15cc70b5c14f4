#pragma once
/// The pair passes: sums over neighbours in gather form. A thread writes only its own particles, and the force of j on
/// i is minus that of i on j bit for bit, so momentum is exact and nothing depends on the number of threads.
#include <memory>
#include <span>
#include <vector>

#include "particles/pair_lists.hpp"
#include "particles/particles.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// What a scene asks of the pair passes; fixed for a run.
struct PairPassSettings {
  Kernel kernel = Kernel::wendland_c2;
  Precision precision = Precision::double_precision;
  bool stress = false;               ///< full stress tensor; otherwise pressure alone
  bool velocity_gradient = false;    ///< store dv_a/dx_b (always with stress)
  bool gradient_correction = false;  ///< make it exact for linear velocity fields
  bool tensor = false;               ///< smoothing tensors instead of lengths (velocity gradients always stored)
  bool coupled = false;              ///< tensor damage cuts the stress (always with stress)
  std::vector<char> cut_by_cracks;   ///< if coupled, by material number: whether its damage tensor cuts pairs
  double viscosity_alpha = 1, viscosity_beta = 2;
  double length_unit = 1;  ///< a power of two near the particle spacing [m]
  Boundary boundary;
};

template <int Dim>
class PairPass {
 public:
  virtual ~PairPass() = default;

  /// Density by summation: rho_i = sum_j m_j W(r_ij, h_i), and the zeroth moment.
  /// reads position, smoothing_length, mass; writes density, neighbour_sum.
  virtual void density(Particles<Dim>& particles, const PairLists<Dim>& lists) = 0;

  /// Rates by pair forces, with sigma = -P I + S and the gradient averaged over both particles' h:
  ///   dv_i/dt = sum_j m_j (sigma_i/rho_i^2 + sigma_j/rho_j^2 - Pi_ij I) . grad_i W_ij
  ///   du_i/dt = sum_j m_j (v_j - v_i) . (sigma_i/rho_i^2 - Pi_ij/2 I) . grad_i W_ij
  ///   dv_a/dx_b = 1/rho_i sum_j m_j (v_j - v_i)_a (grad_i W_ij)_b, times the inverse of the same sum over (x_j - x_i)
  ///               if corrected
  /// [Monaghan 2005, eqs 2.37, 3.3; Randles & Libersky 1996 for the correction]; Pi is Monaghan's viscosity (1992),
  /// with the switch of Balsara (1995) and (1/rho_i + 1/rho_j)/2 as its 1/rho. The energy rate is each side's own share
  /// of the work of the pair force, so the two shares of a pair add up to all of it.
  /// Coupled, S is what cracks let through (cracked_stress.hpp), and coupled_gradient is the velocity gradient summed
  /// with weights f_ij = 1 - max(n.D_i n, n.D_j n), n the direction of the pair (D = 0 where a material is not cut): an
  /// opening crack does not strain the matter beside it. It is always corrected, so that cracked matter turns with its
  /// body.
  /// Reads what PairRecord::pack reads; writes acceleration, heating, neighbour_sum, approach_speed, velocity_gradient,
  /// coupled_gradient.
  virtual void rates(Particles<Dim>& particles, const PairLists<Dim>& lists, std::span<const double> intact) = 0;

  virtual std::size_t bytes() const = 0;
};

/// Number of particles per cluster that the passes of this precision expect in the lists.
inline std::size_t cluster_size(Precision precision) { return precision == Precision::mixed ? 16 : 8; }

template <int Dim>
std::unique_ptr<PairPass<Dim>> make_pair_pass(const PairPassSettings& settings);

}  // namespace ejecta
