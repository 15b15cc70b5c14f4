#pragma once
/// The one catalogue of particle fields: name, shape, SI unit, role, meaning. Allocation, sorting, checkpoints,
/// channels and CSV headers all follow from it. A column exists only if a stage or a channel names its field.
#include <array>
#include <string_view>

namespace ejecta {

enum class Field {
  position,
  velocity,
  acceleration,
  mass,
  start_position,
  bond,
  stretch,
  density,
  filling,
  volume_excess,
  compression_rate,
  specific_energy,
  specific_energy_rate,
  pressure,
  sound_speed,
  smoothing_length,
  smoothing_metric,
  zeroth_moment,
  velocity_gradient,
  uncut_gradient,
  density_gradient,
  pressure_gradient,
  face_correction,
  shock_switch,
  viscosity_factor,
  largest_mu,
  deviatoric_stress,
  stress_rate,
  shear_modulus,
  plastic_strain,
  shear_damage,
  distension,
  stress_factor,
  damage,
  intact_share,
  crack_length,
  local_strain,
  damage_tensor,
  strain_history,
  flaw_strain,
  flaw_exponent,
  flaw_count,
  pressure_peak,
  specific_energy_peak,
  density_low,
  initial_position,
  wall,
  lighting_time,
  burnt,
  count
};
inline constexpr int field_count = static_cast<int>(Field::count);

enum class Shape { scalar, vector, tensor, symmetric, deviator };
enum class Role {
  constant,  ///< set once
  state,     ///< advanced in time or with memory; makes up a checkpoint
  rate,      ///< time derivative of a state
  derived    ///< recomputed by the stages
};

struct FieldInfo {
  Field field;
  std::string_view name;
  Shape shape;
  std::string_view unit;
  Role role;
  std::string_view doc;
  Field rate_of = Field::count;  ///< of a rate: the state that it advances
};

/// In the order of the enumeration.
const std::array<FieldInfo, field_count>& field_catalogue();
inline const FieldInfo& info(Field f) { return field_catalogue()[static_cast<std::size_t>(f)]; }

/// Number of components of a shape in Dim dimensions.
constexpr int components(Shape shape, int dim) {
  switch (shape) {
    case Shape::scalar:
      return 1;
    case Shape::vector:
      return dim;
    case Shape::tensor:
      return dim * dim;
    case Shape::symmetric:
      return dim * (dim + 1) / 2;
    case Shape::deviator:
      return dim == 2 ? 3 : 5;
  }
  return 0;
}

}  // namespace ejecta
