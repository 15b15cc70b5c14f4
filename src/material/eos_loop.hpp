#pragma once
/// The equation of state of many elements of one material: particles, cells, whatever has a density and an energy.
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/parallel.hpp"
#include "material/distension_solver.hpp"
#include "material/material.hpp"

namespace ejecta {

/// A value of every element, all spans of one length, in SI. Those that a material has no use for may be empty.
struct EosColumns {
  std::span<const double> density;          ///< of the body, pores included [kg/m^3]
  std::span<const double> specific_energy;  ///< J/kg
  std::span<const double> reacted = {};     ///< fraction, 0 to 1; of an equation of state that reacts
  std::span<double> pressure;               ///< written: of the body, pores included [Pa]
  std::span<double> sound_speed;            ///< written: of longitudinal waves [m/s]
  std::span<double> distension = {};        ///< of a porous material: so far, and brought to this state
  std::span<double> stress_factor = {};     ///< written if there, of a porous material (porosity.hpp)
  std::span<double> shear_modulus = {};     ///< written if there; of a material whose modulus varies it must be
};

/// Pressure and sound speed, and what goes with them, of every element. The model is chosen once, not once an element.
/// Returns the number of elements whose distension was not found, which only the plain Newton method leaves.
std::int64_t equation_of_state(const Material& material, const EosColumns& columns,
                               const DistensionSearch& search = {});

/// A shear modulus [Pa] that is the same in every state.
struct ConstantShear {
  double modulus;
  double operator()(std::size_t, const EosPoint&, double, double) const { return modulus; }
};

/// State of element i without pores. What has reacted is read only if the equation of state reacts.
template <class EosT>
EosPoint state_of(const EosT& eos, const EosColumns& c, std::size_t i) {
  if constexpr (reacts<EosT>)
    return eos.evaluate(c.density[i], c.specific_energy[i], c.reacted[i]);
  else
    return eos.evaluate(c.density[i], c.specific_energy[i]);
}

/// Speed of longitudinal waves from that of the fluid: c^2 + 4 G / (3 rho_s). Solid expanded beyond its rest density
/// has broken or melted; counting its shear modulus in full would let a few stray elements dictate the time step.
inline double longitudinal(double fluid_speed, double shear_modulus, double solid_density, double rest_density) {
  return std::sqrt(fluid_speed * fluid_speed + 4 * shear_modulus / (3 * std::max(solid_density, rest_density)));
}

/// equation_of_state() of a material without pores. shear(i, solid, rho_s, e) is the shear modulus [Pa] of element i
/// with this state of its solid.
template <class EosT, class Shear>
void dense_states(const EosT& eos, const Shear& shear, const EosColumns& c) {
  parallel_for(0, c.density.size(), [&](std::size_t i) {
    const EosPoint point = state_of(eos, c, i);
    const double rho = c.density[i];
    c.pressure[i] = point.pressure;
    c.sound_speed[i] = longitudinal(sound_speed(point, rho, eos.sound_speed_floor()),
                                    shear(i, point, rho, c.specific_energy[i]), rho, eos.reference_density());
  });
}

/// The same of a porous one, which does not react.
template <class EosT, class Shear>
requires(!reacts<EosT>) std::int64_t
    porous_states(const EosT& eos, const Porosity& porosity, const DistensionSearch& search, const Shear& shear,
                  const EosColumns& c) {
  return parallel_sum<std::int64_t>(c.density.size(), [&](std::size_t i) -> std::int64_t {
    const double rho = c.density[i], e = c.specific_energy[i];
    const DistensionResult r = solve_distension(porosity.curve, eos, rho, e, c.distension[i], search);
    c.distension[i] = r.alpha;
    c.pressure[i] = bulk_pressure(r.solid, r.alpha);
    const double solid_density = r.alpha * rho;
    const double solid_speed =
        longitudinal(sound_speed(r.solid, solid_density, eos.sound_speed_floor()), shear(i, r.solid, solid_density, e),
                     solid_density, eos.reference_density());
    c.sound_speed[i] = porous_sound_speed(porosity, solid_speed, r.alpha);
    if (!c.stress_factor.empty())
      c.stress_factor[i] = porosity.stress_factor ? stress_factor(porosity.curve, r.solid, rho, r.alpha) : 1.0;
    return r.converged ? 0 : 1;
  });
}

}  // namespace ejecta
