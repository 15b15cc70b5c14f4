#pragma once
#include <algorithm>
#include <cmath>

#include "material/eos.hpp"
#include "material/strength_state.hpp"
#include "scene/choices.hpp"

namespace ejecta {

/// Metals at high rates of strain, where the rate itself no longer matters (Steinberg, Cochran & Guinan 1980, J. Appl.
/// Phys. 51, 1498):
///   G/G0 = [1 + A P/eta^(1/3) - B (T - T0)] f,   Y = min(Y_max, Y_0 [1 + beta (eps_p + eps_i)]^n) G/G0,
/// f the softening near the melting point. G0 is the modulus of [elastic].
struct SteinbergGuinan {
  static constexpr bool hardening_law = true;

  double yield_stress = unset;        ///< Y_0 [Pa]
  double yield_limit = unset;         ///< Y_max >= Y_0, at the G0 [Pa]
  double hardening = unset;           ///< beta
  double hardening_exponent = unset;  ///< n
  double initial_strain = 0;          ///< eps_i, of earlier work on the metal
  double stiffening = 0;              ///< A [1/Pa]
  double softening = 0;               ///< B [1/K]
  double melt_width = 1e-3;           ///< Y_p of the melt factor

  bool needs_temperature() const { return softening > 0; }
  bool needs_melting() const { return false; }

  /// G/G0 at the pressure [Pa] and compression eta = rho/rho0 of the solid: from 0.01, so that tension cannot turn a
  /// solid into a fluid; 0 when melted.
  ///
  /// f = exp[-Y_p (T - T0)/(Tm - T)], 0 from Tm on: the softening by exp[-Y_p e/(e_m - e)] of Spheral's equation, in
  /// temperatures. With Y_p = 1e-3 it differs from 1 in the last per cent before melting only.
  double shear_factor(double pressure, double eta, const Warmth& warmth) const {
    if (warmth.rise >= warmth.melting) return 0;
    const double melt = std::exp(-melt_width * std::max(warmth.rise, 0.0) / (warmth.melting - warmth.rise));
    return std::max(0.01, (1 + stiffening * pressure / std::cbrt(eta) - softening * warmth.rise) * melt);
  }

  YieldPoint evaluate(const StrengthState& s) const {
    const double base = 1 + hardening * (s.plastic_strain + initial_strain);
    const double hardened = yield_stress * std::pow(base, hardening_exponent);
    if (hardened >= yield_limit) return {yield_limit * s.shear_factor, 0, 0};
    return {hardened * s.shear_factor, hardening_exponent * hardening * hardened / base * s.shear_factor, 0};
  }
  double yield(const StrengthState& s) const { return evaluate(s).stress; }
  double intact_fraction(double damage) const { return 1 - damage; }
};

}  // namespace ejecta
