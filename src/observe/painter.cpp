#include "observe/painter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ejecta {

namespace {

/// What an image holds, where nothing else is known of its range.
ColourRange range_of(std::span<const double> values) {
  ColourRange range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (const double value : values)
    if (std::isfinite(value)) range = {std::min(range.min, value), std::max(range.max, value)};
  if (range.min < range.max) return range;
  return range.min == range.max ? ColourRange{range.min, range.min + std::max(std::abs(range.min), 1.0)}
                                : ColourRange{0, 1};
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

Painter::Painter(const Scene& scene, std::map<std::string, FieldStyle> styles, std::filesystem::path images)
    : styles_(std::move(styles)),
      images_(std::move(images)),
      width_(scene.insitu.image_width),
      height_(scene.insitu.image_height),
      text_{heading(scene), 0, scene.time_end, {"x", scene.dimension == 3 ? "z" : "y"}} {}

void Painter::paint(const char* name, const PixelGrid& grid, std::span<const Panel> panels, const Clock& clock) const {
  FrameText text = text_;
  text.time = clock.time;
  write_panels(images_ / fmt::format("{}_{:06d}.png", name, clock.step), width_, height_, grid, panels, text);
}

void Painter::paint_slice(const SampledImage& slice, const Clock& clock) {
  std::vector<Panel> panels;
  std::vector<std::vector<double>> values;
  values.reserve(slice.fields.size());  // the panels point into it
  for (const SampledImage::Field& field : slice.fields) {
    if (field.name == "filling") continue;
    const std::vector<double>& shown = values.emplace_back(magnitude(field.components));
    FieldStyle& style = styles_.try_emplace(field.name, plain_style(field.name)).first->second;
    if (!style.range) style.range = range_of(shown);  // that of the first frame, kept from then on
    panels.push_back({style.label, field.unit, shown, style.range->min, style.range->max, style.map});
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
