#pragma once
/// The equations of state a material can have. Visit once per material, then loop.
#include <variant>

#include "material/ideal_gas.hpp"
#include "material/tillotson.hpp"

namespace ejecta {

using Eos = std::variant<IdealGas, Tillotson>;

/// Density of the unstressed, non-porous material [kg/m^3].
inline double reference_density(const Eos& eos) {
  return std::visit([](const auto& e) { return e.reference_density(); }, eos);
}

}  // namespace ejecta
