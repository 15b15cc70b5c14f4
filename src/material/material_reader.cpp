#include "material/material_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/errors.hpp"
#include "material/material_settings.hpp"
#include "scene/names.hpp"
#include "scene/scene_reader.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

Document find_material(const std::string& name, const std::vector<std::string>& folders, const Document& overrides,
                       const std::string& asked_by) {
  std::string searched;
  for (const std::string& folder : folders) {
    const std::filesystem::path path = std::filesystem::path(folder) / (name + ".toml");
    if (std::filesystem::is_regular_file(path)) return read_document(path.string());
    searched += (searched.empty() ? "" : " and ") + path.string();
  }
  if (!overrides.items.contains("eos.model"))
    throw InputError(fmt::format("{}material \"{}\": no such file: searched {}", asked_by, name, searched));
  Document empty;
  empty.file = overrides.file;
  return empty;
}

/// A section of a material file that the scene has replaced, and why.
struct Replaced {
  std::string section;
  Origin by;         ///< the model that the scene gives
  std::string text;  ///< what was in its place
};

/// Puts the values of the scene in place of those of the file. Another model takes the place of the whole section: its
/// constants would be those of something else.
std::vector<Replaced> merge(Document& document, const Document& overrides) {
  std::vector<Replaced> replaced;
  for (const std::string section : {"eos", "strength", "damage", "porosity"}) {
    const auto item = overrides.items.find(section + ".model");
    const auto own = document.items.find(section + ".model");
    if (item == overrides.items.end() || own == document.items.end()) continue;
    if (to_text(item->second.literal) == to_text(own->second.literal)) continue;
    replaced.push_back(
        {section, item->second.origin,
         fmt::format("{} is another model than {} of {}, and replaces all of its section: no constant of "
                     "that stays, so that all must be given",
                     to_text(item->second.literal), to_text(own->second.literal), own->second.origin.text)});
    std::erase_if(document.items, [&](const auto& entry) { return entry.first.starts_with(section + "."); });
  }
  for (const auto& [path, item] : overrides.items) document.items.insert_or_assign(path, item);
  for (const auto& [path, origin] : overrides.tables) document.tables.insert_or_assign(path, origin);
  return replaced;
}

/// Constants that are missing where a section has been replaced: says why.
void explain(const std::vector<Replaced>& replaced, const Describer& description, const Document& document,
             Problems& problems) {
  for (const Replaced& r : replaced) {
    const auto missing = [&](const Setting& setting) {
      return setting.path().starts_with(r.section + ".") && !document.items.contains(setting.path()) &&
             problems.has(setting.path());
    };
    if (std::ranges::any_of(description.settings(), missing)) problems.add(r.by, r.section + ".model", r.text);
  }
}

/// Moves [eos] to [materials.<name>.eos].
std::string toml_in_scene(const std::string& toml, const std::string& name) {
  std::string text;
  for (const char c : toml) {
    const bool header = c == '[' && (text.empty() || text.back() == '\n');
    text += c;
    if (header) text += "materials." + name + ".";
  }
  return text;
}

/// What bodies and numerics ask of the materials.
void check_use(const Scene& scene, const std::vector<Material>& materials, std::vector<std::string>& problems) {
  for (const Body& body : scene.bodies) {
    const auto found =
        std::find_if(materials.begin(), materials.end(), [&](const auto& m) { return m.name == body.material; });
    if (found == materials.end()) continue;
    const auto report = [&](const std::string& message) {
      problems.push_back(fmt::format("{}: bodies.{}: {}", body.origin, body.name, message));
    };
    const bool apart = scene.numerics.scheme == SchemeKind::hybrid;  // solids are particles of their own there
    if (scene.numerics.godunov() && !apart && !found->gas())
      report(
          fmt::format("numerics.scheme: expected sph or asph, got {}: {} is no gas, and Riemann problems are of gases",
                      name_of(scene.numerics.scheme), body.material));
    else if (scene.numerics.density == DensityMethod::summation && !apart && !found->gas())
      report(fmt::format(
          "numerics.density: expected continuity, got summation: {} is no gas, and a summed density falls off "
          "at free surfaces",
          body.material));
    if (found->explosive() && scene.numerics.scheme != SchemeKind::sph && scene.numerics.scheme != SchemeKind::asph)
      report(fmt::format("numerics.scheme: expected sph or asph, got {}: {} is an explosive, which burns as particles",
                         name_of(scene.numerics.scheme), body.material));
    if (!body.profile.deviatoric_stress.empty() && !found->solid())
      report(fmt::format("profile.deviatoric_stress: only a solid can bear it, and {} is none", body.material));
    const double bulk = found->bulk_density();
    if ((is_set(body.pressure) || !body.profile.pressure.empty()) && !specific_energy_at(found->eos, bulk, 0))
      report(fmt::format("pressure: only a gas can be given one, and {} is none", body.material));
    if (found->porosity && is_set(body.density) && std::abs(body.density - bulk) > 1e-6 * bulk)
      report(fmt::format(
          "density: expected {}, the bulk density of {}, got {}; to change it set "
          "materials.{}.porosity.initial_distension",
          format_exact(bulk, "kg/m^3"), body.material, format_exact(body.density, "kg/m^3"), body.material));
  }
}

}  // namespace

std::size_t Materials::index(std::string_view name) const {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Material& m) { return m.name == name; });
  return static_cast<std::size_t>(found - list.begin());
}

Material read_material(const std::string& name, const std::vector<std::string>& folders, const Document& overrides,
                       std::string* toml, const std::string& asked_by) {
  Document document = find_material(name, folders, overrides, asked_by);
  const std::vector<Replaced> replaced = merge(document, overrides);
  Problems problems;
  MaterialSettings settings;
  choose_models(settings, document, problems);
  Describer description;
  describe(description, settings);
  read_settings(description, document, problems);
  explain(replaced, description, document, problems);
  check_settings(settings, document, problems);
  problems.throw_if_any();
  if (toml) *toml = toml_in_scene(write_toml(description), name);
  return make_material(name, settings);
}

Materials read_materials(const Scene& scene, const std::string& library) {
  const std::filesystem::path beside = std::filesystem::path(scene.file).parent_path() / "materials";
  Materials materials;
  std::vector<std::string> problems, read;
  for (const Body& body : scene.bodies) {
    if (std::find(read.begin(), read.end(), body.material) != read.end()) continue;
    read.push_back(body.material);
    const auto overrides = scene.materials.find(body.material);
    std::string toml;
    try {
      materials.list.push_back(read_material(body.material, {beside.string(), library},
                                             overrides == scene.materials.end() ? Document{} : overrides->second, &toml,
                                             fmt::format("{}: bodies.{}: ", body.origin, body.name)));
      materials.toml += toml;
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  check_use(scene, materials.list, problems);
  if (problems.empty() &&
      std::ranges::none_of(materials.list, [](const Material& m) { return m.explosive().has_value(); }))
    for (const Detonator& detonator : scene.detonators)
      problems.push_back(fmt::format("{}: detonators: no body is of an explosive", detonator.origin));
  if (!problems.empty()) throw InputError(problems);
  return materials;
}

double initial_energy(const Body& body, const Material& material, double density) {
  if (!is_set(body.pressure)) return energy_at_rest(material.eos) + body.specific_energy;
  return specific_energy_at(material.eos, density, body.pressure).value();
}

std::string resolved_toml(const Scene& scene, const Materials& materials) { return scene_toml(scene) + materials.toml; }

std::string reference(std::string_view section, const std::vector<SceneSection>& sections) {
  std::string text = scene_reference(section, sections);
  // Every block of every model once; materials.eos and eos both mean that section.
  const bool all = section.empty() || section == "materials";
  std::string_view part = section;
  if (part.starts_with("materials.")) part.remove_prefix(std::string_view("materials.").size());
  std::vector<std::string> blocks;
  for (const std::string name : {"eos", "elastic", "strength", "damage", "porosity"}) {
    if (!all && part != name) continue;
    for (MaterialSettings& settings : every_model()) {
      Describer description;
      describe(description, settings);
      const std::string block = toml_in_scene(write_reference(description, name).substr(1), "<name>");
      if (std::find(blocks.begin(), blocks.end(), block) == blocks.end()) blocks.push_back(block);
    }
  }
  for (const std::string& block : blocks) text += "\n" + block;
  if (text.empty())
    throw InputError(fmt::format("describe {}: no such section; without a name all are listed", section));
  return text;
}

}  // namespace ejecta
