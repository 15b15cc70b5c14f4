#include "render/raster.hpp"

#include <png.h>

#include <cerrno>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <memory>

#include "base/errors.hpp"

namespace ejecta {

std::uint32_t packed(Colour c) {
  const auto byte = [](double part) { return static_cast<std::uint32_t>(std::lround(255 * part)); };
  return byte(c.red) << 16 | byte(c.green) << 8 | byte(c.blue);
}

Colour unpacked(std::uint32_t rgb) {
  const auto part = [&](int shift) { return static_cast<double>(rgb >> shift & 255u) / 255; };
  return {part(16), part(8), part(0)};
}

namespace {

/// libpng leaves by longjmp: nothing with a destructor may live in here.
bool write_rows(std::FILE* file, const Raster& raster, png_structp png, png_infop info, png_bytep row) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_init_io(png, file);
  png_set_IHDR(png, info, static_cast<png_uint_32>(raster.width), static_cast<png_uint_32>(raster.height), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(png, 1);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
  png_write_info(png, info);
  for (int j = 0; j < raster.height; ++j) {
    const std::uint32_t* rgb = raster.rgb.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(raster.width);
    for (int i = 0; i < raster.width; ++i)
      for (int part = 0; part < 3; ++part) row[3 * i + part] = static_cast<png_byte>(rgb[i] >> (16 - 8 * part) & 255u);
    png_write_row(png, row);
  }
  png_write_end(png, info);
  return std::fflush(file) == 0;
}

}  // namespace

void write_png(const std::filesystem::path& path, const Raster& raster) {
  errno = 0;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"), std::fclose);
  if (!file) throw OutputError(path);
  std::vector<png_byte> row(3 * static_cast<std::size_t>(raster.width));
  const auto silent = [](png_structp, png_const_charp) {};
  const auto leave = [](png_structp png, png_const_charp) { png_longjmp(png, 1); };
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, leave, silent);
  png_infop info = png_create_info_struct(png);
  const bool written = write_rows(file.get(), raster, png, info, row.data());
  png_destroy_write_struct(&png, &info);
  if (!written) throw OutputError(path);
}

}  // namespace ejecta
