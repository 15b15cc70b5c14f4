#include "observe/painter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace ejecta {

namespace {

/// What an image holds, where nothing else is known of its range; nothing if all of it is alike.
std::optional<ColourRange> range_of(std::span<const double> values) {
  ColourRange range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (const double value : values)
    if (std::isfinite(value)) range = {std::min(range.min, value), std::max(range.max, value)};
  return range.min < range.max ? std::optional(range) : std::nullopt;
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

Painter::Painter(const Scene& scene, std::map<std::string, FieldStyle> styles, Layout layout,
                 std::filesystem::path images)
    : styles_(std::move(styles)),
      layout_(std::move(layout)),
      images_(std::move(images)),
      caption_{heading(scene), "", 0, scene.time_end},
      axes_{"x", scene.dimension == 3 ? "z" : "y"} {}

void Painter::paint(const char* name, const Layout& layout, const PixelGrid& grid, std::span<const Panel> panels,
                    const std::string& subtitle, const Clock& clock) const {
  Caption caption = caption_;
  caption.time = clock.time;
  caption.subtitle = subtitle;
  write_panels(images_ / fmt::format("{}_{:06d}.png", name, clock.step), layout, grid, panels, caption, axes_);
}

void Painter::paint_slice(const SampledImage& slice, const Clock& clock) {
  std::vector<Panel> panels;
  std::vector<std::vector<double>> values;
  values.reserve(slice.fields.size());  // the panels point into it
  for (const SampledImage::Field& field : slice.fields) {
    if (field.name == "filling") continue;
    const std::vector<double>& shown = values.emplace_back(magnitude(field.components));
    FieldStyle& style = styles_.try_emplace(field.name, plain_style(field.name)).first->second;
    if (!style.range) style.range = range_of(shown);  // that of the first frame that has one, kept from then on
    panels.push_back({style.label, field.unit, shown, style.scale(style.range.value_or(ColourRange{0, 1}))});
  }
  paint("slice", layout_, slice.grid, panels, "slice through the middle", clock);
}

void Painter::paint_column_density(const SampledImage& column, const Layout& layout, const Clock& clock) {
  const SampledImage::Field& field = column.field("column_density");
  if (column_density_max_ == 0)
    for (double value : field.components[0]) column_density_max_ = std::max(column_density_max_, value);
  const Panel panel{"column density", field.unit, field.components[0],
                    colour_scale(ColourMap::viridis, 0, column_density_max_)};
  paint("column", layout, column.grid, {&panel, 1}, "mass seen along y", clock);
}

}  // namespace ejecta
