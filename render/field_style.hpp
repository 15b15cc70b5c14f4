#pragma once
/// How a field is shown, by Ejecta's own painter and by the pipelines alike.
#include <algorithm>
#include <optional>
#include <string>

#include "render/colour_map.hpp"
#include "scene/scene.hpp"

namespace ejecta {

struct FieldStyle {
  std::string label;  ///< in words
  ColourMap map = ColourMap::viridis;
  std::optional<ColourRange> range;  ///< ends of the colour bar [SI]; none: nothing is known before the first frame
};

/// Of a field nobody has chosen a style for: its own name, viridis.
inline FieldStyle plain_style(std::string field) {
  std::ranges::replace(field, '_', ' ');
  return {std::move(field), ColourMap::viridis, {}};
}

}  // namespace ejecta
