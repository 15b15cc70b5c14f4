#pragma once
/// A small valid scene for tests, and what the reader says about a bad one.
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "scene/scene_reader.hpp"

namespace ejecta {

inline const std::string valid_scene = R"([scene]
name = "test"
[resolution]
spacing = "1 mm"
[time]
end = "20 us"
[[bodies]]
name = "target"
material = "basalt"
radius = "3 cm"
[[bodies]]
name = "projectile"
material = "nylon"
radius = "3.5 mm"
center = [0, "4 cm", 0]
velocity = [0, "-2.58 km/s", 0]
)";

/// The problems of a scene called s.toml; empty if it is accepted.
inline std::vector<std::string> problems_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_scene(text, "s.toml", overrides);
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}

}  // namespace ejecta
