#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "material/eos_point.hpp"
#include "scene/choices.hpp"

namespace ejecta {

/// Mie-Grueneisen equation of state about a Hugoniot us = c0 + S1 up + S2 up^2/us + S3 up^3/us^2, in the form of
/// Steinberg (1996, UCRL-MA-106439). With eta = rho/rho0, mu = eta - 1:
///   mu > 0:  P = rho0 c0^2 mu [1 + (1 - gamma0/2) mu - b mu^2/2] / D^2 + (gamma0 + b mu) rho0 e,
///            D = 1 - (S1 - 1) mu - S2 mu^2/eta - S3 mu^3/eta^2
///   else:    P = rho0 c0^2 mu + gamma0 rho0 e
/// The Hugoniot from rest and zero energy is met exactly. Pressure and, at e = 0, its slope are continuous at mu = 0.
///
/// Outside eta_min <= eta <= eta_max the form says nothing (D vanishes at strong compression, the tension of a cold
/// solid would last to zero density), and both ends are continued:
/// - above eta_max along the tangent at eta_max, so that pressure and slope stay continuous;
/// - below eta_min P falls to zero with the density, P = (eta/eta_min) P(eta_min, e), as that of an ideal gas does.
///   Cold matter is mechanically unstable there and has the least sound speed. Tension falls twice as fast: it ends at
///   eta_min/2. On an isentrope tension over density would grow with the density to the power of gamma0/eta_min, and
///   drawn-out matter that cooled a little too far would lose energies without end as it comes together.
struct MieGrueneisen {
  static constexpr bool gas = false;

  double rho0 = unset;    ///< reference density [kg/m^3]
  double c0 = unset;      ///< us of a weak shock [m/s]
  double S1 = unset;      ///< slope of us(up)
  double S2 = 0, S3 = 0;  ///< its curvature
  double gamma0 = unset;  ///< Grueneisen parameter at rho0; that at eta is (gamma0 + b mu)/eta
  double b = 0;
  double eta_min = 0.5, eta_max = 1.5;
  double heat_capacity = unset;        ///< c_v [J/kg/K]; not set: heat does not warm it
  double reference_temperature = 300;  ///< T0, at rho0 and e = 0 [K]
  double melt_temperature = unset;     ///< Tm0, at rho0 [K]; not set: never melts
  double melt_exponent = unset;        ///< a of Lindemann's law; not set: Tm is constant

  /// State at density rho > 0 [kg/m^3] and specific energy e [J/kg], with analytic derivatives.
  EosPoint evaluate(double rho, double e) const {
    const double eta = rho * (1 / rho0);
    if (eta < eta_min) {
      const EosPoint end = at(eta_min - 1, e);
      const double steepness = end.pressure < 0 ? 2 : 1, share = std::max(0.0, 1 - steepness * (1 - eta / eta_min));
      const double per_density = share > 0 ? steepness / (eta_min * rho0) : 0;
      return {share * end.pressure, per_density * end.pressure, share * end.dP_de};
    }
    if (eta > eta_max) {
      const EosPoint end = at(eta_max - 1, e);
      return {end.pressure + end.dP_drho * (rho - eta_max * rho0), end.dP_drho, (gamma0 + b * (eta - 1)) * rho0};
    }
    return at((rho - rho0) * (1 / rho0), e);
  }
  double reference_density() const { return rho0; }
  /// One per cent of c0 [m/s]; used where c^2 < 0.
  double sound_speed_floor() const { return 0.01 * c0; }

  /// D above, the square root of the denominator; the form holds while it is positive.
  double denominator(double mu) const {
    const double x = mu / (1 + mu);
    return 1 - (S1 - 1) * mu - S2 * mu * x - S3 * mu * x * x;
  }

  bool warms() const { return is_set(heat_capacity); }
  bool melts() const { return is_set(melt_temperature); }

  /// T - T0 [K] = T_s - T0 + (e - e_s)/c_v. T_s and e_s lie on the isentrope through (rho0, e = 0, T0), which follows
  /// from the equation itself. With x = 1 - 1/eta and Gamma/eta = gamma0 + b mu:
  ///   T_s = T0 I(x),  I = exp[(gamma0 - b) x] eta^b,   de_s/dx = P_c/rho0 + (gamma0 + b mu) e_s, hence
  ///   e_s = I(x) int_0^x P_c/(rho0 I) dx,  P_c the pressure at e = 0; by Gauss's rule of three points.
  /// Error of e_s below 1e-3 of itself for 0.8 < eta < 1.5. Outside eta_min, eta_max: that of the nearest end.
  double temperature_rise(double rho, double e) const {
    const double x = 1 - 1 / std::clamp(rho / rho0, eta_min, eta_max);
    constexpr double places[] = {0.1127016653792583, 0.5, 0.8872983346207417};
    constexpr double weights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    double integral = 0;
    for (int k = 0; k < 3; ++k) {
      const double at_x = places[k] * x;
      integral += weights[k] * at(at_x / (1 - at_x), 0).pressure / isentropic_heating(at_x);
    }
    const double heating = isentropic_heating(x), isentrope_energy = heating * integral * x / rho0;
    const double by_heat = warms() ? (e - isentrope_energy) / heat_capacity : 0;
    return reference_temperature * (heating - 1) + by_heat;
  }
  /// Tm - T0 [K] by Lindemann's law in the form of Steinberg, Cochran & Guinan (1980, J. Appl. Phys. 51, 1498):
  /// Tm = Tm0 exp[2 a (1 - 1/eta)] eta^(2 (gamma0 - a - 1/3)).
  double melting_rise(double rho) const {
    if (!melts()) return std::numeric_limits<double>::infinity();
    if (!is_set(melt_exponent)) return melt_temperature - reference_temperature;
    const double eta = std::clamp(rho / rho0, eta_min, eta_max);
    const double power = 2 * (gamma0 - melt_exponent - 1.0 / 3);
    return melt_temperature * std::exp(2 * melt_exponent * (1 - 1 / eta)) * std::pow(eta, power) -
           reference_temperature;
  }

 private:
  EosPoint at(double mu, double e) const {
    const double stiffness = rho0 * c0 * c0;
    if (mu <= 0) return {stiffness * mu + gamma0 * rho0 * e, c0 * c0, gamma0 * rho0};
    const double numerator = mu * (1 + mu * (1 - gamma0 / 2 - b / 2 * mu));
    const double d_numerator = 1 + mu * (2 - gamma0 - 1.5 * b * mu);
    const double x = mu / (1 + mu), dx = 1 / ((1 + mu) * (1 + mu));
    const double d_denominator = 1 - S1 - S2 * (x + mu * dx) - S3 * x * (x + 2 * mu * dx);
    const double per_d = 1 / denominator(mu), gamma = (gamma0 + b * mu) * rho0;
    return {stiffness * numerator * per_d * per_d + gamma * e,
            c0 * c0 * per_d * per_d * (d_numerator - 2 * numerator * d_denominator * per_d) + b * e, gamma};
  }
  /// I(x); b counts in compression only, as in the pressure.
  double isentropic_heating(double x) const {
    return x > 0 ? std::exp((gamma0 - b) * x - b * std::log1p(-x)) : std::exp(gamma0 * x);
  }
};

}  // namespace ejecta
