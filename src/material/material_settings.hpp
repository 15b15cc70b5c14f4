#pragma once
/// What a material file says, before a Material is made of it: each part has a model, and the model has its constants.
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "material/material.hpp"
#include "scene/settings_io.hpp"

namespace ejecta {

/// The words for the strain that opens flaws.
constexpr auto enum_names(CrackStrain) {
  return std::to_array<std::string_view>({"benz_asphaug", "pseudo_plastic", "strain_history"});
}

constexpr auto enum_names(CrackLaw) { return std::to_array<std::string_view>({"grady_kipp", "benz_asphaug"}); }

enum class DamageModel { none, grady_kipp, grady_kipp_tensor };
constexpr auto enum_names(DamageModel) {
  return std::to_array<std::string_view>({"none", "grady_kipp", "grady_kipp_tensor"});
}

/// Forms of the crush curve.
enum class PorosityModel { none, quadratic, two_power };
constexpr auto enum_names(PorosityModel) {
  return std::to_array<std::string_view>({"none", "quadratic", "two_power"});
}

struct PorositySettings {
  double initial_distension = unset;     ///< alpha0 = grain density / bulk density
  double elastic_pressure = unset;       ///< P_e [Pa]
  double transition_pressure = unset;    ///< P_t [Pa]; two_power only, like the next four
  double solid_pressure = unset;         ///< P_s [Pa]
  double reference_distension = unset;   ///< alpha_e
  double transition_distension = unset;  ///< alpha_t
  std::optional<int> n1, n2;
  double sound_speed = unset;  ///< m/s; not set: that of the solid
  bool stress_factor = true;
  bool crush_damage = true;
};

struct MaterialSettings {
  std::optional<Eos> eos;  ///< nothing: not given, which has been reported
  std::optional<Elastic> elastic;
  std::optional<Strength> strength;
  double melt_energy = unset;  ///< J/kg; not set: never softens
  DamageModel damage_model = DamageModel::none;
  GradyKipp damage{};
  PorosityModel porosity_model = PorosityModel::none;
  PorositySettings porosity;
};

/// Takes the models a document names (they decide which constants exist) into the settings. A wrong or missing model is
/// reported, and what lies in its section is taken out of the document.
void choose_models(MaterialSettings& settings, Document& document, Problems& problems);

/// The settings of the chosen models, one line per constant.
void describe(Describer& d, MaterialSettings& settings);

/// Reports constants that do not go together.
void check_settings(const MaterialSettings& settings, const Document& document, Problems& problems);

Material make_material(const std::string& name, const MaterialSettings& settings);

/// One settings per combination that shows every model once; for the reference.
std::vector<MaterialSettings> every_model();

}  // namespace ejecta
