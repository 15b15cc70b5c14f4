#pragma once
/// The equations of state a material can have. Visit once per material, then loop.
#include <limits>
#include <variant>

#include "material/ideal_gas.hpp"
#include "material/linear_eos.hpp"
#include "material/mie_grueneisen.hpp"
#include "material/tillotson.hpp"

namespace ejecta {

using Eos = std::variant<IdealGas, Tillotson, MieGrueneisen, LinearEos>;

/// Density of the unstressed, non-porous material [kg/m^3].
inline double reference_density(const Eos& eos) {
  return std::visit([](const auto& e) { return e.reference_density(); }, eos);
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
  if constexpr (requires { eos.temperature_rise(rho, e); })
    return {eos.temperature_rise(rho, e), eos.melting_rise(rho)};
  else
    return {};
}

}  // namespace ejecta
