#pragma once
#include <cmath>

#include "material/deviator.hpp"
#include "scene/choices.hpp"

namespace ejecta {

/// Isotropic linear elasticity of the non-porous, undamaged material.
struct Elastic {
  double shear_modulus = unset;  ///< G [Pa]
  double bulk_modulus = unset;   ///< K [Pa]

  /// Young's modulus E = 9 K G / (3 K + G) [Pa].
  double young() const { return 9 * bulk_modulus * shear_modulus / (3 * bulk_modulus + shear_modulus); }
  /// Speed of longitudinal waves sqrt((K + 4 G/3)/rho) [m/s].
  double longitudinal_speed(double rho) const { return std::sqrt((bulk_modulus + 4 * shear_modulus / 3) / rho); }
};

/// Hooke's law in the Jaumann rate: dS/dt = 2 G (D - tr(D)/3 I) + W S - S W [Pa/s], with D and W the symmetric and the
/// antisymmetric part of the velocity gradient L_ab = dv_a/dx_b [1/s]. The spin terms make a stress turn with the body.
/// The trace is divided by 3 in plane strain too: the strain rate has a zero zz component, the stress has not.
template <int Dim>
Deviator<Dim> stress_rate(const Mat<Dim>& gradient, const Deviator<Dim>& s, double shear_modulus) {
  const double two_g = 2 * shear_modulus, mean = gradient.trace() / 3;
  Deviator<Dim> rate;
  rate[0] = two_g * (gradient(0, 0) - mean);
  rate[1] = two_g * (gradient(1, 1) - mean);
  rate[2] = shear_modulus * (gradient(0, 1) + gradient(1, 0));
  const double w_xy = 0.5 * (gradient(0, 1) - gradient(1, 0));
  rate[0] += 2 * w_xy * s[2];
  rate[1] -= 2 * w_xy * s[2];
  rate[2] += w_xy * (s[1] - s[0]);
  if constexpr (Dim == 3) {
    const double w_xz = 0.5 * (gradient(0, 2) - gradient(2, 0)), w_yz = 0.5 * (gradient(1, 2) - gradient(2, 1));
    const double zz = -(s[0] + s[1]);
    rate[3] = shear_modulus * (gradient(0, 2) + gradient(2, 0));
    rate[4] = shear_modulus * (gradient(1, 2) + gradient(2, 1));
    rate[0] += 2 * w_xz * s[3];
    rate[1] += 2 * w_yz * s[4];
    rate[2] += w_xz * s[4] + w_yz * s[3];
    rate[3] += w_xy * s[4] + w_xz * (zz - s[0]) - w_yz * s[2];
    rate[4] += w_yz * (zz - s[1]) - w_xy * s[3] - w_xz * s[2];
  }
  return rate;
}

}  // namespace ejecta
