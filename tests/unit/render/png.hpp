#pragma once
/// Reads PNG files back for the tests of pictures.
#include <cairo.h>

#include <cstdint>
#include <filesystem>
#include <set>
#include <vector>

namespace ejecta {

struct Png {
  int width = 0, height = 0;
  std::vector<std::uint32_t> rgb;  ///< top row first
  std::size_t colours() const { return std::set<std::uint32_t>(rgb.begin(), rgb.end()).size(); }
};

inline Png read_png(const std::filesystem::path& file) {
  cairo_surface_t* surface = cairo_image_surface_create_from_png(file.c_str());
  Png png{cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
  const unsigned char* rows = cairo_image_surface_get_data(surface);
  for (int j = 0; j < png.height; ++j)
    for (int i = 0; i < png.width; ++i)
      png.rgb.push_back(reinterpret_cast<const std::uint32_t*>(rows + j * cairo_image_surface_get_stride(surface))[i] &
                        0xFFFFFFu);
  cairo_surface_destroy(surface);
  return png;
}

}  // namespace ejecta
