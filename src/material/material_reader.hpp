#pragma once
/// Material files in, checked materials out.
#include <string>
#include <string_view>
#include <vector>

#include "material/material.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// The materials of a scene, each once, in the order of the bodies that use them.
struct Materials {
  std::vector<Material> list;
  std::string toml;  ///< every constant in SI, as sections [materials.<name>.*] of a scene

  /// Index of a material by its name; the name must be there.
  std::size_t index(std::string_view name) const;
};

/// Reads <name>.toml from the first folder that has it. Values of `overrides` (paths such as "eos.A") replace those of
/// the file; a section that names another model replaces the whole section. No file is needed if they name the eos
/// model. Throws InputError with everything that is wrong. `toml`, if given, receives the constants as sections of a
/// scene. `asked_by` begins the message about a missing file.
Material read_material(const std::string& name, const std::vector<std::string>& folders, const Document& overrides = {},
                       std::string* toml = nullptr, const std::string& asked_by = "");

/// All materials of a scene: from the folder materials/ beside the scene file, else from `library`. Checks what bodies
/// and numerics ask of them. Throws InputError with the problems of all materials.
Materials read_materials(const Scene& scene, const std::string& library);

/// Specific energy with which the matter of a body begins at this density [kg/m^3]: its own, or that of its pressure
/// [J/kg].
double initial_energy(const Body& body, const Material& material, double density);

/// Everything a run was given, defaults included, in SI, as one scene file that needs no other and runs again.
std::string resolved_toml(const Scene& scene, const Materials& materials);

/// The reference of all settings of scenes and materials, or of one section (`materials` for all of theirs). Throws
/// InputError if there is no such section.
std::string reference(std::string_view section = "", const std::vector<SceneSection>& sections = {});

}  // namespace ejecta
