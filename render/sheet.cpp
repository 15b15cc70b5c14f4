#include "render/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/display_unit.hpp"

namespace ejecta {

namespace {

constexpr int coarsest = 2;  ///< pixels of a picture to one of a grid
constexpr Colour paper{1, 1, 1}, band_colour{0.93, 0.94, 0.955}, ink{0.13, 0.15, 0.18}, faint{0.42, 0.45, 0.50};
constexpr std::uint32_t empty = 0xFFFFFF;

// In fonts.
constexpr double band_height = 2.5, title_height = 2.0, axis_height = 3.1, axis_width = 4.6, bar_height = 3.4,
                 bar_width = 6, gap_beside = 1.8, gap_above = 0.5, edge = 1.2;

/// What may stand along a bar or an axis without touching its neighbours: the first ones come first.
class Taken {
 public:
  bool take(double from, double to) {
    for (const auto& [low, high] : taken_)
      if (from < high && to > low) return false;
    taken_.push_back({from, to});
    return true;
  }

 private:
  std::vector<std::array<double, 2>> taken_;
};

/// Both ends, then what is round, in the order in which it is worth a label.
std::vector<double> bar_values(const ColourScale& scale, double si) {
  std::vector<double> values{scale.max, scale.min};
  if (scale.min < 0 && scale.max > 0) values.push_back(0);
  if (scale.linear_to > 0) {
    const double largest = std::max(std::abs(scale.min), std::abs(scale.max));
    for (double power = std::floor(std::log10(largest)); std::pow(10, power) >= 0.5 * scale.linear_to; --power)
      for (const double sign : {1.0, -1.0}) values.push_back(sign * std::pow(10, power));
  } else {
    for (const double tick : round_ticks(scale.min / si, scale.max / si, 4)) values.push_back(tick * si);
  }
  std::erase_if(values, [&](double v) { return v < scale.min || v > scale.max; });
  return values;
}

}  // namespace

Window Layout::everywhere() {
  constexpr double far = std::numeric_limits<double>::infinity();
  return {{-far, -far}, {far, far}};
}

Layout::Layout(int w, int h, int count, const Window& wanted, const Window& limits, double legend_width)
    : width(w), height(h), font(std::clamp(h / 50.0, 8.0, 40.0)) {
  Window view;
  for (std::size_t a = 0; a < 2; ++a) {
    view.low[a] = std::max(wanted.low[a], limits.low[a]);
    view.high[a] = std::min(wanted.high[a], limits.high[a]);
    if (!(view.low[a] < view.high[a])) view.low[a] = wanted.low[a], view.high[a] = wanted.high[a];
  }
  const double left = axis_width * font, top = (band_height + title_height) * font, n = count;
  const double beside_width = (w - left - edge * font - (n - 1) * gap_beside * font) / n,
               beside_height = h - top - (axis_height + bar_height) * font;
  const double above_width = w - left - (edge + std::max(bar_width, legend_width)) * font,
               above_height =
                   (h - band_height * font - axis_height * font - (n - 1) * gap_above * font) / n - title_height * font;
  const double beside = std::min(beside_width / view.width(), beside_height / view.height()),
               above = std::min(above_width / view.width(), above_height / view.height());
  keys_below = legend_width == 0 && beside > above;
  const double scale = keys_below ? beside : above;  // pixels/m
  const double room[2] = {std::max(1.0, keys_below ? beside_width : above_width),
                          std::max(1.0, keys_below ? beside_height : above_height)};
  double size[2];
  for (std::size_t a = 0; a < 2; ++a) {
    const double middle = 0.5 * (view.low[a] + view.high[a]), half = 0.5 * room[a] / scale;
    const double low = std::max(limits.low[a], middle - half), high = std::min(limits.high[a], middle + half);
    size[a] = std::clamp(std::floor((high - low) * scale + 1e-6), 1.0, std::max(1.0, std::floor(room[a])));
    const double centre = 0.5 * (low + high);
    window.low[a] = centre - 0.5 * size[a] / scale;
    window.high[a] = centre + 0.5 * size[a] / scale;
  }
  for (int k = 0; k < count; ++k) {
    const double x = keys_below ? left + k * (beside_width + gap_beside * font) + 0.5 * (room[0] - size[0])
                                : left + 0.5 * (room[0] - size[0]);
    const double y = keys_below
                         ? top + 0.5 * (room[1] - size[1])
                         : top + k * (above_height + (title_height + gap_above) * font) + 0.5 * (room[1] - size[1]);
    panes.push_back({std::floor(x), std::floor(y), size[0], size[1]});
  }
}

PixelGrid Layout::grid(double finest) const {
  const int coarse = std::clamp(static_cast<int>(finest / pixel()), 1, coarsest);
  const int columns = std::max(1, static_cast<int>(panes[0].width) / coarse),
            rows = std::max(1, static_cast<int>(panes[0].height) / coarse);
  const double size = std::max(window.width() / columns, window.height() / rows);
  return {columns,
          rows,
          {0.5 * (window.low[0] + window.high[0]) - 0.5 * (columns - 1) * size,
           0.5 * (window.low[1] + window.high[1]) - 0.5 * (rows - 1) * size},
          size};
}

Sheet::Sheet(Layout layout, const Caption& caption)
    : layout_(std::move(layout)), canvas_(layout_.width, layout_.height, paper) {
  const double f = layout_.font, width = layout_.width, line = 1.65 * f;
  canvas_.fill({0, 0, width, band_height * f}, band_colour);
  const double after = edge * f + canvas_.text(edge * f, line, caption.title, 1.15 * f, ink, Align::left, true);
  const std::string time = "t = " + time_text(caption.time, caption.time_end);
  const double before =
      width - edge * f - canvas_.text(width - edge * f, line, time, 1.15 * f, ink, Align::right, true);
  canvas_.text_within({after + 1.5 * f, 0, before - after - 3 * f, band_height * f}, line, caption.subtitle, f, faint);
}

void Sheet::put(int pane, const Raster& picture) {
  canvas_.picture(box(pane), picture);
  canvas_.outline(box(pane), faint, 1);
}

void Sheet::title(int pane, const std::string& words) {
  const PixelBox& b = box(pane);
  canvas_.text(b.x + 0.5 * b.width, b.y - 0.55 * layout_.font, words, layout_.font, ink, Align::centre);
}

void Sheet::axes(int pane, const std::array<std::string, 2>& names) {
  const PixelBox& b = box(pane);
  const double f = layout_.font;
  const Window& w = layout_.window;
  const DisplayUnit unit = display_unit(std::max(w.width(), w.height()), "m");
  const bool lowest = layout_.keys_below || pane + 1 == static_cast<int>(layout_.panes.size());
  const bool leftmost = !layout_.keys_below || pane == 0;
  const auto ticks = [&](std::size_t a, double length) {
    return round_ticks(w.low[a] / unit.si, w.high[a] / unit.si, std::max(2, static_cast<int>(length / (5 * f))));
  };
  for (const double tick : ticks(0, b.width)) {
    const double x = b.x + b.width * (tick * unit.si - w.low[0]) / w.width(), y = b.y + b.height;
    canvas_.line(x, y, x, y + 0.3 * f, faint, 1);
    if (lowest) canvas_.text(x, y + 1.3 * f, short_number(tick), 0.85 * f, faint, Align::centre);
  }
  if (lowest)
    canvas_.text(b.x + 0.5 * b.width, b.y + b.height + 2.5 * f, names[0] + " [" + unit.label + "]", 0.9 * f, faint,
                 Align::centre);
  for (const double tick : ticks(1, b.height)) {
    const double y = b.y + b.height * (w.high[1] - tick * unit.si) / w.height();
    canvas_.line(b.x - 0.3 * f, y, b.x, y, faint, 1);
    if (leftmost) canvas_.text(b.x - 0.5 * f, y + 0.3 * f, short_number(tick), 0.85 * f, faint, Align::right);
  }
  if (leftmost)
    canvas_.text(b.x - 0.4 * f, b.y - 0.6 * f, names[1] + " [" + unit.label + "]", 0.9 * f, faint, Align::right);
}

void Sheet::scale_bar(int pane, const std::string& words) {
  const PixelBox& b = box(pane);
  const double f = layout_.font, longest = 0.25 * layout_.window.width();
  const double power = std::pow(10, std::floor(std::log10(longest)));
  double length = power;
  for (const double factor : {2.0, 5.0})
    if (factor * power <= longest) length = factor * power;
  const double x = b.x, y = b.y + b.height + 1.3 * f, end = x + length / layout_.pixel();
  canvas_.line(x, y, end, y, ink, std::max(1.0, 0.15 * f));
  for (const double at : {x, end}) canvas_.line(at, y - 0.35 * f, at, y + 0.35 * f, ink, std::max(1.0, 0.1 * f));
  const DisplayUnit unit = display_unit(length, "m");
  canvas_.text(end + 0.6 * f, y + 0.32 * f, short_number(length / unit.si) + " " + unit.label, 0.95 * f, ink);
  canvas_.text(b.x + b.width, y + 0.32 * f, words, 0.9 * f, faint, Align::right);
}

void Sheet::colour_bar(int pane, const ColourScale& scale, const std::string& unit_of_values) {
  const PixelBox& b = box(pane);
  const double f = layout_.font;
  const bool below = layout_.keys_below;
  const double inset = 0.04 * (below ? b.width : b.height);
  const PixelBox bar =
      below ? PixelBox{b.x + inset, b.y + b.height + (axis_height + 0.3) * f, b.width - 2 * inset, 0.8 * f}
            : PixelBox{b.x + b.width + 0.9 * f, b.y + inset, 0.8 * f, b.height - 2 * inset};
  constexpr int steps = 512;
  Raster colours = below ? Raster(steps, 1, 0) : Raster(1, steps, 0);
  for (int k = 0; k < steps; ++k)
    colours.rgb[static_cast<std::size_t>(below ? k : steps - 1 - k)] = packed(scale.at(scale.value((k + 0.5) / steps)));
  canvas_.picture(bar, colours);
  canvas_.outline(bar, faint, 1);
  const DisplayUnit unit = display_unit(std::max(std::abs(scale.min), std::abs(scale.max)), unit_of_values);
  Taken taken;
  for (const double value : bar_values(scale, unit.si)) {
    const std::string words = short_number(value / unit.si);
    const double place = scale.place(value);
    if (below) {
      const double x = bar.x + bar.width * place, y = bar.y + bar.height;
      const double half = 0.5 * canvas_.width_of(words, 0.85 * f) + 0.35 * f;
      if (!taken.take(x - half, x + half)) continue;
      canvas_.line(x, y, x, y + 0.3 * f, ink, 1);
      canvas_.text(x, y + 1.3 * f, words, 0.85 * f, ink, Align::centre);
    } else {
      const double x = bar.x + bar.width, y = bar.y + bar.height * (1 - place);
      if (!taken.take(y - 0.6 * f, y + 0.6 * f)) continue;
      canvas_.line(x, y, x + 0.3 * f, y, ink, 1);
      canvas_.text(x + 0.55 * f, y + 0.32 * f, words, 0.85 * f, ink);
    }
  }
}

void Sheet::legend(int pane, const std::string& heading, const std::vector<Entry>& entries) {
  const PixelBox& b = box(pane);
  const double f = layout_.font, x = b.x + b.width + 1.2 * f;
  double y = b.y + 1.5 * f;
  canvas_.text(x, y, heading, 0.95 * f, ink, Align::left, true);
  for (const Entry& entry : entries) {
    y += 1.75 * f;
    canvas_.fill({x, y - 0.8 * f, 0.9 * f, 0.9 * f}, entry.colour);
    canvas_.text(x + 1.5 * f, y, entry.words, 0.95 * f, ink);
  }
}

void Sheet::save(const std::filesystem::path& file) const { write_png(file, canvas_.raster()); }

std::string heading_of(const std::string& label, const ColourScale& scale, const std::string& unit) {
  const std::string shown = display_unit(std::max(std::abs(scale.min), std::abs(scale.max)), unit).label;
  return shown.empty() ? label : label + " [" + shown + "]";
}

void write_panels(const std::filesystem::path& file, const Layout& layout, const PixelGrid& grid,
                  std::span<const Panel> panels, const Caption& caption, const std::array<std::string, 2>& axes) {
  Sheet sheet(layout, caption);
  const std::size_t width = static_cast<std::size_t>(grid.width), height = static_cast<std::size_t>(grid.height);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const Panel& panel = panels[k];
    const std::vector<std::uint32_t> rgb = coloured(panel.values, panel.scale, empty);
    Raster picture(grid.width, grid.height, empty);
    for (std::size_t row = 0; row < height; ++row)  // pictures run downwards
      std::copy_n(rgb.begin() + static_cast<std::ptrdiff_t>((height - 1 - row) * width), width,
                  picture.rgb.begin() + static_cast<std::ptrdiff_t>(row * width));
    const int pane = static_cast<int>(k);
    sheet.put(pane, picture);
    sheet.title(pane, heading_of(panel.label, panel.scale, panel.unit));
    sheet.axes(pane, axes);
    sheet.colour_bar(pane, panel.scale, panel.unit);
  }
  sheet.save(file);
}

}  // namespace ejecta
