#pragma once
/// The equations of state a material can have. Visit once per material, then loop.
///
/// Each is a plain struct with
///   evaluate(rho, e)                  EosPoint at density rho [kg/m^3] and specific energy e [J/kg]
///   reference_density()               of the unstressed, non-porous material [kg/m^3]
///   sound_speed_floor()               where the equation is mechanically unstable [m/s]
///   gas                               whether it has no density of its own: without pressure it spreads without end
/// and, where it can, what the properties below ask for. The rest of the program asks for these and for no type.
#include <limits>
#include <optional>
#include <variant>

#include "material/equilibrium_air.hpp"
#include "material/explosive.hpp"
#include "material/ideal_gas.hpp"
#include "material/jwl.hpp"
#include "material/linear_eos.hpp"
#include "material/mie_grueneisen.hpp"
#include "material/tillotson.hpp"

namespace ejecta {

using Eos = std::variant<IdealGas, Tillotson, MieGrueneisen, LinearEos, EquilibriumAir, Jwl>;

/// Density of the unstressed, non-porous material [kg/m^3].
inline double reference_density(const Eos& eos) {
  return std::visit([](const auto& e) { return e.reference_density(); }, eos);
}

/// Whether it is a gas: no density of its own, no tension, no surface.
inline bool is_gas(const Eos& eos) {
  return std::visit([](const auto& e) { return e.gas; }, eos);
}

/// Specific energy [J/kg] at density rho [kg/m^3] and pressure [Pa], if the equation of state can be solved for it:
/// its specific_energy(rho, P).
inline std::optional<double> specific_energy_at(const Eos& eos, double rho, double pressure) {
  return std::visit(
      [&](const auto& e) -> std::optional<double> {
        if constexpr (requires { e.specific_energy(rho, pressure); })
          return e.specific_energy(rho, pressure);
        else
          return std::nullopt;
      },
      eos);
}

/// Whether an equation of state follows a reaction, such as that of an explosive: evaluate(rho, e, reacted) with the
/// reacted fraction, 0 to 1. With a default of 0, as it is asked without the fraction where nothing has reacted yet.
template <class EosT>
inline constexpr bool reacts = requires(const EosT& eos, double x) {
  eos.evaluate(x, x, x);
};

/// What the burn asks of an explosive: its explosive(). Nothing if the equation of state is of none.
inline std::optional<Explosive> explosive_of(const Eos& eos) {
  return std::visit(
      [](const auto& e) -> std::optional<Explosive> {
        if constexpr (requires { e.explosive(); })
          return e.explosive();
        else
          return std::nullopt;
      },
      eos);
}

/// Specific energy of matter as it is made [J/kg]: its energy_at_rest(), else 0.
inline double energy_at_rest(const Eos& eos) {
  return std::visit(
      [](const auto& e) -> double {
        if constexpr (requires { e.energy_at_rest(); })
          return e.energy_at_rest();
        else
          return 0;
      },
      eos);
}

/// Whether an equation of state knows the temperature: temperature_rise(rho, e) and melting_rise(rho), both above that
/// at rest [K]; warms() and melts() say whether the constants for them are given.
template <class EosT>
inline constexpr bool gives_temperature = requires(const EosT& eos, double x) {
  eos.temperature_rise(x, x);
};
inline bool has_temperature(const Eos& eos) {
  return std::visit([]<class EosT>(const EosT&) { return gives_temperature<EosT>; }, eos);
}

/// Temperature and melting temperature, both above that at rest [K].
struct Warmth {
  double rise = 0;
  double melting = std::numeric_limits<double>::infinity();
};

/// That of density rho [kg/m^3] and specific energy e [J/kg]; nothing warms up, nor melts, by an equation of state that
/// knows no temperature.
template <class EosT>
Warmth warmth(const EosT& eos, double rho, double e) {
  if constexpr (gives_temperature<EosT>)
    return {eos.temperature_rise(rho, e), eos.melting_rise(rho)};
  else
    return {};
}

}  // namespace ejecta
