#pragma once
/// The pair passes: sums over neighbours in gather form (docs/pair_pass.md says how they are built). A thread writes
/// only its own particles, so nothing depends on the number of threads; and the force of j on i is minus that of i on j
/// to round-off, so momentum is exact.
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/simd.hpp"
#include "particles/pair_lists.hpp"
#include "particles/particles.hpp"
#include "scene/choices.hpp"
#include "schemes/pair_records.hpp"

namespace ejecta {

/// Fluxes of Riemann problems in place of pressure and viscosity (GSPH), for gases without stress.
struct GodunovSettings {
  PairRiemann riemann = PairRiemann::approximate;
  PairLimiter limiter = PairLimiter::monotonised_central;
  PairFaces faces = PairFaces::renormalised;
  /// What sums over the lattice give of 1 and of the gradient of x (lattice_sums.hpp): densities and the faces `kernel`
  /// are divided by them.
  double lattice_density = 1, lattice_gradient = 1;
  /// Artificial conduction of heat, g1 and g2 of PairPass::rates().
  double linear_conduction = 0, quadratic_conduction = 0;
  bool conducts() const { return linear_conduction > 0 || quadratic_conduction > 0; }
};

/// What a scene asks of the pair passes; fixed for a run.
struct PairPassSettings {
  Kernel kernel = Kernel::wendland_c2;
  Precision precision = Precision::double_precision;
  bool stress = false;               ///< stress tensors and pieces; otherwise pressure alone
  bool velocity_gradient = false;    ///< store dv_a/dx_b (always with stress)
  bool gradient_correction = false;  ///< make it exact for linear velocity fields, and forces its adjoint (with stress)
  bool asph = false;                 ///< smoothing tensors instead of lengths (velocity gradients always stored)
  bool cracked = false;              ///< tensor damage cuts the stress (always with stress)
  bool bonded = false;               ///< some particles keep the neighbours of the start (always with stress)
  double alike = 4;                  ///< weights are those of masses up to this ratio of densities, see rates()
  double viscosity_alpha = 1, viscosity_beta = 2;
  bool contacts = false;   ///< there are several pieces, or a solid and a wall
  double friction = 0;     ///< coefficient of friction between pieces
  double length_unit = 1;  ///< a power of two near the particle spacing [m]
  std::optional<GodunovSettings> godunov;
  PairRules rules;
};

template <int Dim>
class PairPass {
 public:
  virtual ~PairPass() = default;

  /// Density by summation: rho_i = sum_j m_j W(r_ij, h_i), and the zeroth moment.
  /// reads position, smoothing_length, mass; writes density, zeroth_moment.
  /// With Godunov fluxes neighbours count by number, rho_i = m_i sum_j W(r_ij, h_i)/(that of the lattice): a jump of
  /// the density between particles of one volume stays one. Where there is a filling it is sum_j V_j W(r_ij, h_j)/(that
  /// of the lattice), with the volumes m_j/rho_j that the densities had before.
  virtual void density(Particles<Dim>& particles, const PairLists<Dim>& lists) = 0;

  /// Rates by pair forces. V = m/rho; g_ij is the kernel gradient grad_i W_ij, averaged over both particles' h;
  /// sigma = -P I + S. Within a piece (PairRules):
  ///   R_i = sum_j w_ij v_ji g_ij^T    M_i = sum_j w_ij x_ji g_ij^T    L_i = R_i M_i^-1    T_i = sigma_i M_i^-T
  ///   dv_i/dt = 1/m_i sum_j [(V_i w_ij T_i + V_j w_ji T_j) g_ij - V_i V_j q_ij x_ji (x_ji.g_ij)/r^2]
  ///   du_i/dt = 1/m_i [V_i T_i : R_i - 1/2 sum_j V_i V_j q_ij v_ji.x_ji (x_ji.g_ij)/r^2]
  /// with L = dv_a/dx_b stored (gradient_correction.hpp: what becomes of few neighbours; M = I if not corrected). The
  /// force is the adjoint of the gradient: the work of the stress in L is the heat, and with the viscosity along the
  /// pair linear and angular momentum are exact, whatever the weights.
  ///   w_ij = V0_j r_i s_ij,    V0 = m/rho0,    r = rho0/rho,    rho0 the density of the uncompressed material.
  /// With s = 1 these are the weights m_j/rho_i of standard SPH (between materials, of their initial volumes): the
  /// continuity equation is then the time derivative of the sum over masses, and no error of the density is left behind
  /// by a front that compresses three times. With s_ij = r_j/r_i they are volumes: contacts of very different
  /// densities stay at rest. s goes from one to the other while the densities differ by `alike` to four times that.
  /// q is the flux (flux.hpp); q = f rho_ij (-alpha c mu + beta mu^2) is Monaghan's viscosity (1992), f the mean of
  /// both factors; rho_ij is the harmonic mean, at most twice the lighter one: light matter is not thrown off heavy
  /// matter. In passes without stress q acts along g_ij. Of v.x in mu the part that both particles strain by anyway (by
  /// their velocity gradients of the evaluation before, as in a limited linear reconstruction [van Leer 1979; Frontiere
  /// et al. 2017]) is left out, times 1 - shock_switch: full viscosity in shocks, none in smooth flow, and always what
  /// damps a disordered lattice.
  ///
  /// Particles of different pieces, and a solid and a wall, are no neighbours. From where they come within a particle's
  /// size (PairRecord::contact, t_ij the larger of both) they act on each other by what presses across the contact,
  ///   dv_i/dt += 1/rho_i sum_j V_j [t_ij (a_ij T'_i + a_ji T'_j) g_ij - q_ij x_ji (x_ji.g_ij)/r^2],
  /// T' and the strain that goes with it as in gradient_correction.hpp, a_ij = 2 Z_j/(Z_i + Z_j) with the impedances
  /// Z = rho c: a contact pushes, never pulls, and slides. The viscosity sees what closes the gap beyond what slides.
  /// Friction adds min(mu p, Z |v_t|) against the sliding velocity v_t, p the force across the contact.
  ///
  /// Bonded, particles that hold on to their first neighbours (bond = 1) take W and its gradient at the places of the
  /// start: nothing clumps under tension [Belytschko et al. 2000], and M^-1 brings the deformation in. The pressure
  /// p_ij of hourglass.hpp acts between them as q does, along the pair. Bonded particles of one piece that were further
  /// apart than twice the support meet like strangers.
  ///
  /// Cracked, S is what cracks let through (cracked_stress.hpp), and uncut_gradient L' is the velocity gradient summed
  /// with weights f_ij w_ij, f_ij = 1 - max(n.D_i n, n.D_j n), n the direction of the pair (D = 0 where a material is
  /// not cut): an opening crack does not strain the matter beside it. S, which answers to L', acts by the adjoint of L',
  ///   T_i = -P_i M_i^-T + f_ij S_i M'_i^-T,   m_i du_i/dt = V_i (-P_i tr L_i + S_i : L'_i) + ...,
  /// and works on nothing else.
  ///
  /// With Godunov fluxes forces and heat are those of riemann_flux.hpp, and where there is a compression_rate it is
  ///   (1/rho) drho/dt = -sum_j 2 V_j a_ij.(v* - v_i) + c/h ln(sum_j V_j W(r_ij, h_j)/(that of the lattice)):
  /// what faces sweep, and what makes volumes fill space (density_shares() bounds them). If asked, heat is conducted,
  ///   du_i/dt += sum_j m_j (H_i + H_j)/rho_ij (u_i - u_j) x_ij.g_ij/r^2,    H = g1 h c + g2 h^2 (|div v| - div v),
  /// rho_ij the mean of both: what one gains the other loses, and of a smooth u it is div (H grad u) [Sigalotti et al.
  /// 2006, J. Comput. Phys. 212, 124; Puri & Ramachandran 2014, ibid. 256, 308, as PySPH has it].
  ///
  /// Reads what PairRecord reads; writes acceleration, specific_energy_rate, zeroth_moment, largest_mu,
  /// velocity_gradient, uncut_gradient, stretch (of bonds: the largest |x_ij|/|X_ij|, at least 1).
  virtual void rates(Particles<Dim>& particles, const PairLists<Dim>& lists) = 0;

  /// Only with Godunov fluxes (riemann_flux.hpp), before rates(): with V = m/rho, and of f = rho, P and v,
  ///   M_i = sum_j V_j x_ji g_ij^T,   B_i = M_i^-1^T,   grad f_i = sum_j V_j (f_j - f_i) B_i g_ij,
  /// exact for linear fields (gradient_correction.hpp: few neighbours).
  /// reads what rates() reads; writes density_gradient, pressure_gradient, velocity_gradient, face_correction (B).
  virtual void slopes(Particles<Dim>& particles, const PairLists<Dim>& lists) = 0;

  virtual std::size_t bytes() const = 0;
};

/// Number of particles per cluster that the passes of this precision expect in the lists.
inline std::size_t cluster_size(Precision precision) {
  return precision == Precision::mixed ? simd::lanes<float> : simd::lanes<double>;
}

template <int Dim>
std::unique_ptr<PairPass<Dim>> make_pair_pass(const PairPassSettings& settings);

}  // namespace ejecta
