#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "material/strength_state.hpp"
#include "scene/choices.hpp"

namespace ejecta {

/// Johnson & Cook (1983, 7th Int. Symp. Ballistics, 541):
///   Y = (A + B eps_p^n) [1 + C ln(rate/rate_0)] [1 - T*^m],   T* = (T - T0)/(Tm - T0), 0 when cold, Y = 0 from Tm on.
/// The logarithm counts from rate_0 on: below it the law, made of tests at rate_0 and faster, would end in negative
/// strength.
struct JohnsonCook {
  static constexpr bool hardening_law = true;

  double yield_stress = unset;        ///< A [Pa]
  double hardening = unset;           ///< B [Pa]
  double hardening_exponent = unset;  ///< n
  double rate_factor = unset;         ///< C
  double softening_exponent = unset;  ///< m
  double reference_rate = 1;          ///< rate_0 [1/s]

  bool needs_temperature() const { return true; }
  bool needs_melting() const { return true; }

  YieldPoint evaluate(const StrengthState& s) const {
    const double homologous = s.warmth.rise / s.warmth.melting;
    if (homologous >= 1) return {0, 0, 0};
    const double cold = homologous > 0 ? 1 - std::pow(homologous, softening_exponent) : 1;
    const double power = std::pow(s.plastic_strain, hardening_exponent);
    const double quasistatic = (yield_stress + hardening * power) * cold;
    const double slope = s.plastic_strain > 0 ? hardening * hardening_exponent * power / s.plastic_strain * cold
                                              : std::numeric_limits<double>::infinity();
    if (!(s.strain_rate > reference_rate)) return {quasistatic, slope, 0};
    const double fast = 1 + rate_factor * std::log(s.strain_rate / reference_rate);
    return {quasistatic * fast, slope * fast, quasistatic * rate_factor / s.strain_rate};
  }
  double yield(const StrengthState& s) const { return evaluate(s).stress; }
  double intact_fraction(double damage) const { return 1 - damage; }
};

}  // namespace ejecta
