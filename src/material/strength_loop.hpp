#pragma once
/// The strength of many elements of one solid: particles, cells, whatever bears a stress.
#include <array>
#include <span>

#include "material/deviator.hpp"
#include "material/material.hpp"

namespace ejecta {

/// A value of every element, all spans of one length, in SI. Those that a material has no use for may be empty.
template <int Dim>
struct StrengthColumns {
  std::span<const double> density;             ///< of the body, pores included [kg/m^3]; yield_needs_temperature()
  std::span<const double> specific_energy;     ///< J/kg
  std::span<const double> pressure;            ///< of the body [Pa]
  std::span<const double> distension = {};     ///< of a porous material
  std::span<const double> damage = {};         ///< 0 to 1; empty: none
  std::span<const double> shear_modulus = {};  ///< Pa; empty: that of Elastic
  std::array<std::span<double>, static_cast<std::size_t>(deviator_size<Dim>)> deviatoric_stress;  ///< Pa
  std::span<double> plastic_strain;
  std::span<double> shear_damage = {};  ///< of a material that breaks_in_shear()
};

/// Brings the deviatoric stress of every element back to the yield surface, and adds the plastic strain and the damage
/// that this takes. The material is a solid with a strength; dt [s] is the time since the state before.
template <int Dim>
void apply_strength(const Material& material, const StrengthColumns<Dim>& columns, double dt);

}  // namespace ejecta
