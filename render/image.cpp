#include "render/image.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.hpp"
#include "render/canvas.hpp"
#include "render/display_unit.hpp"

namespace ejecta {

namespace {

constexpr Colour paper{1, 1, 1}, empty{0.955, 0.96, 0.97}, ink{0.13, 0.15, 0.18}, faint{0.45, 0.48, 0.52};

/// All lengths follow from the font size, which follows from the picture.
struct Layout {
  double font, left, right, top, bottom, gap, panel_width, panel_height;
};

Layout layout_for(int width, int height, int panels) {
  Layout l;
  l.font = std::clamp(height / 48.0, 9.0, 24.0);
  l.left = 4.2 * l.font;
  l.right = 1.6 * l.font;
  l.top = 4.6 * l.font;     // caption, titles
  l.bottom = 6.6 * l.font;  // axis labels, colour bar and its labels
  l.gap = 2.2 * l.font;
  l.panel_width = std::max(1.0, (width - l.left - l.right - (panels - 1) * l.gap) / panels);
  l.panel_height = std::max(1.0, height - l.top - l.bottom);
  return l;
}

/// Place of a value on the colour bar, 0 to 1.
double fraction(const Panel& panel, double value) {
  if (panel.logarithmic) return std::log(value / panel.min) / std::log(panel.max / panel.min);
  return (value - panel.min) / (panel.max - panel.min);
}

std::uint32_t packed(Colour c) {
  const auto byte = [](double part) { return static_cast<std::uint32_t>(std::lround(255 * part)); };
  return byte(c.red) << 16 | byte(c.green) << 8 | byte(c.blue);
}

/// The colours of a panel's values.
class PanelColours {
 public:
  explicit PanelColours(const Panel& panel)
      : panel_(panel), min_(panel.logarithmic ? 0 : panel.min), max_(panel.logarithmic ? 1 : panel.max) {}

  std::uint32_t of(double value) const {
    const double place = panel_.logarithmic ? fraction(panel_, value) : value;
    return packed(std::isnan(place) ? empty : scale_.at(place));
  }
  /// Colour at a fraction of the colour bar.
  std::uint32_t on_bar(double part) const { return packed(scale_.at(min_ + part * (max_ - min_))); }

 private:
  const Panel& panel_;
  double min_, max_;
  ColourScale scale_ = colour_scale(panel_.map, min_, max_);
};

std::vector<std::uint32_t> coloured(const Panel& panel, const PixelGrid& grid) {
  const PanelColours colours(panel);
  const std::size_t width = static_cast<std::size_t>(grid.width), height = static_cast<std::size_t>(grid.height);
  std::vector<std::uint32_t> rgb(width * height);
  parallel_for(0, rgb.size(), [&](std::size_t p) {
    const std::size_t row = height - 1 - p / width;  // pictures run downwards
    rgb[p] = colours.of(panel.values[row * width + p % width]);
  });
  return rgb;
}

std::vector<double> bar_ticks(const Panel& panel, double si) {
  if (!panel.logarithmic) {
    std::vector<double> ticks = round_ticks(panel.min / si, panel.max / si, 4);
    for (double& t : ticks) t *= si;
    return ticks;
  }
  std::vector<double> ticks;
  const double first = std::ceil(std::log10(panel.min) - 1e-9), last = std::floor(std::log10(panel.max) + 1e-9);
  const double step = std::max(1.0, std::ceil((last - first) / 4));
  for (double power = first; power <= last; power += step) ticks.push_back(std::pow(10, power));
  return ticks;
}

void draw_colour_bar(Canvas& canvas, const Panel& panel, Box box, double font) {
  constexpr int steps = 256;
  const PanelColours colours(panel);
  std::vector<std::uint32_t> rgb(steps);
  for (int k = 0; k < steps; ++k) rgb[static_cast<std::size_t>(k)] = colours.on_bar(k / 255.0);
  canvas.picture(box, rgb, steps, 1);
  canvas.outline(box, faint, 1);
  const DisplayUnit unit = display_unit(std::max(std::abs(panel.min), std::abs(panel.max)), panel.unit);
  for (const double value : bar_ticks(panel, unit.si)) {
    const double x = box.x + box.width * fraction(panel, value);
    canvas.line(x, box.y + box.height, x, box.y + box.height + 0.3 * font, ink, 1);
    canvas.text(x, box.y + box.height + 1.35 * font, short_number(value / unit.si), 0.9 * font, ink, Align::centre);
  }
}

/// Axis ticks along the bottom, and up the left side where `vertical`; outer edges of the pixels bound the box.
void draw_axes(Canvas& canvas, const PixelGrid& grid, Box box, const FrameText& text, double font, bool vertical) {
  const double x0 = grid.first[0] - 0.5 * grid.pixel, y0 = grid.first[1] - 0.5 * grid.pixel;
  const double width = grid.width * grid.pixel, height = grid.height * grid.pixel;
  const DisplayUnit unit = display_unit(0.2 * std::max(width, height), "m");
  for (const double tick :
       round_ticks(x0 / unit.si, (x0 + width) / unit.si, std::max(2, int(box.width / (6 * font))))) {
    const double x = box.x + box.width * (tick * unit.si - x0) / width;
    canvas.line(x, box.y + box.height, x, box.y + box.height + 0.3 * font, ink, 1);
    canvas.text(x, box.y + box.height + 1.35 * font, short_number(tick), 0.85 * font, faint, Align::centre);
  }
  canvas.text(box.x + 0.5 * box.width, box.y + box.height + 2.5 * font, text.axes[0] + " [" + unit.label + "]",
              0.9 * font, faint, Align::centre);
  if (!vertical) return;
  for (const double tick :
       round_ticks(y0 / unit.si, (y0 + height) / unit.si, std::max(2, int(box.height / (5 * font))))) {
    const double y = box.y + box.height * (1 - (tick * unit.si - y0) / height);
    canvas.line(box.x - 0.3 * font, y, box.x, y, ink, 1);
    canvas.text(box.x - 0.5 * font, y + 0.3 * font, short_number(tick), 0.85 * font, faint, Align::right);
  }
  canvas.text(box.x - 0.4 * font, box.y - 0.5 * font, text.axes[1] + " [" + unit.label + "]", 0.9 * font, faint,
              Align::right);
}

void draw_panel(Canvas& canvas, const Panel& panel, const PixelGrid& grid, Box box, const FrameText& text, double font,
                bool first) {
  canvas.picture(box, coloured(panel, grid), grid.width, grid.height);
  canvas.outline(box, faint, 1);
  const std::string unit = display_unit(std::max(std::abs(panel.min), std::abs(panel.max)), panel.unit).label;
  canvas.text(box.x + 0.5 * box.width, box.y - 0.6 * font, unit.empty() ? panel.title : panel.title + " [" + unit + "]",
              1.1 * font, ink, Align::centre);
  draw_axes(canvas, grid, box, text, font, first);
  draw_colour_bar(canvas, panel, {box.x, box.y + box.height + 3.6 * font, box.width, 0.9 * font}, font);
}

}  // namespace

std::array<int, 2> panel_pixels(int width, int height, int panels) {
  const Layout l = layout_for(width, height, panels);
  return {static_cast<int>(l.panel_width), static_cast<int>(l.panel_height)};
}

void write_panels(const std::filesystem::path& file, int width, int height, const PixelGrid& grid,
                  std::span<const Panel> panels, const FrameText& text) {
  const Layout l = layout_for(width, height, static_cast<int>(panels.size()));
  Canvas canvas(width, height, paper);
  canvas.text(0.8 * l.font, 1.9 * l.font, text.caption, 1.25 * l.font, ink, Align::left, true);
  canvas.text(width - l.right, 1.9 * l.font, "t = " + time_text(text.time, text.time_end), 1.25 * l.font, ink,
              Align::right);
  const double scale = std::min(l.panel_width / grid.width, l.panel_height / grid.height);
  const double w = std::floor(scale * grid.width), h = std::floor(scale * grid.height);
  const double y = std::floor(l.top + 0.5 * (l.panel_height - h));
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const double x = std::floor(l.left + static_cast<double>(k) * (l.panel_width + l.gap) + 0.5 * (l.panel_width - w));
    draw_panel(canvas, panels[k], grid, {x, y, w, h}, text, l.font, k == 0);
  }
  canvas.save_png(file);
}

}  // namespace ejecta
