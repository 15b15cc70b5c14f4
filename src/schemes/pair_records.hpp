#pragma once
/// What a particle shows to its partners in a pair pass, packed into one contiguous record per particle and ghost.
#include <cstddef>
#include <span>
#include <vector>

#include "particles/ghosts.hpp"
#include "particles/particles.hpp"
#include "schemes/surroundings.hpp"

namespace ejecta {

/// What the records of a pass hold.
struct RecordKind {
  bool stress = false;    ///< the stress as a tensor, corrected, and whom it acts on; not pressure alone
  bool asph = false;      ///< the smoothing metric, not a smoothing length
  bool cracked = false;   ///< the damage tensor (only with stress)
  bool bonded = false;    ///< the place at the start (only with stress)
  bool strained = false;  ///< the rate of strain (always with stress or asph)
};

/// Constants of a pass that its records hold as factors, so that the pair loop has less to do.
struct RecordScales {
  double kernel_norm = 1;  ///< of the kernel
  double support = 2;      ///< of the kernel [h]
  double slope = 1;        ///< of its reduced slope
  bool slope_over_r = false;
  double length_unit = 1;  ///< m
  double linear_conduction = 0, quadratic_conduction = 0;
};

/// Who acts on whom, and how.
struct PairRules {
  std::vector<double> sizes;              ///< by body: of a particle at the start [m]; needed only with stress
  std::vector<int> pieces;                ///< by body: bodies of one number are one continuum; empty: all are
  std::vector<double> reference_density;  ///< by material: rho0 [kg/m^3]
  std::vector<char> cut_by_cracks;        ///< by material: whether its damage tensor cuts the stress
};

/// The piece that stands for whatever is behind a reflecting face.
inline constexpr int wall = -1;

/// Places within a record. T is the precision of the pass. Lengths are in units of a power of two near the particle
/// spacing, so that single precision neither over- nor underflows; everything else is SI.
/// In single precision a position is the sum of two floats, and differences of positions carry full relative precision.
/// Symmetric tensors are stored xx yy xy | xx yy zz xy xz yz, others row by row. The flux (flux.hpp) adds its own
/// places.
template <class T, int Dim, RecordKind Kind, class Flux>
struct PairRecord {
  static constexpr bool split = sizeof(T) == sizeof(float);
  static constexpr int stresses = Kind.stress ? Dim * Dim : 1;
  // What the first pass reads comes first: one cache line.
  static constexpr int x = 0;
  static constexpr int x_low = x + Dim;                ///< only if split
  static constexpr int h = x_low + (split ? Dim : 0);  ///< a twentieth of it, unless asph
  static constexpr int reach_reciprocal = h + 1;       ///< 1/(support h), unless asph
  static constexpr int metric = h;                     ///< G = H H, if asph
  static constexpr int slope_norm = h + (Kind.asph ? symmetric_size<Dim> : 2);
  static constexpr int volume = slope_norm + 1;                ///< V0 = m/rho0, uncompressed
  static constexpr int expansion = volume + 1;                 ///< r = rho0/rho
  static constexpr int compression = expansion + 1;            ///< 1/r
  static constexpr int piece = compression + 1;                ///< with stress
  static constexpr int place = piece + (Kind.stress ? 1 : 0);  ///< at the start, if bonded
  static constexpr int place_low = place + (Kind.bonded ? Dim : 0);
  static constexpr int bond = place_low + (Kind.bonded && split ? Dim : 0);  ///< support h of a bonded particle, else 0
  static constexpr int v = bond + (Kind.bonded ? 1 : 0);                     ///< velocity
  static constexpr int density = v + Dim;                                    ///< rho
  static constexpr int sound_speed = density + 1;
  static constexpr int reference = sound_speed + 1;  ///< rho0
  static constexpr int stress = reference + 1;       ///< r^2 T (gradient_correction.hpp), or -r^2 P alone [Pa]
  static constexpr int shear = stress + stresses;    ///< what of it passes no crack, if cracked
  static constexpr int deformation = shear + (Kind.cracked ? stresses : 0);      ///< F of hourglass.hpp, if bonded
  static constexpr int stiffness = deformation + (Kind.bonded ? Dim * Dim : 0);  ///< half of its k [Pa], if bonded
  static constexpr int damage =
      stiffness + (Kind.bonded ? 1 : 0);  ///< damage tensor, twice off its diagonal, if cracked
  static constexpr int flux = damage + (Kind.cracked ? symmetric_size<Dim> : 0);
  using FluxRecord = typename Flux::template Record<Dim, Kind.strained>;
  static constexpr int size = flux + FluxRecord::size;
  static T mass(const T* record) { return record[volume] * record[reference]; }  ///< per length_unit^Dim

  // A record of its own, for pieces in contact only.
  static constexpr int contact = 0;           ///< how far in contact with other pieces, 0 to 1
  static constexpr int normal = 1;            ///< unit vector towards them, or 0
  static constexpr int press = normal + Dim;  ///< r^2 T' that acts on them [Pa]
  static constexpr int contact_size = press + stresses;

  /// Fills one record for each particle, then one for each ghost, but for the stress.
  /// Reads position, velocity, smoothing_length or smoothing_metric, mass, density, sound_speed, what the flux reads,
  /// and where they exist damage_tensor, start_position and bond.
  static void pack(const Particles<Dim>& particles, const GhostList<Dim>& ghosts, const PairRules& rules,
                   const RecordScales& scales, std::vector<T>& records);

  /// Fills the records of contact, but for the stress. Guests are in contact with nothing.
  static void pack_contacts(const Particles<Dim>& particles, const GhostList<Dim>& ghosts, const PairRules& rules,
                            const Surroundings<Dim>& around, std::vector<T>& contacts);

  /// Fills in the stress that acts on the partners; that of guests acts as it is, uncorrected,
  /// and on other pieces by its pressure alone. Reads pressure and where
  /// they exist deviatoric_stress, damage_tensor and intact_share. `contacts` may be empty.
  static void pack_stress(const Particles<Dim>& particles, const GhostList<Dim>& ghosts, const PairRules& rules,
                          const Surroundings<Dim>& around, std::vector<T>& records, std::vector<T>& contacts);
};

/// The power of two just below the length.
double power_of_two_below(double length);

}  // namespace ejecta
