#pragma once
/// Pictures of sampled fields without any graphics hardware: panels side by side at equal scale, each with its colour
/// bar, unit and title, under one caption and time stamp.
#include <array>
#include <filesystem>
#include <span>
#include <string>

#include "render/colour_map.hpp"
#include "render/sampling.hpp"

namespace ejecta {

/// One field to paint. Values [SI] on the pixel grid, rows upwards; NaN stays background.
struct Panel {
  std::string title, unit;
  std::span<const double> values;
  double min = 0, max = 1;  ///< ends of the colour bar, SI; fixed by the caller so that frames do not flicker
  ColourMap map = ColourMap::viridis;
  bool logarithmic = false;  ///< needs min > 0
};

/// What is common to the frames of a movie.
struct FrameText {
  std::string caption;
  double time = 0, time_end = 0;  ///< s; the end decides on the prefix
  std::array<std::string, 2> axes{"x", "z"};
};

/// Pixels one of `panels` panels gets in a picture of the given size: sample with such a grid for a sharp picture.
std::array<int, 2> panel_pixels(int width, int height, int panels);

/// Paints the panels into a PNG of width x height pixels. Throws OutputError if it cannot be written.
void write_panels(const std::filesystem::path& file, int width, int height, const PixelGrid& grid,
                  std::span<const Panel> panels, const FrameText& text);

}  // namespace ejecta
