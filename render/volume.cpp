#include "render/volume.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "render/kernel_table.hpp"

namespace ejecta {

namespace {

constexpr int slab = 4;  // layers of the lattice that a thread fills at a time

/// First and one past the last point within `reach` of x.
std::array<int, 2> covered(double x, double reach, double first, double step, int count) {
  const double low = std::ceil((x - reach - first) / step), high = std::floor((x + reach - first) / step);
  if (!(low <= high)) return {0, 0};  // also where a failing run hands over what is no number
  const double n = count;
  return {static_cast<int>(std::clamp(low, 0.0, n)), static_cast<int>(std::clamp(high + 1, 0.0, n))};
}

}  // namespace

Lattice3 lattice_within(std::array<double, 3> low, std::array<double, 3> high, double step, double most) {
  double volume = 1;
  for (std::size_t a = 0; a < 3; ++a) volume *= high[a] - low[a];
  Lattice3 lattice;
  lattice.first = low;
  lattice.step = std::max(step, std::cbrt(volume / most));
  for (std::size_t a = 0; a < 3; ++a)
    lattice.count[a] = std::max(2, 1 + static_cast<int>((high[a] - low[a]) / lattice.step));
  return lattice;
}

SampledVolume sample_volume(const ParticleView& p, std::span<const std::int32_t> body, const KernelShape& kernel,
                            const Lattice3& lattice) {
  const SquareTable table(kernel.support, [&](double s) { return kernel.value(std::sqrt(s)); });
  const auto& [x, y, z] = p.position;
  struct Blob {
    std::size_t particle;
    Mat<3> metric;
    double amplitude;
    Vec<3> reach;
  };
  std::vector<Blob> blobs;
  std::vector<std::vector<std::uint32_t>> slabs(static_cast<std::size_t>((lattice.count[2] + slab - 1) / slab));
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.smoothing_metric[0].empty()) {  // most are far away, and easily seen to be
      const double reach = kernel.support * p.smoothing_length[i];
      if (y[i] + reach < lattice.first[1] || y[i] - reach > lattice.first[1] + (lattice.count[1] - 1) * lattice.step)
        continue;
    }
    const Mat<3> g = p.metric<3>(i);
    const Vec<3> reach = kernel.support * g.inverse().diagonal().cwiseSqrt();
    const auto [low, high] = covered(z[i], reach[2], lattice.first[2], lattice.step, lattice.count[2]);
    const double amplitude = p.mass[i] / p.density[i] * std::sqrt(g.determinant());
    if (low >= high || !(amplitude > 0)) continue;
    const auto [near, far] = covered(y[i], reach[1], lattice.first[1], lattice.step, lattice.count[1]);
    if (near >= far) continue;
    for (int s = low / slab; s <= (high - 1) / slab; ++s)
      slabs[static_cast<std::size_t>(s)].push_back(static_cast<std::uint32_t>(blobs.size()));
    blobs.push_back({i, g, amplitude, reach});
  }

  SampledVolume volume{lattice, std::vector<double>(lattice.size(), 0.0), std::vector<double>(lattice.size(), -1.0)};
  const std::size_t row_length = static_cast<std::size_t>(lattice.count[0]);
  parallel_blocks(slabs.size(), 1, [&](std::size_t s, std::size_t) {
    const int bottom = static_cast<int>(s) * slab, top = std::min(lattice.count[2], bottom + slab);
    std::vector<float> most(
        row_length * static_cast<std::size_t>(lattice.count[1]) * static_cast<std::size_t>(top - bottom), 0.0f);
    const std::size_t offset =
        static_cast<std::size_t>(bottom) * static_cast<std::size_t>(lattice.count[1]) * row_length;
    for (const std::uint32_t b : slabs[s]) {
      const auto& [i, g, amplitude, reach] = blobs[b];
      const auto [left, right] = covered(x[i], reach[0], lattice.first[0], lattice.step, lattice.count[0]);
      const auto [near, far] = covered(y[i], reach[1], lattice.first[1], lattice.step, lattice.count[1]);
      const auto [low, high] = covered(z[i], reach[2], lattice.first[2], lattice.step, lattice.count[2]);
      for (int c = std::max(low, bottom); c < std::min(high, top); ++c)
        for (int k = near; k < far; ++k) {
          const double dy = lattice.first[1] + k * lattice.step - y[i], dz = lattice.first[2] + c * lattice.step - z[i];
          const double cross = 2 * (g(0, 1) * dy + g(0, 2) * dz);
          const double rest = g(1, 1) * dy * dy + 2 * g(1, 2) * dy * dz + g(2, 2) * dz * dz;
          const std::size_t row =
              (static_cast<std::size_t>(c) * static_cast<std::size_t>(lattice.count[1]) + static_cast<std::size_t>(k)) *
              row_length;
          for (int a = left; a < right; ++a) {
            const double dx = lattice.first[0] + a * lattice.step - x[i];
            const double q2 = (g(0, 0) * dx + cross) * dx + rest;
            if (!(q2 < kernel.support * kernel.support)) continue;
            const double weight = amplitude * table(std::max(0.0, q2));
            const std::size_t at = row + static_cast<std::size_t>(a);
            volume.filling[at] += weight;
            if (static_cast<float>(weight) > most[at - offset]) {
              most[at - offset] = static_cast<float>(weight);
              volume.body[at] = body[i];
            }
          }
        }
    }
  });
  return volume;
}

Channel SampledVolume::channel(std::string name) const {
  Channel channel;
  channel.name = std::move(name);
  channel.kind = ChannelKind::image;
  channel.count = lattice.size();
  channel.extent = lattice.count;
  channel.origin = lattice.first;
  channel.spacing = {lattice.step, lattice.step, lattice.step};
  channel.fields = {{"filling", "1", {filling}}, {"body", "1", {body}}};
  return channel;
}

}  // namespace ejecta
