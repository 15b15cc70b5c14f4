#pragma once
/// Ejecta's own pictures: slices where there is no OpenGL, and column densities.
#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "observe/view.hpp"
#include "render/field_style.hpp"
#include "render/sheet.hpp"
#include "sph/sph.hpp"

namespace ejecta {

class Painter {
 public:
  /// Pictures go to the folder `images`; `layout` is that of the slice.
  Painter(const Scene& scene, std::map<std::string, FieldStyle> styles, Layout layout, std::filesystem::path images);

  /// slice_<step>.png: a panel for each field of the slice, of vectors their magnitude.
  void paint_slice(const SampledImage& slice, const Clock& clock);
  /// column_<step>.png. Its range is that of the first one painted: what lies undisturbed in the line of sight.
  void paint_column_density(const SampledImage& column, const Layout& layout, const Clock& clock);

 private:
  void paint(const char* name, const Layout& layout, const PixelGrid& grid, std::span<const Panel> panels,
             const std::string& subtitle, const Clock& clock) const;

  std::map<std::string, FieldStyle> styles_;
  Layout layout_;
  std::filesystem::path images_;
  Caption caption_;  ///< time and subtitle are filled in
  std::array<std::string, 2> axes_;
  double column_density_max_ = 0;  ///< kg/m^2
};

}  // namespace ejecta
