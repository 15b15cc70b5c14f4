#pragma once
/// Colour maps from a few published control points, and names for the colours of fragments.
#include <array>
#include <cstdint>
#include <vector>

namespace ejecta {

/// Red, green, blue, each in [0, 1], sRGB.
struct Colour {
  double red, green, blue;
};

enum class ColourMap {
  viridis,    ///< sequential, perceptually even [van der Walt & Smith 2015]
  inferno,    ///< sequential, dark to bright [van der Walt & Smith 2015]
  plasma,     ///< sequential, blue to yellow [van der Walt & Smith 2015]
  cool_warm,  ///< diverging, for fields with a meaningful zero [Moreland 2009]
};

/// Colour at `fraction` of the map; fractions are clamped to [0, 1].
Colour map_colour(ColourMap map, double fraction);

/// A colour map laid over a range of values: colours at ascending values, linear in between.
struct ColourScale {
  std::vector<double> values;
  std::vector<Colour> colours;

  /// Values beyond the ends take the colours of the ends.
  Colour at(double value) const;
};

/// The map over [min, max], min < max. The middle of a diverging map stays at zero; where no value lies below zero
/// inferno takes its place.
ColourScale colour_scale(ColourMap map, double min, double max);

/// Colour of a fragment by its stable number: 0 (dust) is near white, 1 grey, the others well-spread hues.
Colour fragment_colour(std::int32_t number);

}  // namespace ejecta
