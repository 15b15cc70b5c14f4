#include "render/colour_map.hpp"

#include <algorithm>
#include <cmath>

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

Colour unpack(std::uint32_t rgb) {
  return {static_cast<double>(rgb >> 16 & 255u) / 255, static_cast<double>(rgb >> 8 & 255u) / 255,
          static_cast<double>(rgb & 255u) / 255};
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
  return mixed(unpack(points[k]), unpack(points[k + 1]), t);
}

Colour ColourScale::at(double value) const {
  const auto above = std::upper_bound(values.begin() + 1, values.end() - 1, value) - values.begin();
  const auto k = static_cast<std::size_t>(above);
  const double t = std::clamp((value - values[k - 1]) / (values[k] - values[k - 1]), 0.0, 1.0);
  return mixed(colours[k - 1], colours[k], t);
}

ColourScale colour_scale(ColourMap map, double min, double max) {
  const bool diverging = map == ColourMap::cool_warm && min < 0;
  if (map == ColourMap::cool_warm && !diverging) map = ColourMap::inferno;
  ColourScale scale;
  const ControlPoints& points = control_points(map);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double fraction = static_cast<double>(k) / (points.size() - 1);
    const double below = min * (1 - 2 * fraction), beyond = std::max(max, -1e-9 * min) * (2 * fraction - 1);
    scale.values.push_back(!diverging ? min + fraction * (max - min) : fraction < 0.5 ? below : beyond);
    scale.colours.push_back(unpack(points[k]));
  }
  return scale;
}

Colour fragment_colour(std::int32_t number) {
  if (number <= 0) return {0.93, 0.93, 0.93};
  if (number == 1) return {0.55, 0.55, 0.55};
  // Steps of the golden ratio around the hue circle keep neighbouring numbers apart.
  const double hue = std::fmod(0.08 + 0.6180339887498949 * number, 1.0) * 6;
  const double value = number % 2 ? 0.9 : 0.7;
  const auto channel = [&](double shift) {
    const double h = std::fmod(hue + shift, 6.0);
    return value * (1 - 0.65 * std::clamp(std::min(h, 4 - h), 0.0, 1.0));
  };
  return {channel(5), channel(3), channel(1)};
}

}  // namespace ejecta
