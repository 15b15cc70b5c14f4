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
  std::string eos_model, strength_model = "none", damage_model = "none", porosity_model = "none";
  bool has_elastic = false;
  Eos eos;
  Elastic elastic{};
  Strength strength;
  double melt_energy = unset;  ///< J/kg; not set: never softens
  GradyKipp damage{};
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
