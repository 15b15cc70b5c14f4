#include "observe/field_styles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ejecta {

namespace {

struct Row {
  const char *field, *label;
  ColourMap map;
  ColourRange (*range)(const Extremes&);  ///< null: what the first frame holds
};

using enum ColourMap;
constexpr auto unit_range = [](const Extremes&) -> ColourRange { return {0, 1}; };

const Row table[] = {
    {"pressure", "pressure", cool_warm,
     [](const Extremes& e) -> ColourRange {
       return {std::min(0.0, -0.05 * e.pressure), e.pressure};
     }},
    {"pressure_peak", "highest pressure", viridis,
     [](const Extremes& e) -> ColourRange {
       return {0, e.pressure};
     }},
    {"density", "density", viridis,
     [](const Extremes& e) -> ColourRange {
       return {0, e.density};
     }},
    {"velocity", "velocity", viridis,
     [](const Extremes& e) -> ColourRange {
       return {0, e.speed};
     }},
    {"specific_energy", "specific energy", inferno, nullptr},
    {"distension", "distension", viridis,
     [](const Extremes& e) -> ColourRange {
       return {1, e.distension};
     }},
    {"aspect", "aspect", viridis,
     [](const Extremes& e) -> ColourRange {
       return {1, e.aspect};
     }},
    {"mach", "Mach number", viridis,
     [](const Extremes& e) -> ColourRange {
       return {0, e.mach};
     }},
    {"damage", "damage", plasma, unit_range},
    {"damage_1", "largest damage", plasma, unit_range},
    {"damage_2", "damage 2", plasma, unit_range},
    {"damage_3", "damage 3", plasma, unit_range},
};

}  // namespace

Extremes extremes(const Scene& scene, const std::vector<Material>& materials, const Outset& outset) {
  double distension = 1.01;
  for (const Material& m : materials)
    if (m.porosity) distension = std::max(distension, m.porosity->initial_distension());
  const double speed = outset.speed > 0 ? outset.speed : std::sqrt(outset.pressure / outset.density);
  return {outset.pressure, outset.density, speed, distension, std::clamp(scene.numerics.largest_aspect, 1.5, 4.0)};
}

std::map<std::string, FieldStyle> field_styles(const Scene& scene, const Extremes& expected) {
  std::map<std::string, FieldStyle> styles;
  for (const Row& row : table) {
    FieldStyle& style = styles.try_emplace(row.field, FieldStyle{row.label, row.map, {}}).first->second;
    if (!row.range) continue;
    const ColourRange range = row.range(expected);
    if (range.max > range.min) style.range = range;  // a scene at rest leaves nothing to tell a range from
  }
  for (const auto& [name, range] : scene.insitu.ranges) {
    const auto style = styles.try_emplace(name, plain_style(name)).first;
    style->second.range = range;
  }
  return styles;
}

}  // namespace ejecta
