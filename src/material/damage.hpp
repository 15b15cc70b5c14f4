#pragma once
/// Grady-Kipp fragmentation by Weibull-distributed flaws: scalar damage D (tensor_damage.hpp: tensor). The length of
/// the cracks, a root of D, is what is integrated in time.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scene/choices.hpp"

namespace ejecta {

/// The strain that opens the flaws of tensor damage: by the present stress (Benz & Asphaug 1995), or accumulated
/// (tensor_damage.hpp).
enum class CrackStrain { benz_asphaug, pseudo_plastic, strain_history };

/// How fast the cracks of a particle grow with the strain.
///   grady_kipp:   every crack relieves a sphere (in plane strain a disc) of its own length; the same for particles of
///                 any size (Grady & Kipp 1980, Int. J. Rock Mech. 17, 147).
///   benz_asphaug: D^(1/3), in plane strain too, by c_g/R_s for each open one of the flaws dealt to the particle, R_s
///   its
///                 smoothing length, and no more damage than the share of its flaws that is open (Benz & Asphaug 1994,
///                 Icarus 107, 98; 1995, Comput. Phys. Commun. 87, 253).
enum class CrackLaw { grady_kipp, benz_asphaug };

/// Flaws that open below strain eps: k eps^m per volume.
struct GradyKipp {
  double weibull_m = unset;
  double weibull_k = unset;  ///< 1/m^3 (1/m^2 in plane strain); values up to 1e61 occur, only its logarithm is used
  double crack_speed_factor = 0.4;  ///< speed of a growing crack / longitudinal wave speed
  CrackLaw growth = CrackLaw::grady_kipp;
  bool tensor = false;                             ///< cracks have directions
  CrackStrain strain = CrackStrain::benz_asphaug;  ///< of tensor damage

  /// D is this power of the length of cracks.
  int crack_power(int dim) const { return growth == CrackLaw::benz_asphaug ? 3 : dim; }

  /// Whether the strain that opens flaws is accumulated in time.
  bool remembers_strain() const { return tensor && strain != CrackStrain::benz_asphaug; }
};

/// The flaws dealt to a particle in three numbers: n_active(eps) = (eps/strain)^exponent between the weakest and the
/// strongest flaw.
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

/// Strain of the weakest flaw of the same process without an end: k V_p eps^m is exponentially distributed. Arguments
/// as above.
double draw_weakest_flaw(const GradyKipp& model, double volume, std::uint64_t seed, std::uint64_t key);

/// By how much faster than a single crack the cracks of a particle lengthen at a strain: 0 below the weakest flaw, else
/// (clamp(eps, from, to)/from)^exponent. Its integral over the strain is known, and with it the growth in a step in
/// which the strain is linear in time, however far the strain goes in it.
struct OpenCracks {
  double weakest;   ///< strain below which none grows
  double from, to;  ///< strains between which it rises
  double exponent;
  int power;         ///< of their length is the damage
  double count = 1;  ///< dealt to the particle; 1: no limit on the damage before D = 1

  double at(double strain) const {
    return strain >= weakest ? std::pow(std::clamp(strain, from, to) / from, exponent) : 0;
  }

  /// Mean over the strains between two.
  double mean(double before, double after) const {
    const double change = after - before;
    // Closer, round-off of the difference would exceed the error of the value in between.
    if (!(std::abs(change) > 1e-6 * std::max(before, after))) return at(0.5 * (before + after));
    return (integral(std::max(after, weakest)) - integral(std::max(before, weakest))) / change;
  }

 private:
  double integral(double strain) const {
    if (strain <= from) return strain;
    const double end = std::min(strain, to), factor = std::pow(end / from, exponent);
    return from + (end * factor - from) / (exponent + 1) + factor * (strain - end);
  }
};

/// Of the flaws dealt to a particle, the open ones: n_active.
OpenCracks dealt_cracks(const Flaws& flaws);

/// Law of Grady & Kipp for cracks of radius c_g (t - t_i) that opened at t_i: the share of the volume they relieve is
/// D = 4 pi/(3 V) c_g^3 sum (t - t_i)^3. For a strain that rises steadily and n = k V eps^m open flaws that is
///   d(D^(1/3))/dt = (C n)^(1/3) c_g/R,  C = 2 (m + 3)^2/(9 (m + 1) (m + 2)),  4 pi R^3/3 = V
/// (Melosh, Ryan & Asphaug 1992, J. Geophys. Res. 97, 14735); with discs in plane strain
///   d(D^(1/2))/dt = (C n)^(1/2) c_g/R,  C = (m + 2)/(2 (m + 1)),  pi R^2 = V.
/// A single crack grows by c_g/R. So it is (max(1, C n))^(1/Dim) from the weakest flaw of the particle on: on average
/// right where particles hold many flaws as where few hold any.
/// @param volume   of the particle's solid matter [m^3; m^2 in plane strain]
/// @param weakest  strain of its weakest flaw
OpenCracks weibull_cracks(const GradyKipp& model, int dim, double volume, double weakest);

/// x^(1/power) and its inverse for powers 2 and 3, between damage and the length of a crack.
inline double crack_length(double damage, int power) { return power == 2 ? std::sqrt(damage) : std::cbrt(damage); }
inline double crack_damage(double length, int power) { return power == 2 ? length * length : length * length * length; }

/// Length D^(1/power) of a crack at the end of a step in which the strain goes from `before` to `after`; never shorter,
/// never beyond 1 or the share (n_active/n)^(1/power) of the dealt flaws that is open.
/// @param growth  c_g dt/R: what a single crack would grow by
inline double longer_crack(double length, double before, double after, const OpenCracks& cracks, double growth) {
  const double most = std::max(before, after);
  if (!(most >= cracks.weakest)) return length;
  const double limit = cracks.count > 1 ? crack_length(cracks.at(most) / cracks.count, cracks.power) : 1;
  if (length >= limit) return length;
  return std::min(length + growth * cracks.mean(before, after), limit);
}

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
