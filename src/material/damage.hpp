#pragma once
/// Grady-Kipp fragmentation by Weibull-distributed flaws: scalar damage D (tensor_damage.hpp: tensor) (Benz & Asphaug
/// 1994, Icarus 107, 98; 1995, Comput. Phys. Commun. 87, 253). The crack length, proportional to D^(1/3), is what is
/// integrated in time.
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ejecta {

/// The strain that opens the flaws of tensor damage: by the present stress (Benz & Asphaug 1995), or accumulated
/// (tensor_damage.hpp).
enum class CrackStrain { benz_asphaug, pseudo_plastic, strain_history };

/// Flaws that open below strain eps: k eps^m per volume.
struct GradyKipp {
  double weibull_m;
  double weibull_k;  ///< 1/m^3 (1/m^2 in plane strain); values up to 1e61 occur, only its logarithm is used
  double crack_speed_factor = 0.4;                 ///< speed of a growing crack / longitudinal wave speed
  bool tensor = false;                             ///< cracks have directions
  CrackStrain strain = CrackStrain::benz_asphaug;  ///< of tensor damage

  /// Whether the strain that opens flaws is accumulated in time.
  bool remembers_strain() const { return tensor && strain != CrackStrain::benz_asphaug; }
};

/// A particle's flaws in three numbers: n_active(eps) = (eps/strain)^exponent between the weakest and the strongest
/// flaw.
struct Flaws {
  double strain;    ///< at which the weakest flaw opens
  double exponent;  ///< ln(count)/ln(strongest strain/weakest strain); 0 for a single flaw
  double count;     ///< n >= 1
};

/// Flaws of one particle, independent of the order of the particles and of all others.
///
/// Dealing flaws eps_i = (i/(k V))^(1/m) at random to the N particles of a body until each has one takes N (ln N +
/// 0.577) flaws on average. Seen from one particle that is a Poisson process of intensity k V_p m eps^(m-1) up to the
/// strain where the mean count is ln N + 0.577, with one flaw at least; count, weakest and strongest flaw are drawn
/// from it directly.
/// @param volume     of the particle's solid matter, mass/rho_solid [m^3; m^2 in plane strain]
/// @param particles  N, particles of the same material in the body, >= 1
/// @param seed       of the run
/// @param key        identifies the particle, e.g. a hash of its quantised initial position
Flaws draw_flaws(const GradyKipp& model, double volume, double particles, std::uint64_t seed, std::uint64_t key);

/// Flaws open at a local strain, 0 to count.
inline double active_flaws(double strain, const Flaws& flaws) {
  if (!(strain >= flaws.strain)) return 0;
  return std::min(flaws.count, std::pow(strain / flaws.strain, flaws.exponent));
}

/// Rate of D^(1/3) [1/s]: n_active c_g/R_s (Benz & Asphaug 1994: c_g/R_s for each open crack) with crack speed c_g
/// [m/s] and R_s [m] the radius of the region that cracks relieve (the smoothing length).
inline double crack_growth_rate(double active, double crack_speed, double radius) {
  return active * crack_speed / radius;
}

/// D^(1/3) never exceeds (n_active/n)^(1/3): only open flaws can break their share of the particle.
inline double crack_limit(double active, const Flaws& flaws) { return std::cbrt(active / flaws.count); }

/// Scalar strain that opens flaws: eps = alpha sigma_max/((1 - D) E), 0 unless sigma_max > 0 and D < 1.
/// (1 - D) E is Young's modulus of the cracked solid. The factor alpha turns it into that of the porous body: at
/// constant distension P = P_s(alpha rho)/alpha gives rho dP/drho = K/alpha, and stress is carried by 1/alpha of a
/// section.
/// @param principal_stress  largest principal stress of the porous, damaged body, tension positive [Pa]
/// @param young             of the non-porous, undamaged solid [Pa]
inline double local_strain(double principal_stress, double damage, double young, double distension) {
  if (!(principal_stress > 0 && damage < 1)) return 0;
  return distension * principal_stress / ((1 - damage) * young);
}

/// Damaged matter bears pressure but transmits tension only through its intact part: (1 - D) P for P < 0.
inline double damaged_pressure(double pressure, double damage) {
  return pressure < 0 ? (1 - damage) * pressure : pressure;
}

}  // namespace ejecta
