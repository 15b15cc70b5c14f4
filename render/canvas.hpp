#pragma once
/// A drawing surface of RGB pixels; coordinates in pixels from the upper left corner.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "render/colour_map.hpp"

struct _cairo;
struct _cairo_surface;

namespace ejecta {

struct Box {
  double x, y, width, height;
};

enum class Align { left, centre, right };

class Canvas {
 public:
  Canvas(int width, int height, Colour background);

  void fill(Box box, Colour colour);
  void outline(Box box, Colour colour, double line_width);
  void line(double x0, double y0, double x1, double y1, Colour colour, double line_width);
  /// `y` is the base line of the text. Returns its width.
  double text(double x, double y, const std::string& words, double size, Colour colour, Align align = Align::left,
              bool bold = false);
  /// Stretches width * height colours (0xRRGGBB, top row first) over the box.
  void picture(Box box, std::span<const std::uint32_t> rgb, int width, int height);
  /// Throws OutputError if the file cannot be written.
  void save_png(const std::filesystem::path& file) const;

 private:
  struct Deleter {
    void operator()(_cairo* context) const;
    void operator()(_cairo_surface* surface) const;
  };
  std::unique_ptr<_cairo_surface, Deleter> surface_;
  std::unique_ptr<_cairo, Deleter> context_;
};

}  // namespace ejecta
