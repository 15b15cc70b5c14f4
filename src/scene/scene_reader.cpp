#include "scene/scene_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/data_folder.hpp"
#include "base/errors.hpp"
#include "scene/describe.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

/// Takes [materials.*] out of the document: what they hold depends on the models of each material.
void take_materials(Document& document, Scene& scene, Problems& problems) {
  for (const std::string& name : document.children("materials")) {
    const std::string path = "materials." + name;
    if (const auto item = document.items.find(path); item != document.items.end())
      problems.add(item->second.origin, path, "expected a section, got " + to_text(item->second.literal));
    scene.materials[name] = document.below(path);
  }
  const auto below_materials = [](const auto& entry) { return entry.first.starts_with("materials."); };
  std::erase_if(document.items, below_materials);
  std::erase_if(document.tables, below_materials);
  document.tables.erase("materials");
}

/// A word that checkpoints and scenes of earlier versions have.
void translate_former_words(Document& document) {
  const auto item = document.items.find("insitu.on_error");
  if (item == document.items.end()) return;
  const auto* word = std::get_if<std::string>(&item->second.literal.value);
  if (word && *word == "continue") item->second.literal.value = std::string("warn");
}

/// Pipelines may be written short, as a list of scripts.
void expand_pipelines(Document& document, Problems& problems) {
  const std::string path = "insitu.pipelines";
  expand_short_list(document, path, "script");
  if (const auto item = document.items.find(path); item != document.items.end()) {
    problems.add(item->second.origin, path,
                 R"(expected a list such as ["default", "a.py", {script = "b.py", every = "2 us"}], got )" +
                     to_text(item->second.literal));
    document.items.erase(item);
  }
}

/// A pipeline is written relative to the scene file, or is one of those that come with Ejecta.
void find_pipelines(Scene& scene, const Document& document, Problems& problems) {
  namespace fs = std::filesystem;
  for (std::size_t k = 0; k < scene.insitu.pipelines.size(); ++k) {
    std::string& pipeline = scene.insitu.pipelines[k].script;
    if (pipeline.empty() && !problems.has(element_path("insitu.pipelines", k) + ".script"))
      problems.add(document.origin("insitu.pipelines"), element_path("insitu.pipelines", k) + ".script",
                   "expected the path of a script, got nothing");
    if (pipeline == default_pipelines_name || pipeline.empty()) continue;
    const fs::path beside = fs::path(scene.file).parent_path() / pipeline;  // an absolute path stays itself
    const fs::path shipped = data_folder() / "catalyst_scripts" / pipeline;
    if (const bool own = fs::is_regular_file(beside); own || fs::is_regular_file(shipped)) {
      pipeline = fs::absolute(own ? beside : shipped).lexically_normal().string();
    } else {
      const std::string key = element_path("insitu.pipelines", k) + ".script";
      std::string complaint = fmt::format("expected a script, got \"{}\": no such file {}", pipeline, beside.string());
      if (shipped != beside) complaint += fmt::format(", nor {}", shipped.lexically_normal().string());
      problems.add(document.origin(key), key, complaint);
    }
  }
}

/// Measured traces and lists are written relative to the scene file.
void find_measured(Scene& scene, const Document& document, Problems& problems) {
  namespace fs = std::filesystem;
  const auto find = [&](std::string& file, const std::string& key) {
    if (file.empty()) return;
    const fs::path beside = fs::path(scene.file).parent_path() / file;  // an absolute path stays itself
    if (fs::is_regular_file(beside))
      file = fs::absolute(beside).lexically_normal().string();
    else
      problems.add(document.origin(key), key,
                   fmt::format("expected a CSV file, got \"{}\": no such file {}", file, beside.string()));
  };
  for (std::size_t k = 0; k < scene.probes.size(); ++k)
    find(scene.probes[k].measured, element_path("probes", k) + ".measured");
  find(scene.fragments.measured, "fragments.measured");
}

/// The numbers of a colour range stand in SI; texts carry a unit, which must be one of the field.
void check_ranges(const Document& document, const std::map<std::string, std::string>& fields, Problems& problems) {
  std::vector<std::string> names;
  for (const auto& [name, unit] : fields) names.push_back(name);
  for (const std::string& name : document.children("insitu.ranges")) {
    const std::string path = "insitu.ranges." + name;
    const auto field = fields.find(name);
    if (field == fields.end()) {
      const std::string near = nearest_word(name, names);
      problems.add(document.origin(path), path,
                   near.empty() ? "no such field" : "no such field, did you mean " + near + "?");
      continue;
    }
    const auto item = document.items.find(path);
    const auto* list = item == document.items.end() ? nullptr : std::get_if<LiteralList>(&item->second.literal.value);
    if (!list || problems.has(path)) continue;
    try {
      for (const Literal& bound : *list)
        if (const auto* text = std::get_if<std::string>(&bound.value)) parse_quantity(*text, field->second);
    } catch (const InputError& error) {
      problems.add(item->second.origin, path, error.what());
    }
  }
}

/// Whether numerics.scheme is one of these words: sections that come with a scheme have to be known before it is read.
bool asks_for(const Document& document, const std::vector<std::string>& schemes) {
  const auto item = document.items.find("numerics.scheme");
  const auto* word = item == document.items.end() ? nullptr : std::get_if<std::string>(&item->second.literal.value);
  return word && std::ranges::find(schemes, *word) != schemes.end();
}

Scene interpret(Document document, const std::vector<std::string>& overrides, const SceneContext& context) {
  Problems problems;
  for (const std::string& assignment : overrides) {
    try {
      apply_override(document, assignment);
    } catch (const InputError& error) {
      problems.add(error.problems());
    }
  }
  Scene scene;
  scene.file = document.file;
  translate_former_words(document);
  expand_pipelines(document, problems);
  take_materials(document, scene, problems);
  for (const SceneSection& section : context.sections)
    if (document.holds(section.name) || asks_for(document, section.schemes))
      scene.sections[section.name] = section.settings();
  for (const SceneSection& section : context.sections)
    if (document.holds(section.name) && !section.schemes.empty() && !asks_for(document, section.schemes))
      problems.add(document.origin(section.name), section.name,
                   fmt::format("expected numerics.scheme = \"{}\" with it", fmt::join(section.schemes, "\" or \"")));
  if (document.holds("charge")) scene.charge.emplace();
  if (document.holds("gas")) scene.gas.emplace();
  Describer description(document);
  describe(description, scene, context.sections);
  read_settings(description, document, problems);
  // Riemann problems are of gases, whose volumes are sums over their neighbours unless asked otherwise.
  if (scene.numerics.godunov() && !document.items.contains("numerics.density"))
    scene.numerics.density = DensityMethod::summation;
  if (!context.fields.empty()) check_ranges(document, context.fields, problems);
  find_pipelines(scene, document, problems);
  find_measured(scene, document, problems);
  add_blast(scene, document, problems);
  check_scene(scene, document, problems);
  problems.throw_if_any();
  return scene;
}

}  // namespace

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides, const SceneContext& context) {
  return interpret(read_document(path), overrides, context);
}

Scene parse_scene(const std::string& text, const std::string& name, const std::vector<std::string>& overrides,
                  const SceneContext& context) {
  return interpret(parse_document(text, name), overrides, context);
}

std::string scene_toml(const Scene& scene) {
  Scene copy = scene;  // a description can also write, so it asks for values it may change
  std::erase_if(copy.bodies, [](const Body& body) { return body.implied; });
  Describer description;
  describe(description, copy);
  return write_toml(description);
}

std::string scene_reference(std::string_view section, const std::vector<SceneSection>& sections) {
  Scene scene;
  for (const SceneSection& s : sections) scene.sections[s.name] = s.settings();
  scene.charge.emplace();
  scene.gas.emplace();
  Describer description = Describer::of_all_there_may_be();
  describe(description, scene, sections);
  return write_reference(description, section);
}

}  // namespace ejecta
