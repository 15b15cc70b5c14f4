#pragma once
/// Sections of a scene file that belong to somebody else than the scene.
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ejecta {

class Describer;

/// Plain values with their defaults, and the one description from which reading, checking, echo and reference follow.
struct SectionSettings {
  virtual ~SectionSettings() = default;
  virtual void describe(Describer& describer) = 0;
};

struct SceneSection {
  std::string name, doc;  ///< "grid", "one sentence"
  std::function<std::shared_ptr<SectionSettings>()> settings;
  std::vector<std::string> schemes{};  ///< words of numerics.scheme with which it is there even if nobody has written it
};

}  // namespace ejecta
