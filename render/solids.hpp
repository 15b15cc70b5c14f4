#pragma once
/// Spheres and surfaces, shaded, seen along parallel lines: anti-aliased, with ambient occlusion and shadows. All on
/// the processor's threads; the same picture bit for bit for any number of them.
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "render/raster.hpp"

namespace ejecta {

/// A parallel projection.
struct Camera {
  Vec<3> centre = Vec<3>::Zero();                        ///< in the middle of the picture [m]
  Vec<3> right = Vec<3>::UnitX(), up = Vec<3>::UnitZ();  ///< unit vectors along the picture's edges
  double pixel = 1;                                      ///< size of a pixel [m]

  Vec<3> toward_eye() const { return right.cross(up); }
};

/// Columns of equal length; places three numbers each [m].
struct Spheres {
  std::span<const float> places, radii;  ///< m
  std::span<const std::uint32_t> rgb;
};

/// Triangles with three corners each, of points with normals (three numbers each, of any length).
struct Surface {
  std::span<const float> places, normals;
  std::span<const std::uint32_t> rgb;  ///< of points
  std::span<const std::int32_t> triangles;
};

/// A flat picture in space, not shaded: the face of a cut.
struct Plate {
  static constexpr std::uint32_t nothing = 0xFF000000u;        ///< in `rgb`: there is no matter
  Vec<3> corner = Vec<3>::Zero();                              ///< of the lower left pixel [m]
  Vec<3> across = Vec<3>::UnitX(), upwards = Vec<3>::UnitZ();  ///< from a pixel to the next [m]
  int width = 0, height = 0;
  std::span<const std::uint32_t> rgb;  ///< rows upwards
  /// If there is any: how full of matter the pixels are; between them it is linear, and matter ends at one half.
  std::span<const float> filling;
};

struct Solids {
  Spheres spheres;
  Surface surface;
  Plate plate;
  bool flat = false;  ///< colours as they are, without light and shadow
};

/// The picture of width x height pixels on a background of one colour. Lines beyond the picture are not drawn.
Raster draw_solids(const Solids& solids, const Camera& camera, int width, int height, std::uint32_t background);

}  // namespace ejecta
