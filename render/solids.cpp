#include "render/solids.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/parallel.hpp"
#include "render/depth_buffer.hpp"

namespace ejecta {

namespace {

using V = Eigen::Vector3f;

constexpr int fineness = 2;  // samples along each edge of a pixel
/// Toward the light, on the screen (x right, y down, z toward the eye): from the upper left, over the eye's shoulder.
const V toward_light = V(-0.42f, -0.58f, 0.70f).normalized();

/// The scene in the light's eyes: a point that is not seen there lies in shadow.
class Shadows {
 public:
  Shadows(const Solids& solids, const Camera& camera, int width, int height)
      : camera_(seen_by_light(camera)), buffer_(Screen(without_plate(solids), camera_, width, height)) {
    const Vec<3> eye = camera.toward_eye();
    Mat<3> from, to;  // both cameras have one centre and pixels of one size
    from << camera.right, -camera.up, eye;
    to << camera_.right.transpose(), -camera_.up.transpose(), camera_.toward_eye().transpose();
    turn_ = (to * from).cast<float>();
    middle_ = V(0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height), 0);
  }

  /// 1 in the light, 0 in shadow; `x` in pixels from the middle of the picture, `normal` where it lies.
  float light_at(const V& x, const V& normal) const {
    const V p = turn_ * (x + 1.5f * normal) + middle_;  // a step off the surface, which must not shade itself
    const int i = static_cast<int>(std::floor(p[0] - 0.5f)), j = static_cast<int>(std::floor(p[1] - 0.5f));
    if (i < 0 || j < 0 || i + 1 >= buffer_.width || j + 1 >= buffer_.height) return 1;
    const float u = p[0] - 0.5f - static_cast<float>(i), v = p[1] - 0.5f - static_cast<float>(j);
    const auto lit = [&](int a, int b) { return buffer_.depth[buffer_.index(a, b)] > p[2] + 1.5f ? 0.0f : 1.0f; };
    return (1 - v) * ((1 - u) * lit(i, j) + u * lit(i + 1, j)) + v * ((1 - u) * lit(i, j + 1) + u * lit(i + 1, j + 1));
  }

 private:
  static Solids without_plate(Solids solids) {
    solids.plate = {};
    return solids;
  }
  static Camera seen_by_light(const Camera& camera) {
    const Vec<3> light =
        toward_light[0] * camera.right - toward_light[1] * camera.up + toward_light[2] * camera.toward_eye();
    Camera c = camera;
    c.right = camera.up.cross(light).normalized();
    c.up = light.cross(c.right);
    return c;
  }

  Camera camera_;
  DepthBuffer buffer_;
  Eigen::Matrix3f turn_;
  V middle_;
};

/// How much of the sky each pixel sees, 1 all of it. After Shanmugam & Arikan (2007) in screen space, by pairs of
/// opposite neighbours, so that a slope does not darken itself (recalled, not looked up).
class Occlusion {
 public:
  Occlusion(const std::vector<float>& depth, int width, int height)
      : width_(width), height_(height), open_(depth.size(), 1) {
    const float reach = 0.035f * static_cast<float>(height);
    std::array<std::array<int, 3>, pairs * turns> steps{};  // of each turn: dx, dy and length, at least 1
    std::array<float, pairs * turns> length{};
    for (std::size_t t = 0; t < turns; ++t)
      for (std::size_t k = 0; k < pairs; ++k) {
        const float part = (static_cast<float>(k) + 0.5f) / pairs;
        const float angle =
            std::numbers::pi_v<float> * (static_cast<float>(t) / turns + static_cast<float>(k) * 0.618034f);
        const float d = std::max(1.5f, reach * part * part);
        const int dx = static_cast<int>(std::lround(d * std::cos(angle))),
                  dy = static_cast<int>(std::lround(d * std::sin(angle)));
        steps[t * pairs + k] = {dx, dy, 0};
        length[t * pairs + k] = std::hypot(static_cast<float>(dx), static_cast<float>(dy));
      }
    const float farthest = 4 * reach;  // what lies so far before a pixel does not touch what it belongs to
    parallel_blocks(static_cast<std::size_t>(height), 8, [&](std::size_t begin, std::size_t end) {
      for (int j = static_cast<int>(begin); j < static_cast<int>(end); ++j)
        for (int i = 0; i < width; ++i) {
          const float here = depth[at(i, j)];
          if (here == DepthBuffer::empty) continue;
          const std::size_t turn = static_cast<std::size_t>(((i & 3) * 4 + (j & 3)) * 7 % turns) * pairs;
          float hidden = 0;
          for (std::size_t k = turn; k < turn + pairs; ++k) {
            const auto rise = [&](int dx, int dy) {
              const int a = std::clamp(i + dx, 0, width - 1), b = std::clamp(j + dy, 0, height - 1);
              const float z = depth[at(a, b)] - here;
              return z > farthest ? 0.0f : std::clamp(z / length[k], -1.5f, 1.5f);
            };
            const auto [dx, dy, unused] = steps[k];
            hidden += std::max(0.0f, rise(dx, dy) + rise(-dx, -dy));
          }
          open_[at(i, j)] = 1 - std::min(0.65f, 0.65f * hidden / pairs);
        }
    });
  }

  /// Averaged over the turns, which differ from pixel to pixel, of pixels about as near.
  float at_pixel(const std::vector<float>& depth, int i, int j) const {
    const float here = depth[at(i, j)];
    float sum = 0, weight = 0;
    for (int b = std::max(0, j - 2); b < std::min(height_, j + 2); ++b)
      for (int a = std::max(0, i - 2); a < std::min(width_, i + 2); ++a)
        if (std::abs(depth[at(a, b)] - here) < 4) sum += open_[at(a, b)], weight += 1;
    return weight > 0 ? sum / weight : 1;
  }

 private:
  static constexpr std::size_t pairs = 7, turns = 16;
  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i);
  }
  int width_, height_;
  std::vector<float> open_;
};

struct Point {
  V normal;
  std::uint32_t rgb;
  bool shaded;
};

V turned(const Camera& camera, std::span<const float> vectors, std::size_t i) {
  const Vec<3> v(vectors[3 * i], vectors[3 * i + 1], vectors[3 * i + 2]);
  return V(static_cast<float>(v.dot(camera.right)), static_cast<float>(-v.dot(camera.up)),
           static_cast<float>(v.dot(camera.toward_eye())));
}

V part_of(std::uint32_t rgb) {
  return V(static_cast<float>(rgb >> 16 & 255u), static_cast<float>(rgb >> 8 & 255u), static_cast<float>(rgb & 255u));
}

/// The thing of that number at the sample (x, y).
Point look(const Solids& solids, const Screen& screen, const Camera& camera, std::size_t thing, float x, float y) {
  if (thing < screen.spheres.size()) {
    const ScreenSphere& s = screen.spheres[thing];
    const float u = (x - s.x) / s.radius, v = (y - s.y) / s.radius;
    return {V(u, v, std::sqrt(std::max(0.0f, 1 - u * u - v * v))), solids.spheres.rgb[thing], true};
  }
  thing -= screen.spheres.size();
  if (thing >= screen.triangles.size()) return {V::UnitZ(), screen.plate.at(x, y), false};
  const auto w = screen.triangles[thing].weights(x, y);
  V normal = V::Zero(), colour = V::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto corner = static_cast<std::size_t>(solids.surface.triangles[3 * thing + k]);
    normal += w[k] * turned(camera, solids.surface.normals, corner);
    colour += w[k] * part_of(solids.surface.rgb[corner]);
  }
  if (normal[2] < 0) normal = -normal;  // the inside of a surface is seen too
  const auto byte = [&](int k) { return static_cast<std::uint32_t>(std::clamp(colour[k], 0.0f, 255.0f)); };
  return {normal.normalized(), byte(0) << 16 | byte(1) << 8 | byte(2), true};
}

}  // namespace

Raster draw_solids(const Solids& solids, const Camera& camera, int width, int height, std::uint32_t background) {
  Camera fine = camera;
  fine.pixel = camera.pixel / fineness;
  const Screen screen(solids, fine, width * fineness, height * fineness);
  const DepthBuffer buffer(screen);
  std::optional<Shadows> shadows;
  if (!solids.flat) shadows.emplace(solids, camera, width, height);

  std::vector<float> depth(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));  // of pixels [pixels]
  parallel_for(0, depth.size(), [&](std::size_t p) {
    const int i = static_cast<int>(p % static_cast<std::size_t>(width)) * fineness,
              j = static_cast<int>(p / static_cast<std::size_t>(width)) * fineness;
    float nearest = DepthBuffer::empty;
    for (int b = 0; b < fineness; ++b)
      for (int a = 0; a < fineness; ++a) nearest = std::max(nearest, buffer.depth[buffer.index(i + a, j + b)]);
    depth[p] = nearest / fineness;
  });
  std::optional<Occlusion> occlusion;
  if (!solids.flat) occlusion.emplace(depth, width, height);

  Raster raster(width, height, background);
  const V paper = part_of(background);
  const float haze_depth = 0.5f * static_cast<float>(width);
  parallel_blocks(static_cast<std::size_t>(height), 8, [&](std::size_t begin, std::size_t end) {
    for (int j = static_cast<int>(begin); j < static_cast<int>(end); ++j)
      for (int i = 0; i < width; ++i) {
        const std::size_t p =
            static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i);
        if (depth[p] == DepthBuffer::empty) continue;
        const float open = occlusion ? occlusion->at_pixel(depth, i, j) : 1;
        const auto colour_of = [&](float x, float y, float z, std::size_t thing) -> V {
          const Point point = look(solids, screen, camera, thing, x, y);
          const V own = part_of(point.rgb);
          if (!point.shaded || solids.flat) return own;
          const V place((x - 0.5f * static_cast<float>(screen.width)) / fineness,
                        (y - 0.5f * static_cast<float>(screen.height)) / fineness, z / fineness);
          const float facing = std::max(0.0f, point.normal.dot(toward_light));
          const float lit = facing > 0 ? facing * shadows->light_at(place, point.normal) : 0;
          const float sky = 0.5f + 0.5f * point.normal[2];
          const V shaded = own * std::min(1.12f, open * (0.36f + 0.30f * sky) + 0.50f * lit * (0.4f + 0.6f * open));
          const float haze = 0.22f * std::clamp(-place[2] / haze_depth, 0.0f, 1.0f);
          return shaded + haze * (paper - shaded);
        };
        V sum = V::Zero();
        const std::size_t first = buffer.index(i * fineness, j * fineness);
        bool alike = true;
        for (int b = 0; b < fineness; ++b)
          for (int a = 0; a < fineness; ++a) {
            const std::size_t s = buffer.index(i * fineness + a, j * fineness + b);
            alike = alike && buffer.depth[s] != DepthBuffer::empty && buffer.thing[s] == buffer.thing[first];
          }
        if (alike) {
          const float x = static_cast<float>(i * fineness) + 0.5f * fineness,
                      y = static_cast<float>(j * fineness) + 0.5f * fineness;
          sum = colour_of(x, y, buffer.depth[first], buffer.thing[first]);
        } else {
          for (int b = 0; b < fineness; ++b)
            for (int a = 0; a < fineness; ++a) {
              const int x = i * fineness + a, y = j * fineness + b;
              const std::size_t s = buffer.index(x, y);
              sum += buffer.depth[s] == DepthBuffer::empty
                         ? paper
                         : colour_of(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, buffer.depth[s],
                                     buffer.thing[s]);
            }
          sum /= static_cast<float>(fineness * fineness);
        }
        const auto byte = [&](int k) { return static_cast<std::uint32_t>(std::clamp(sum[k] + 0.5f, 0.0f, 255.0f)); };
        raster.rgb[p] = byte(0) << 16 | byte(1) << 8 | byte(2);
      }
  });
  return raster;
}

}  // namespace ejecta
