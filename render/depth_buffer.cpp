#include "render/depth_buffer.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

#include "base/parallel.hpp"
#include "base/simd.hpp"

namespace ejecta {

namespace {

constexpr int band = 16;               // rows
constexpr float least_radius = 0.75f;  // samples: what is finer would come and go

using simd::Floats;
using Numbers = simd::Vector<std::uint32_t, simd::lanes<float>>;

/// First and one past the last sample whose centre lies in [low, high].
std::array<int, 2> samples_within(float low, float high, int count) {
  const float first = std::ceil(low - 0.5f), last = std::floor(high - 0.5f), n = static_cast<float>(count);
  if (!(first <= last)) return {0, 0};  // also where a failing run hands over what is no number
  return {static_cast<int>(std::clamp(first, 0.0f, n)), static_cast<int>(std::clamp(last + 1, 0.0f, n))};
}

std::array<float, 2> extent(const float (&v)[3]) {
  return {std::min({v[0], v[1], v[2]}), std::max({v[0], v[1], v[2]})};
}

/// For each band of rows the things that reach into it, in their order.
class Bands {
 public:
  template <class Rows>
  Bands(std::size_t things, int height, Rows&& rows_of)
      : start_(static_cast<std::size_t>((height + band - 1) / band) + 1, 0) {
    const auto each = [&](std::size_t k, auto&& visit) {
      const auto [low, high] = rows_of(k);
      for (int b = low / band; low < high && b <= (high - 1) / band; ++b) visit(static_cast<std::size_t>(b));
    };
    for (std::size_t k = 0; k < things; ++k) each(k, [&](std::size_t b) { ++start_[b + 1]; });
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    things_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t k = 0; k < things; ++k)
      each(k, [&](std::size_t b) { things_[next[b]++] = static_cast<std::uint32_t>(k); });
  }
  std::span<const std::uint32_t> of(std::size_t b) const {
    return {things_.data() + start_[b], start_[b + 1] - start_[b]};
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<std::uint32_t> things_;
};

}  // namespace

std::array<float, 3> ScreenTriangle::weights(float px, float py) const {
  const float area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  const float w1 = ((px - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (py - y[0])) / area;
  const float w2 = ((x[1] - x[0]) * (py - y[0]) - (px - x[0]) * (y[1] - y[0])) / area;
  return {1 - w1 - w2, w1, w2};
}

std::uint32_t ScreenPlate::at(float x, float y) const {
  const float u = a.at(x, y), v = b.at(x, y);
  const int i = static_cast<int>(std::floor(u + 0.5f)), j = static_cast<int>(std::floor(v + 0.5f));
  if (i < 0 || j < 0 || i >= width || j >= height) return Plate::nothing;
  const auto index = [&](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  };
  if (!filling.empty() && width > 1 && height > 1) {
    const int left = std::clamp(static_cast<int>(std::floor(u)), 0, width - 2),
              low = std::clamp(static_cast<int>(std::floor(v)), 0, height - 2);
    const auto row = [&](int k) {
      return std::lerp(filling[index(left, k)], filling[index(left + 1, k)], u - static_cast<float>(left));
    };
    if (!(std::lerp(row(low), row(low + 1), v - static_cast<float>(low)) >= 0.5f)) return Plate::nothing;
  }
  return rgb[index(i, j)];
}

Screen::Screen(const Solids& solids, const Camera& camera, int w, int h) : width(w), height(h) {
  const Vec<3> eye = camera.toward_eye();
  Mat<3> turn;  // from space to the screen
  turn << camera.right.transpose(), -camera.up.transpose(), eye.transpose();
  turn /= camera.pixel;
  const Vec<3> middle(0.5 * w, 0.5 * h, 0);
  const auto placed = [&](const Vec<3>& x) -> Vec<3> { return turn * (x - camera.centre) + middle; };
  const auto point = [&](std::span<const float> places, std::size_t i) {
    return placed({places[3 * i], places[3 * i + 1], places[3 * i + 2]}).cast<float>().eval();
  };
  spheres.resize(solids.spheres.radii.size());
  parallel_for(0, spheres.size(), [&](std::size_t i) {
    const auto x = point(solids.spheres.places, i);
    spheres[i] = {x[0], x[1], x[2], std::max(least_radius, static_cast<float>(solids.spheres.radii[i] / camera.pixel))};
  });
  const auto corners = solids.surface.triangles;
  triangles.resize(corners.size() / 3);
  parallel_for(0, triangles.size(), [&](std::size_t i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto x = point(solids.surface.places, static_cast<std::size_t>(corners[3 * i + k]));
      triangles[i].x[k] = x[0], triangles[i].y[k] = x[1], triangles[i].z[k] = x[2];
    }
  });
  if (solids.plate.rgb.empty()) return;
  const Vec<3> corner = placed(solids.plate.corner), across = turn * solids.plate.across,
               upwards = turn * solids.plate.upwards;
  Mat<2> edges;
  edges << across[0], upwards[0], across[1], upwards[1];
  if (std::abs(edges.determinant()) < 1e-9) return;  // seen edge on
  const Mat<2> inverse = edges.inverse();
  const auto linear = [&](double du, double dv, double at_corner) {
    return ScreenPlate::Linear{static_cast<float>(at_corner - du * corner[0] - dv * corner[1]), static_cast<float>(du),
                               static_cast<float>(dv)};
  };
  const Vec<2> slope = inverse.transpose() * Vec<2>(across[2], upwards[2]);
  plate = {linear(inverse(0, 0), inverse(0, 1), 0),
           linear(inverse(1, 0), inverse(1, 1), 0),
           linear(slope[0], slope[1], corner[2]),
           solids.plate.width,
           solids.plate.height,
           solids.plate.rgb,
           solids.plate.filling};
}

DepthBuffer::DepthBuffer(const Screen& screen)
    : width(screen.width),
      height(screen.height),
      stride(width + simd::lanes<float>),
      depth(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height), empty),
      thing(depth.size(), 0) {
  const Bands spheres(screen.spheres.size(), height, [&](std::size_t k) {
    const ScreenSphere& s = screen.spheres[k];
    return samples_within(s.y - s.radius, s.y + s.radius, height);
  });
  const Bands triangles(screen.triangles.size(), height, [&](std::size_t k) {
    const auto [low, high] = extent(screen.triangles[k].y);
    return samples_within(low, high, height);
  });
  const auto put = [&](std::size_t at, float z, std::size_t number) {
    if (!(z > depth[at])) return;
    depth[at] = z;
    thing[at] = static_cast<std::uint32_t>(number);
  };
  Floats steps;
  for (int lane = 0; lane < simd::lanes<float>; ++lane) steps[lane] = static_cast<float>(lane);
  const std::size_t bands = static_cast<std::size_t>((height + band - 1) / band);
  parallel_blocks(bands, 1, [&](std::size_t b, std::size_t) {
    const int first_row = static_cast<int>(b) * band, last_row = std::min(height, first_row + band);
    for (const std::uint32_t k : spheres.of(b)) {
      const ScreenSphere& s = screen.spheres[k];
      const auto [low, high] = samples_within(s.y - s.radius, s.y + s.radius, height);
      for (int j = std::max(low, first_row); j < std::min(high, last_row); ++j) {
        const float dy = static_cast<float>(j) + 0.5f - s.y, left = s.radius * s.radius - dy * dy;
        const float half = std::sqrt(std::max(left, 0.0f));
        const auto [begin, end] = samples_within(s.x - half, s.x + half, width);
        float* const depths = depth.data() + index(0, j);
        std::uint32_t* const things = thing.data() + index(0, j);
        for (int i = begin; i < end; i += simd::lanes<float>) {
          const Floats dx = static_cast<float>(i) + 0.5f - s.x + steps, inside = left - dx * dx;
          const Floats z = s.z + simd::square_root(simd::max(inside, Floats{}));
          Floats before;
          Numbers numbers;
          std::memcpy(&before, depths + i, sizeof before);
          std::memcpy(&numbers, things + i, sizeof numbers);
          const auto nearer = (z > before) & (inside >= 0);
          before = nearer ? z : before;
          numbers = nearer ? k + Numbers{} : numbers;
          std::memcpy(depths + i, &before, sizeof before);
          std::memcpy(things + i, &numbers, sizeof numbers);
        }
      }
    }
    for (const std::uint32_t k : triangles.of(b)) {
      const ScreenTriangle& t = screen.triangles[k];
      const auto [low, high] = extent(t.y);
      const auto [top, bottom] = samples_within(low, high, height);
      const auto [near, far] = extent(t.x);
      const auto [begin, end] = samples_within(near, far, width);
      for (int j = std::max(top, first_row); j < std::min(bottom, last_row); ++j)
        for (int i = begin; i < end; ++i) {
          const auto w = t.weights(static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f);
          if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0)
            put(index(i, j), w[0] * t.z[0] + w[1] * t.z[1] + w[2] * t.z[2], screen.spheres.size() + k);
        }
    }
    if (screen.plate.rgb.empty()) return;
    for (int j = first_row; j < last_row; ++j)
      for (int i = 0; i < width; ++i) {
        const float x = static_cast<float>(i) + 0.5f, y = static_cast<float>(j) + 0.5f;
        if (screen.plate.at(x, y) != Plate::nothing)
          put(index(i, j), screen.plate.z.at(x, y), screen.spheres.size() + screen.triangles.size());
      }
  });
}

}  // namespace ejecta
