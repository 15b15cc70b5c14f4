#pragma once
/// Scene files in, checked settings out.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.hpp"
#include "scene/settings_io.hpp"

namespace ejecta {

/// What the program beyond the reader adds to a scene file.
struct SceneContext {
  std::vector<SceneSection> sections;         ///< that it may have beside its own; Scene::sections holds the ones it has
  std::map<std::string, std::string> fields;  ///< name -> SI unit of those that insitu.ranges may name; empty: any
};

/// Reads a scene and applies overrides such as "time.end=20us" (what --set was given). Throws InputError with
/// everything that is wrong: unknown keys, types, units, ranges, and values that do not go together. Pipelines come
/// back as paths that exist.
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides = {},
                 const SceneContext& context = {});

/// The same from text; `name` stands for the path.
Scene parse_scene(const std::string& text, const std::string& name, const std::vector<std::string>& overrides = {},
                  const SceneContext& context = {});

/// Adds a problem for every pair of values that do not go together. `document` tells where they were written.
void check_scene(const Scene& scene, const Document& document, Problems& problems);

/// Every value of the scene, in SI, as a scene that can be run again. Materials are echoed by the material reader.
std::string scene_toml(const Scene& scene);

/// Every key of a scene, or of one section, with unit, range, default and meaning. Empty if there is no such section.
std::string scene_reference(std::string_view section = "", const std::vector<SceneSection>& sections = {});

}  // namespace ejecta
