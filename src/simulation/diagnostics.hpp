#pragma once
/// Conserved quantities and extremes of the present state.
#include "base/types.hpp"
#include "material/material.hpp"
#include "particles/particles.hpp"

namespace ejecta {

struct Totals {
  double mass = 0;                           ///< kg (kg/m in plane strain)
  Vec<3> momentum = Vec<3>::Zero();          ///< kg m/s
  Vec<3> angular_momentum = Vec<3>::Zero();  ///< about the origin [kg m^2/s]
  double momentum_scale = 0;                 ///< sum |m v|, to measure momentum errors against [kg m/s]
  double kinetic = 0, internal = 0;          ///< J
  double energy() const { return kinetic + internal; }
  Totals& operator+=(const Totals& o);
};

/// Sums over all particles, the same for every number of threads.
template <int Dim>
Totals totals(const Particles<Dim>& particles);

/// Relative errors of what must not change.
struct ConservationErrors {
  double mass, momentum, energy;
};
/// Energy is measured against the largest of total energy and kinetic energy at the start.
ConservationErrors conservation_errors(const Totals& initial, const Totals& now);

}  // namespace ejecta
