#pragma once
/// Every material that is shipped, for tests of what must hold for all of them.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "material/material_reader.hpp"

namespace ejecta {

inline std::vector<Material> shipped_materials() {
  const std::string library = EJECTA_SOURCE_DIR "/inputs/materials";
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(library)) names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  std::vector<Material> materials;
  for (const std::string& name : names) materials.push_back(read_material(name, {library}));
  return materials;
}

/// Calls body(name, constants) for each that has Tillotson's equation of state.
template <class Body>
void for_each_tillotson(Body&& body) {
  for (const Material& material : shipped_materials())
    if (const auto* eos = std::get_if<Tillotson>(&material.eos)) body(material.name, *eos);
}

}  // namespace ejecta
