#pragma once
/// Colour maps from a few published control points, and names for the colours of fragments.
#include <array>
#include <cstdint>
#include <string_view>

namespace ejecta {

/// Red, green, blue, each in [0, 1], sRGB.
struct Colour {
  double red, green, blue;
};

enum class ColourMap {
  viridis,    ///< sequential, perceptually even [van der Walt & Smith 2015]
  inferno,    ///< sequential, dark to bright [van der Walt & Smith 2015]
  cool_warm,  ///< diverging, for fields with a meaningful zero [Moreland 2009]
};

/// Colour at `fraction` of the map; fractions are clamped to [0, 1].
Colour map_colour(ColourMap map, double fraction);

/// Colour of a fragment by its stable number: 0 (dust) is near white, 1 grey, the others well-spread hues.
Colour fragment_colour(std::int32_t number);

}  // namespace ejecta
