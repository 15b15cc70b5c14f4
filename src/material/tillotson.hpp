#pragma once
#include <algorithm>
#include <cmath>

#include "material/eos_point.hpp"
#include "scene/choices.hpp"

namespace ejecta {

/// Tillotson's equation of state (Tillotson 1962, General Atomic GA-3216; in the form of Melosh 1989, Impact Cratering,
/// appendix II). With eta = rho/rho0, mu = eta - 1, w = 1 + e/(E0 eta^2):
///   condensed  (eta >= 1 or e <= E_iv):  P_c = (a + b/w) rho e + A mu + B mu^2
///   expanded   (eta < 1 and e >= E_cv):  P_x = a rho e + [b rho e/w + A mu exp(-beta z)] exp(-alpha z^2), z = 1/eta -
///   1 in between:                          P = [(e - E_iv) P_x + (E_cv - e) P_c] / (E_cv - E_iv)
/// P is continuous everywhere; its derivatives jump at eta = 1 (for e > E_iv), at E_iv and at E_cv.
///
/// Two limits keep every density above zero and every energy usable:
/// - The cold pressure A mu + B mu^2 goes to zero with the density only if A = B. In expansion, max(A, B) takes the
///   place of B: for B < A a tension of A - B would be left at zero density. For B > A cold matter would repel itself
///   beyond mu = -A/B, the more the thinner it is; the cold pressure is zero there instead.
/// - e < 0, a small numerical undershoot, leaves w at 1 (w would pass through zero in strong expansion).
struct Tillotson {
  static constexpr bool gas = false;

  double rho0 = unset;                 ///< reference density [kg/m^3]
  double a = unset, b = unset;         ///< thermal coefficients
  double A = unset, B = unset;         ///< bulk modulus and its quadratic companion [Pa]
  double E0 = unset;                   ///< [J/kg]
  double E_iv = unset, E_cv = unset;   ///< incipient and complete vaporisation [J/kg]
  double alpha = unset, beta = unset;  ///< decay of the expanded state

  /// State at density rho > 0 [kg/m^3] and specific energy e [J/kg], with analytic derivatives.
  EosPoint evaluate(double rho, double e) const {
    if (rho >= rho0 || e <= E_iv) return condensed(rho, e);
    if (e >= E_cv) return expanded(rho, e);
    const EosPoint c = condensed(rho, e), x = expanded(rho, e);
    const double per_width = 1 / (E_cv - E_iv), share = (e - E_iv) * per_width;
    return {c.pressure + share * (x.pressure - c.pressure), c.dP_drho + share * (x.dP_drho - c.dP_drho),
            c.dP_de + share * (x.dP_de - c.dP_de) + per_width * (x.pressure - c.pressure)};
  }
  double reference_density() const { return rho0; }
  /// One per cent of the cold sound speed sqrt(A/rho0) [m/s]; used where c^2 < 0.
  double sound_speed_floor() const { return 0.01 * std::sqrt(A / rho0); }

 private:
  /// b rho e / w. With g = 1/w, dw/drho = -2 (w - 1)/rho gives the factor g (3 - 2 g).
  EosPoint thermal(double rho, double e) const {
    const double eta = rho * (1 / rho0), cold = E0 * eta * eta;
    const double g = cold / (cold + std::max(e, 0.0));
    return {b * rho * e * g, b * e * g * (3 - 2 * g), b * rho * g * g};
  }
  EosPoint condensed(double rho, double e) const {
    const EosPoint t = thermal(rho, e);
    EosPoint point{t.pressure + a * rho * e, t.dP_drho + a * e, t.dP_de + a * rho};
    const double mu = (rho - rho0) * (1 / rho0);  // exactly zero at rho0; 1/rho0 leaves the loops of the callers
    const double quadratic = mu < 0 ? std::max(A, B) : B;
    if (A + quadratic * mu > 0) {
      point.pressure += mu * (A + quadratic * mu);
      point.dP_drho += (A + 2 * quadratic * mu) * (1 / rho0);
    }
    return point;
  }
  EosPoint expanded(double rho, double e) const {
    EosPoint point{a * rho * e, a * e, a * rho};
    const double z = rho0 / rho - 1, fade = std::exp(-alpha * z * z);
    if (fade == 0) return point;  // vapour; the products below would be 0 * inf at extreme expansion
    const EosPoint t = thermal(rho, e);
    const double mu = rho / rho0 - 1, cold = A * std::exp(-beta * z), minus_dz = (1 + z) / rho;
    point.pressure += fade * (t.pressure + mu * cold);
    point.dP_drho +=
        fade * (t.dP_drho + cold / rho0 + minus_dz * (beta * mu * cold + 2 * alpha * z * (t.pressure + mu * cold)));
    point.dP_de += fade * t.dP_de;
    return point;
  }
};

}  // namespace ejecta
