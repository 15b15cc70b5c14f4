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
  double linear_to = 0;              ///< colours follow the logarithm beyond this value [SI]; 0: they never do

  /// Over a range that is known.
  ColourScale scale(const ColourRange& over) const { return colour_scale(map, over.min, over.max, linear_to); }
};

/// Of a field nobody has chosen a style for: its own name, viridis.
inline FieldStyle plain_style(std::string field) {
  std::ranges::replace(field, '_', ' ');
  return {std::move(field), ColourMap::viridis, {}};
}

}  // namespace ejecta
