#pragma once
/// How packages come into a run.
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "material/material.hpp"
#include "model/package.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// Expected costs of a package, before it is set up.
struct Estimate {
  std::string element;        ///< "particle", "cell"
  double elements = 0;        ///< how many
  double bytes_each = 0;      ///< memory of one
  double steps = 0;           ///< of the run, while nothing is faster than at the start
  double seconds = 0;         ///< wall time
};

struct PackageKind {
  SceneSection section;                           ///< what a scene says about it; no name: nothing
  /// Throws InputError if the scene asks for what cannot be, SimulationError if the first evaluation fails.
  std::function<std::unique_ptr<Package>(const Scene&, const std::vector<Material>&)> set_up;
  std::map<std::string, std::string> fields{};     ///< that its channels may show: name -> SI unit
  std::function<bool(const Scene&)> takes_part{};  ///< in a run; empty: if the scene has the section
  std::function<Estimate(const Scene&, const std::vector<Material>&)> estimate{};  ///< empty: not worth a word

  bool in(const Scene& scene) const {
    return takes_part ? takes_part(scene) : scene.sections.contains(section.name);
  }
};

/// All there are, in the order in which they advance. This is the one place that knows them: app/packages.cpp.
const std::vector<PackageKind>& package_kinds();

/// What they add to a scene file.
inline std::vector<SceneSection> package_sections() {
  std::vector<SceneSection> sections;
  for (const PackageKind& kind : package_kinds())
    if (!kind.section.name.empty()) sections.push_back(kind.section);
  return sections;
}

/// What their channels may show: name -> SI unit.
inline std::map<std::string, std::string> package_fields() {
  std::map<std::string, std::string> fields;
  for (const PackageKind& kind : package_kinds()) fields.insert(kind.fields.begin(), kind.fields.end());
  return fields;
}

}  // namespace ejecta
