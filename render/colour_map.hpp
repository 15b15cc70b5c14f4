#pragma once
/// Colour maps from a few published control points, and the colours of fragments and bodies.
#include <array>
#include <cstdint>
#include <span>
#include <string>
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

/// viridis, inferno, plasma, cool_warm.
std::string name_of(ColourMap map);
/// Throws std::invalid_argument naming those that there are.
ColourMap colour_map_named(const std::string& name);

/// Colour at `fraction` of the map; fractions are clamped to [0, 1].
Colour map_colour(ColourMap map, double fraction);

/// A colour map laid over a range of values, evenly, or beyond +-linear_to by their logarithm (asinh(v / linear_to)):
/// colours at ascending values, linear in between.
struct ColourScale {
  double min = 0, max = 1;
  double linear_to = 0;  ///< in the unit of the values; 0: all of it is linear
  std::vector<double> values;
  std::vector<Colour> colours;

  /// Values beyond the ends take the colours of the ends.
  Colour at(double value) const;
  /// Place of a value on a colour bar, 0 at min and 1 at max, and back.
  double place(double value) const;
  double value(double place) const;
};

/// The map over [min, max], min < max. The middle of a diverging map stays at zero; where no value lies below zero
/// inferno takes its place.
ColourScale colour_scale(ColourMap map, double min, double max, double linear_to = 0);

/// 0xRRGGBB of each value; `nothing` where it is not a number.
std::vector<std::uint32_t> coloured(std::span<const double> values, const ColourScale& scale, std::uint32_t nothing);

/// Colour of a fragment by its rank: 1 the heaviest. The first five are strong, what follows pales, 0 (dust) is faint.
Colour rank_colour(int rank);

/// Colour of a body that is shown as such, by its place in the scene.
Colour body_colour(int body);

}  // namespace ejecta
