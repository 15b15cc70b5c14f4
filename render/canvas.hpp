#pragma once
/// A drawing surface of RGB pixels; coordinates in pixels from the upper left corner.
#include <memory>
#include <string>

#include "render/raster.hpp"

struct _cairo;
struct _cairo_surface;

namespace ejecta {

struct PixelBox {
  double x, y, width, height;
};

enum class Align { left, centre, right };

class Canvas {
 public:
  Canvas(int width, int height, Colour background);

  void fill(PixelBox box, Colour colour);
  void outline(PixelBox box, Colour colour, double line_width);
  void line(double x0, double y0, double x1, double y1, Colour colour, double line_width);
  /// `y` is the base line of the text. Returns its width.
  double text(double x, double y, const std::string& words, double size, Colour colour, Align align = Align::left,
              bool bold = false);
  double width_of(const std::string& words, double size) const;
  /// Words that begin at the left of the box and end, cut short with dots, within it.
  void text_within(PixelBox box, double y, std::string words, double size, Colour colour);
  /// Stretches a picture over the box.
  void picture(PixelBox box, const Raster& picture);
  Raster raster() const;

 private:
  struct Deleter {
    void operator()(_cairo* context) const;
    void operator()(_cairo_surface* surface) const;
  };
  std::unique_ptr<_cairo_surface, Deleter> surface_;
  std::unique_ptr<_cairo, Deleter> context_;
};

}  // namespace ejecta
