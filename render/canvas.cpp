#include "render/canvas.hpp"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"

namespace ejecta {

void Canvas::Deleter::operator()(_cairo* context) const { cairo_destroy(context); }
void Canvas::Deleter::operator()(_cairo_surface* surface) const { cairo_surface_destroy(surface); }

Canvas::Canvas(int width, int height, Colour background)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)), context_(cairo_create(surface_.get())) {
  fill({0, 0, static_cast<double>(width), static_cast<double>(height)}, background);
}

void Canvas::fill(PixelBox box, Colour colour) {
  cairo_set_source_rgb(context_.get(), colour.red, colour.green, colour.blue);
  cairo_rectangle(context_.get(), box.x, box.y, box.width, box.height);
  cairo_fill(context_.get());
}

void Canvas::outline(PixelBox box, Colour colour, double line_width) {
  cairo_set_source_rgb(context_.get(), colour.red, colour.green, colour.blue);
  cairo_set_line_width(context_.get(), line_width);
  cairo_rectangle(context_.get(), box.x, box.y, box.width, box.height);
  cairo_stroke(context_.get());
}

void Canvas::line(double x0, double y0, double x1, double y1, Colour colour, double line_width) {
  cairo_set_source_rgb(context_.get(), colour.red, colour.green, colour.blue);
  cairo_set_line_width(context_.get(), line_width);
  cairo_move_to(context_.get(), x0, y0);
  cairo_line_to(context_.get(), x1, y1);
  cairo_stroke(context_.get());
}

double Canvas::text(double x, double y, const std::string& words, double size, Colour colour, Align align, bool bold) {
  cairo_select_font_face(context_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_.get(), size);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), words.c_str(), &extents);
  const double shift = align == Align::left ? 0 : align == Align::centre ? 0.5 * extents.x_advance : extents.x_advance;
  cairo_set_source_rgb(context_.get(), colour.red, colour.green, colour.blue);
  cairo_move_to(context_.get(), x - shift, y);
  cairo_show_text(context_.get(), words.c_str());
  return extents.x_advance;
}

double Canvas::width_of(const std::string& words, double size) const {
  cairo_select_font_face(context_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_.get(), size);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), words.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text_within(PixelBox box, double y, std::string words, double size, Colour colour) {
  if (width_of(words, size) > box.width) {
    const auto cut = [&] {  // whole characters of UTF-8
      while (!words.empty() && (words.back() & 0xC0) == 0x80) words.pop_back();
      if (!words.empty()) words.pop_back();
    };
    while (!words.empty() && width_of(words + "...", size) > box.width) cut();
    if (words.empty()) return;
    words += "...";
  }
  text(box.x, y, words, size, colour);
}

void Canvas::picture(PixelBox box, const Raster& picture) {
  const std::unique_ptr<_cairo_surface, Deleter> source(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, picture.width, picture.height));
  cairo_surface_flush(source.get());
  unsigned char* rows = cairo_image_surface_get_data(source.get());
  const std::size_t stride = static_cast<std::size_t>(cairo_image_surface_get_stride(source.get()));
  const std::size_t row_length = static_cast<std::size_t>(picture.width);
  for (std::size_t j = 0; j < static_cast<std::size_t>(picture.height); ++j)
    std::copy_n(picture.rgb.data() + j * row_length, row_length, reinterpret_cast<std::uint32_t*>(rows + j * stride));
  cairo_surface_mark_dirty(source.get());
  cairo_save(context_.get());
  cairo_rectangle(context_.get(), box.x, box.y, box.width, box.height);
  cairo_clip(context_.get());
  cairo_translate(context_.get(), box.x, box.y);
  cairo_scale(context_.get(), box.width / picture.width, box.height / picture.height);
  cairo_set_source_surface(context_.get(), source.get(), 0, 0);
  const bool alike = box.width == picture.width && box.height == picture.height;
  cairo_pattern_set_filter(cairo_get_source(context_.get()), alike ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_BILINEAR);
  cairo_pattern_set_extend(cairo_get_source(context_.get()), CAIRO_EXTEND_PAD);
  cairo_paint(context_.get());
  cairo_restore(context_.get());
}

Raster Canvas::raster() const {
  cairo_surface_flush(surface_.get());
  Raster copy(cairo_image_surface_get_width(surface_.get()), cairo_image_surface_get_height(surface_.get()), 0);
  const unsigned char* rows = cairo_image_surface_get_data(surface_.get());
  const std::size_t stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface_.get()));
  const std::size_t row_length = static_cast<std::size_t>(copy.width);
  for (std::size_t j = 0; j < static_cast<std::size_t>(copy.height); ++j)
    std::copy_n(reinterpret_cast<const std::uint32_t*>(rows + j * stride), row_length,
                copy.rgb.data() + j * row_length);
  for (std::uint32_t& pixel : copy.rgb) pixel &= 0xFFFFFFu;
  return copy;
}

}  // namespace ejecta
