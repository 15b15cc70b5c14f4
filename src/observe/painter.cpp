#include "observe/painter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ejecta {

namespace {

ColourMap map_of(std::string_view field) {
  if (field == "pressure") return ColourMap::cool_warm;
  if (field == "damage") return ColourMap::inferno;
  return ColourMap::viridis;
}

std::vector<double> magnitude(const std::vector<std::vector<double>>& components) {
  if (components.size() == 1) return components[0];
  std::vector<double> values(components[0].size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    double sum = 0;
    for (const auto& component : components) sum += component[i] * component[i];
    values[i] = std::sqrt(sum);
  }
  return values;
}

}  // namespace

Painter::Painter(const Scene& scene, std::filesystem::path images)
    : images_(std::move(images)),
      width_(scene.insitu.image_width),
      height_(scene.insitu.image_height),
      text_{heading(scene), 0, scene.time_end, {"x", scene.dimension == 3 ? "z" : "y"}} {}

void Painter::paint(const char* name, const PixelGrid& grid, std::span<const Panel> panels, const Clock& clock) const {
  FrameText text = text_;
  text.time = clock.time;
  write_panels(images_ / fmt::format("{}_{:06d}.png", name, clock.step), width_, height_, grid, panels, text);
}

void Painter::paint_slice(const SampledImage& slice, const std::map<std::string, ColourRange>& ranges,
                          const Clock& clock) const {
  std::vector<Panel> panels;
  std::vector<std::vector<double>> values;
  values.reserve(slice.fields.size());  // the panels point into it
  for (const SampledImage::Field& field : slice.fields) {
    if (field.name == "filling") continue;
    const ColourRange range = ranges.at(field.name);
    panels.push_back({field.name, field.unit, values.emplace_back(magnitude(field.components)), range.min, range.max,
                      map_of(field.name)});
  }
  paint("slice", slice.grid, panels, clock);
}

void Painter::paint_column_density(const SampledImage& column, const Clock& clock) {
  const SampledImage::Field& field = column.field("column_density");
  if (column_density_max_ == 0)
    for (double value : field.components[0]) column_density_max_ = std::max(column_density_max_, value);
  const Panel panel{"column density", field.unit, field.components[0], 0, column_density_max_, ColourMap::viridis};
  paint("column", column.grid, {&panel, 1}, clock);
}

}  // namespace ejecta
