#pragma once
/// Pixels, and how they become a file.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "render/colour_map.hpp"

namespace ejecta {

/// 0xRRGGBB, top row first.
struct Raster {
  int width = 0, height = 0;
  std::vector<std::uint32_t> rgb;

  Raster() = default;
  Raster(int w, int h, std::uint32_t colour)
      : width(w), height(h), rgb(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), colour) {}
};

std::uint32_t packed(Colour colour);
Colour unpacked(std::uint32_t rgb);

/// Fast rather than small: a frame is written hundreds of times a run. Throws OutputError if it cannot be written.
void write_png(const std::filesystem::path& file, const Raster& raster);

}  // namespace ejecta
