#include "render/colour_map.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/parallel.hpp"
#include "render/raster.hpp"

namespace ejecta {

namespace {

using ControlPoints = std::array<std::uint32_t, 9>;  // 0xRRGGBB, equally spaced

constexpr ControlPoints viridis{0x440154, 0x472D7B, 0x3B528B, 0x2C728E, 0x21918C,
                                0x28AE80, 0x5EC962, 0xADDC30, 0xFDE725};
constexpr ControlPoints inferno{0x000004, 0x210C4A, 0x57106E, 0x8A226A, 0xBC3754,
                                0xE45A31, 0xF98E09, 0xF9CB35, 0xFCFFA4};
constexpr ControlPoints plasma{0x0D0887, 0x4C02A1, 0x7E03A8, 0xAA2395, 0xCC4778,
                               0xE66C5C, 0xF89540, 0xFDC527, 0xF0F921};
constexpr ControlPoints cool_warm{0x3B4CC0, 0x6282EA, 0x8DB0FE, 0xB8D0F9, 0xDDDDDD,
                                  0xF5C4AD, 0xF49A7B, 0xDE604D, 0xB40426};

const ControlPoints& control_points(ColourMap map) {
  switch (map) {
    case ColourMap::viridis:
      return viridis;
    case ColourMap::inferno:
      return inferno;
    case ColourMap::plasma:
      return plasma;
    case ColourMap::cool_warm:
      return cool_warm;
  }
  return viridis;
}

Colour mixed(Colour a, Colour b, double t) {
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green), a.blue + t * (b.blue - a.blue)};
}

}  // namespace

Colour map_colour(ColourMap map, double fraction) {
  const ControlPoints& points = control_points(map);
  const double place = std::clamp(fraction, 0.0, 1.0) * (points.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(place), points.size() - 2);
  const double t = place - static_cast<double>(k);
  return mixed(unpacked(points[k]), unpacked(points[k + 1]), t);
}

namespace {
constexpr std::pair<ColourMap, const char*> names[] = {{ColourMap::viridis, "viridis"},
                                                       {ColourMap::inferno, "inferno"},
                                                       {ColourMap::plasma, "plasma"},
                                                       {ColourMap::cool_warm, "cool_warm"}};
}  // namespace

std::string name_of(ColourMap map) {
  return std::ranges::find(names, map, &std::pair<ColourMap, const char*>::first)->second;
}

ColourMap colour_map_named(const std::string& name) {
  for (const auto& [map, word] : names)
    if (name == word) return map;
  throw std::invalid_argument("colour map '" + name + "' unknown; there are viridis, inferno, plasma, cool_warm");
}

Colour ColourScale::at(double value) const {
  const auto above = std::upper_bound(values.begin() + 1, values.end() - 1, value) - values.begin();
  const auto k = static_cast<std::size_t>(above);
  const double t = std::clamp((value - values[k - 1]) / (values[k] - values[k - 1]), 0.0, 1.0);
  return mixed(colours[k - 1], colours[k], t);
}

double ColourScale::place(double value) const {
  const auto laid = [&](double v) { return linear_to > 0 ? std::asinh(v / linear_to) : v; };
  return (laid(value) - laid(min)) / (laid(max) - laid(min));
}

double ColourScale::value(double place) const {
  if (!(linear_to > 0)) return min + place * (max - min);
  const double low = std::asinh(min / linear_to), high = std::asinh(max / linear_to);
  return linear_to * std::sinh(low + place * (high - low));
}

ColourScale colour_scale(ColourMap map, double min, double max, double linear_to) {
  const bool diverging = map == ColourMap::cool_warm && min < 0;
  if (map == ColourMap::cool_warm && !diverging) map = ColourMap::inferno;
  const auto laid = [&](double v) { return linear_to > 0 ? std::asinh(v / linear_to) : v; };
  const auto back = [&](double u) { return linear_to > 0 ? linear_to * std::sinh(u) : u; };
  const double low = laid(min), high = diverging ? std::max(laid(max), -1e-9 * low) : laid(max);
  ColourScale scale{min, max, linear_to, {}, {}};
  const int last = linear_to > 0 ? 64 : 8;  // as many lines as follow a logarithm closely
  for (int k = 0; k <= last; ++k) {
    const double fraction = static_cast<double>(k) / last;
    const double below = low * (1 - 2 * fraction), beyond = high * (2 * fraction - 1);
    scale.values.push_back(back(!diverging ? low + fraction * (high - low) : fraction < 0.5 ? below : beyond));
    scale.colours.push_back(map_colour(map, fraction));
  }
  return scale;
}

std::vector<std::uint32_t> coloured(std::span<const double> values, const ColourScale& scale, std::uint32_t nothing) {
  constexpr int steps = 1024;
  std::vector<std::uint32_t> table;
  for (int k = 0; k <= steps; ++k) table.push_back(packed(scale.at(scale.value(static_cast<double>(k) / steps))));
  std::vector<std::uint32_t> rgb(values.size());
  parallel_for(0, rgb.size(), [&](std::size_t i) {
    const double place = scale.place(values[i]);
    rgb[i] =
        std::isnan(place) ? nothing : table[static_cast<std::size_t>(std::lround(steps * std::clamp(place, 0.0, 1.0)))];
  });
  return rgb;
}

Colour rank_colour(int rank) {
  constexpr std::uint32_t strong[] = {0xD55E00, 0x0072B2, 0x009E73, 0x7B1FA2, 0xE6A800};
  if (rank <= 0) return {0.80, 0.81, 0.83};
  if (rank <= 5) return unpacked(strong[rank - 1]);
  // Steps of the golden section round the circle of hues keep neighbours apart.
  const double hue = std::fmod(0.08 + 0.6180339887498949 * rank, 1.0) * 6;
  const double saturation = 0.20 + 0.25 / (1 + 0.05 * (rank - 6)), value = rank % 2 ? 0.84 : 0.70;
  const auto channel = [&](double shift) {
    const double h = std::fmod(hue + shift, 6.0);
    return value * (1 - saturation * std::clamp(std::min(h, 4 - h), 0.0, 1.0));
  };
  return {channel(5), channel(3), channel(1)};
}

Colour body_colour(int body) {
  constexpr std::uint32_t colours[] = {0xC9B08A, 0x4A78A8, 0x7FA667, 0xB9645A, 0x8D7BB0, 0xD9A441};
  return unpacked(colours[static_cast<std::size_t>(std::max(0, body)) % std::size(colours)]);
}

}  // namespace ejecta
