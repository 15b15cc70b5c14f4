#pragma once
/// What a particle shows to its partners in a pair pass, packed into one contiguous record per particle and image.
#include <cstddef>
#include <span>
#include <vector>

#include "particles/boundary_images.hpp"
#include "particles/particles.hpp"

namespace ejecta {

/// What the records of a pass hold.
struct RecordKind {
  bool stress = false;   ///< the stress tensor, not pressure alone
  bool tensor = false;   ///< the smoothing metric, not a smoothing length
  bool coupled = false;  ///< the damage tensor (only with stress)
};

/// Places within a record. T is the precision of the pass. Lengths are in units of a power of two near the particle
/// spacing, so that single precision neither over- nor underflows; everything else is SI.
/// In single precision a position is the sum of two floats, and differences of positions carry full relative precision.
/// Symmetric tensors are stored xx yy xy | xx yy zz xy xz yz.
template <class T, int Dim, RecordKind Kind>
struct PairRecord {
  static constexpr bool split = sizeof(T) == sizeof(float);
  static constexpr int stresses = Kind.stress ? symmetric_size<Dim> : 1;
  static constexpr int x = 0;
  static constexpr int x_low = x + Dim;                                                 ///< only if split
  static constexpr int v = x_low + (split ? Dim : 0);                                   ///< velocity
  static constexpr int h = v + Dim;                                                     ///< unless tensor
  static constexpr int h_reciprocal = h + 1;                                            ///< 1/h, unless tensor
  static constexpr int metric = v + Dim;                                                ///< G = H H, if tensor
  static constexpr int slope_norm = v + Dim + (Kind.tensor ? symmetric_size<Dim> : 2);  ///< norm/h^(Dim+2); norm det(H)
  static constexpr int mass = slope_norm + 1;                                           ///< m / unit^Dim
  static constexpr int density_reciprocal = mass + 1;                                   ///< 1/rho
  static constexpr int sound_speed = density_reciprocal + 1;
  static constexpr int shear_switch = sound_speed + 1;
  /// sigma/rho^2 with sigma = -P I + S, S as cracks leave it, or -P/rho^2 alone
  static constexpr int stress = shear_switch + 1;
  static constexpr int damage = stress + stresses;  ///< damage tensor, if coupled
  static constexpr int size = stress + stresses + (Kind.coupled ? symmetric_size<Dim> : 0);

  /// Fills one record for each particle, then one for each image. `length_unit` [m] is the unit above.
  /// reads position, velocity, smoothing_length or smoothing_metric, mass, density, pressure, sound_speed, and where
  /// they exist shear_switch, deviatoric_stress, damage_tensor and the fraction of the deviator that damage leaves,
  /// `intact` (empty: all of it). `cut_by_cracks` says by material number whose damage tensors count; others are zero.
  static void pack(const Particles<Dim>& particles, const std::vector<Image>& images, const Boundary& boundary,
                   double kernel_norm, double length_unit, std::span<const double> intact,
                   std::span<const char> cut_by_cracks, std::vector<T>& records);
};

/// The power of two just below the length.
double power_of_two_below(double length);

}  // namespace ejecta
