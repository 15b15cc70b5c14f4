#include "particles/fields.hpp"

namespace ejecta {

const std::array<FieldInfo, field_count>& field_catalogue() {
  using enum Shape;
  using enum Role;
  static constexpr std::array<FieldInfo, field_count> catalogue{{
      {Field::position, "position", vector, "m", state, "particle position"},
      {Field::velocity, "velocity", vector, "m/s", state, "particle velocity"},
      {Field::acceleration, "acceleration", vector, "m/s^2", rate, "rate of velocity", Field::velocity},
      {Field::mass, "mass", scalar, "kg", constant, "particle mass (kg/m in plane strain)"},
      {Field::start_position, "start_position", vector, "m", state,
       "where the bonds of the particle saw it at the start; moves across faces with it"},
      {Field::bond, "bond", scalar, "1", state, "1 while the particle holds on to the neighbours of the start"},
      {Field::stretch, "stretch", scalar, "1", state, "longest bond over its length at the start, at least 1"},
      {Field::density, "density", scalar, "kg/m^3", state, "bulk density"},
      {Field::compression_rate, "compression_rate", scalar, "1/s", rate, "rate of ln(density) by continuity",
       Field::density},
      {Field::specific_energy, "specific_energy", scalar, "J/kg", state, "specific internal energy"},
      {Field::specific_energy_rate, "specific_energy_rate", scalar, "W/kg", rate, "rate of specific internal energy",
       Field::specific_energy},
      {Field::pressure, "pressure", scalar, "Pa", derived, "pressure after damage, compression positive"},
      {Field::sound_speed, "sound_speed", scalar, "m/s", derived, "longitudinal sound speed"},
      {Field::smoothing_length, "smoothing_length", scalar, "m", state, "smoothing length h; det(H)^(-1/Dim) in ASPH"},
      {Field::smoothing_metric, "smoothing_metric", symmetric, "1/m^2", state,
       "G = H H of the smoothing tensor H: |H x|^2 = x.G x"},
      {Field::zeroth_moment, "zeroth_moment", scalar, "1", derived, "sum of |dW/deta| over the neighbours (Owen 2010)"},
      {Field::velocity_gradient, "velocity_gradient", tensor, "1/s", derived, "dv_a/dx_b, row by row"},
      {Field::uncut_gradient, "uncut_gradient", tensor, "1/s", derived,
       "dv_a/dx_b as seen by the neighbours that no crack cuts off"},
      {Field::density_gradient, "density_gradient", vector, "kg/m^4", derived, "gradient of the bulk density"},
      {Field::pressure_gradient, "pressure_gradient", vector, "Pa/m", derived, "gradient of the pressure"},
      {Field::face_correction, "face_correction", tensor, "1", derived,
       "what makes gradients of kernels exact for linear fields, row by row"},
      {Field::shock_switch, "shock_switch", scalar, "1", state, "share of the viscosity in smooth flow: 1 in a shock"},
      {Field::viscosity_factor, "viscosity_factor", scalar, "1", state, "Balsara factor of the viscosity"},
      {Field::largest_mu, "largest_mu", scalar, "m/s", derived, "largest |mu| of the viscosity over the pairs"},
      {Field::deviatoric_stress, "deviatoric_stress", deviator, "Pa", state, "stress deviator before damage"},
      {Field::stress_rate, "stress_rate", deviator, "Pa/s", rate, "objective rate of the stress deviator",
       Field::deviatoric_stress},
      {Field::shear_modulus, "shear_modulus", scalar, "Pa", derived, "of the solid, where it varies; 0 when melted"},
      {Field::plastic_strain, "plastic_strain", scalar, "1", state, "accumulated equivalent plastic strain"},
      {Field::shear_damage, "shear_damage", scalar, "1", state, "share of the plastic strain that breaks the rock"},
      {Field::distension, "distension", scalar, "1", state, "alpha = solid density / bulk density"},
      {Field::stress_factor, "stress_factor", scalar, "1", derived, "share of the strain rate that the solid sees"},
      {Field::damage, "damage", scalar, "1", state,
       "total damage: tension, shear and pore crushing, at most 1, never healing; with tensor damage its largest "
       "eigenvalue"},
      {Field::intact_share, "intact_share", scalar, "1", derived,
       "share of the stress deviator that damage without a direction leaves"},
      {Field::crack_length, "crack_length", scalar, "1", state,
       "of a crack, by that of a broken particle: root of the tensile damage, cube root, in plane strain square root "
       "unless growth is benz_asphaug"},
      {Field::local_strain, "local_strain", scalar, "1", state,
       "tensile strain that opens flaws; below the weakest one an upper bound"},
      {Field::damage_tensor, "damage_tensor", symmetric, "1", state,
       "damage across each direction n: n.D n, eigenvalues 0 to 1"},
      {Field::strain_history, "strain_history", symmetric, "1", state,
       "strain that opens the cracks of tensor damage, in the body's own frame"},
      {Field::flaw_strain, "flaw_strain", scalar, "1", constant, "activation strain of the weakest flaw"},
      {Field::flaw_exponent, "flaw_exponent", scalar, "1", constant,
       "growth of active flaws: n = (strain/weakest)^exponent (growth benz_asphaug)"},
      {Field::flaw_count, "flaw_count", scalar, "1", constant, "number of flaws (growth benz_asphaug)"},
      {Field::pressure_peak, "pressure_peak", scalar, "Pa", state, "highest pressure so far"},
      {Field::specific_energy_peak, "specific_energy_peak", scalar, "J/kg", state,
       "highest specific internal energy so far"},
      {Field::density_low, "density_low", scalar, "kg/m^3", state, "lowest bulk density so far"},
      {Field::initial_position, "initial_position", vector, "m", constant, "position at the start"},
      {Field::wall, "wall", scalar, "1", constant, "1 for what gas sees of a solid: such particles do not feel each other"},
      {Field::lighting_time, "lighting_time", scalar, "s", constant,
       "when the detonation reaches an explosive; infinite where no path leads to it, 0 in other matter"},
      {Field::burnt, "burnt", scalar, "1", state, "burnt fraction of an explosive, never falling"},
  }};
  return catalogue;
}

}  // namespace ejecta
