#pragma once
/// What lies nearest to the eye at each sample of a picture.
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "render/solids.hpp"

namespace ejecta {

/// Lengths in samples: x to the right, y down the picture from its upper left corner, z toward the eye from its plane.
struct ScreenSphere {
  float x, y, z, radius;
};
struct ScreenTriangle {
  float x[3], y[3], z[3];
  /// Weights of the corners at a sample (x, y), which sum up to 1.
  std::array<float, 3> weights(float px, float py) const;
};
/// At the sample (x, y): pixel (a, b) of the plate and its depth, each const + x * du + y * dv.
struct ScreenPlate {
  struct Linear {
    float start = 0, along_x = 0, along_y = 0;
    float at(float x, float y) const { return start + along_x * x + along_y * y; }
  };
  Linear a, b, z;
  int width = 0, height = 0;
  std::span<const std::uint32_t> rgb;
  std::span<const float> filling;
  std::uint32_t at(float x, float y) const;
};

/// All that there is to see, on the screen of a camera whose pixels are divided into samples.
struct Screen {
  int width = 0, height = 0;  ///< samples
  std::vector<ScreenSphere> spheres;
  std::vector<ScreenTriangle> triangles;
  ScreenPlate plate;

  Screen(const Solids& solids, const Camera& camera, int width, int height);
};

struct DepthBuffer {
  static constexpr float empty = -std::numeric_limits<float>::infinity();
  int width = 0, height = 0, stride = 0;  ///< stride: from a row to the next, with room for a vector beyond its end
  std::vector<float> depth;               ///< toward the eye; `empty` where there is nothing
  std::vector<std::uint32_t> thing;       ///< numbered: spheres, then triangles, then the plate

  /// Of equal depths the first one stays: the picture does not depend on the threads.
  explicit DepthBuffer(const Screen& screen);
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(stride) + static_cast<std::size_t>(x);
  }
};

}  // namespace ejecta
