#pragma once
#include "material/eos.hpp"

namespace ejecta {

/// What the strength of a material may depend on. Models read what they need; the rest need not be set.
struct StrengthState {
  double pressure = 0;        ///< of the solid, compression positive [Pa]
  double damage = 0;          ///< 0 to 1
  double plastic_strain = 0;  ///< equivalent, accumulated
  double strain_rate = 0;     ///< of the plastic strain [1/s]
  double shear_factor = 1;    ///< G/G0, where the shear modulus varies
  Warmth warmth = {};
};

/// Yield stress [Pa] and its slopes by the plastic strain [Pa] and by the plastic strain rate [Pa s].
struct YieldPoint {
  double stress, by_strain, by_rate;
};

}  // namespace ejecta
