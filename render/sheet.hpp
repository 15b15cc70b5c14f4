#pragma once
/// The style that all pictures share: a band with title and time over panes at equal scale, each with its axes in
/// physical units or a scale bar, and a colour bar or a legend beside it. Nothing is written on matter.
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "render/canvas.hpp"
#include "render/colour_map.hpp"
#include "render/sampling.hpp"

namespace ejecta {

/// A rectangle of the picture plane [m].
struct Window {
  std::array<double, 2> low{0, 0}, high{1, 1};

  double width() const { return high[0] - low[0]; }
  double height() const { return high[1] - low[1]; }
};

/// What stands in the band over the panes.
struct Caption {
  std::string title, subtitle;
  double time = 0, time_end = 0;  ///< s; the end decides on the prefix
};

/// Where the panes of a picture are. They lie beside each other with their colour bars below, or above each other with
/// their colour bars to the right: whichever shows the window larger. Lengths follow from the font, and that from the
/// picture.
struct Layout {
  int width = 0, height = 0;  ///< pixels of the picture
  double font = 12;           ///< pixels
  bool keys_below = false;
  std::vector<PixelBox> panes;  ///< pixels, all of one size
  Window window;                ///< what each of them shows

  /// Each pane shows at least `wanted`, and more where there is room, but nothing beyond `limits`.
  /// `legend_width` in fonts: room for a legend, which stands to the right whatever it costs; 0: there is none.
  Layout(int width, int height, int panes, const Window& wanted, const Window& limits, double legend_width = 0);
  /// The largest window there is: no limits.
  static Window everywhere();

  double pixel() const { return window.width() / panes[0].width; }  ///< m
  /// The pixels of a pane, or if that is finer than `finest` [m] so many times fewer, but half as many at least: edges
  /// of matter would show the grid.
  PixelGrid grid(double finest = 0) const;
};

class Sheet {
 public:
  Sheet(Layout layout, const Caption& caption);

  /// What fills a pane; its size may be any.
  void put(int pane, const Raster& picture);
  /// Over a pane.
  void title(int pane, const std::string& words);
  /// Ticks along the lower and left edges, with the names of the axes.
  void axes(int pane, const std::array<std::string, 2>& names);
  /// Below a pane, for those without axes: a round length, and what the picture is seen along.
  void scale_bar(int pane, const std::string& words);
  /// Round values and both ends; `unit` is that of the values, which are shown with the prefix that suits them.
  void colour_bar(int pane, const ColourScale& scale, const std::string& unit);
  struct Entry {
    Colour colour;
    std::string words;
  };
  /// To the right of a pane.
  void legend(int pane, const std::string& heading, const std::vector<Entry>& entries);
  /// Throws OutputError if the file cannot be written.
  void save(const std::filesystem::path& file) const;

 private:
  const PixelBox& box(int pane) const { return layout_.panes.at(static_cast<std::size_t>(pane)); }

  Layout layout_;
  Canvas canvas_;
};

/// Of a field that is shown in a pane: "pressure [MPa]".
std::string heading_of(const std::string& label, const ColourScale& scale, const std::string& unit);

/// One field to paint. Values [SI] on the pixel grid, rows upwards; NaN stays empty.
struct Panel {
  std::string label, unit;
  std::span<const double> values;
  ColourScale scale;
};

/// A picture of sampled fields, a pane each. The grid covers the window of the layout.
void write_panels(const std::filesystem::path& file, const Layout& layout, const PixelGrid& grid,
                  std::span<const Panel> panels, const Caption& caption, const std::array<std::string, 2>& axes);

}  // namespace ejecta
