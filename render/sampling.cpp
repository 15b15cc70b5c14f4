#include "render/sampling.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.hpp"
#include "particles/smoothing_metric.hpp"
#include "render/footprint.hpp"
#include "render/kernel_table.hpp"

namespace ejecta {

namespace {

SquareTable slice_table(const KernelShape& kernel) {
  return {kernel.support, [&](double s) { return kernel.value(std::sqrt(s)); }};
}

/// Line integral of the kernel at impact parameter sqrt(s), by Simpson's rule.
SquareTable column_table(const KernelShape& kernel) {
  return {kernel.support, [&](double s) {
            constexpr int n = 128;
            const double reach = std::sqrt(std::max(0.0, kernel.support * kernel.support - s)), step = reach / n;
            double sum = kernel.value(std::sqrt(s));
            for (int k = 1; k < n; ++k) sum += (k % 2 ? 4 : 2) * kernel.value(std::sqrt(s + k * step * k * step));
            return 2 * step / 3 * sum;
          }};
}

/// Footprint of one particle: weight amplitude * table(q^2), q^2 = least + uu du^2 + 2 uv du dv + vv dv^2, at pixels
/// within `reach` of (u, v).
struct Splat {
  std::size_t particle;
  double u, v, least, uu, uv, vv, amplitude, reach_u, reach_v;
};

Splat splat_of(std::size_t particle, double u, double v, const Footprint& print, double amplitude, double support) {
  const Vec<2> reach = print.reach(support);
  return {particle,         u + print.centre[0], v + print.centre[1], print.least, print.form(0, 0),
          print.form(0, 1), print.form(1, 1),    amplitude,           reach[0],    reach[1]};
}

/// First and one past the last pixel whose centre lies within `radius` of x; empty if none.
std::array<int, 2> covered(double x, double radius, double first, double pixel, int pixels) {
  const double low = std::ceil((x - radius - first) / pixel), high = std::floor((x + radius - first) / pixel);
  if (!(low <= high)) return {0, 0};  // also where a failing run hands over a NaN position
  const double n = pixels;
  return {static_cast<int>(std::clamp(low, 0.0, n)), static_cast<int>(std::clamp(high + 1, 0.0, n))};
}

/// Calls paint(splat, pixel index, weight) for every covered pixel. A thread owns bands of rows and meets the splats of
/// a band in the order given, so sums do not depend on the threads.
template <class Paint>
void for_each_pixel(const std::vector<Splat>& splats, const PixelGrid& grid, const SquareTable& table, double support,
                    Paint&& paint) {
  constexpr int band = 8;
  const std::size_t bands = static_cast<std::size_t>((grid.height + band - 1) / band);
  const auto rows_of = [&](const Splat& s) { return covered(s.v, s.reach_v, grid.first[1], grid.pixel, grid.height); };
  std::vector<std::size_t> start(bands + 1, 0);
  const auto each_band = [&](std::size_t k, auto&& visit) {
    const auto [low, high] = rows_of(splats[k]);
    if (!(splats[k].amplitude > 0)) return;  // NaN or a broken metric of a failing run
    for (int b = low / band; low < high && b <= (high - 1) / band; ++b) visit(static_cast<std::size_t>(b));
  };
  for (std::size_t k = 0; k < splats.size(); ++k) each_band(k, [&](std::size_t b) { ++start[b + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::size_t> in_band(start.back()), next(start.begin(), start.end() - 1);
  for (std::size_t k = 0; k < splats.size(); ++k) each_band(k, [&](std::size_t b) { in_band[next[b]++] = k; });

  parallel_blocks(bands, 1, [&](std::size_t b, std::size_t) {
    for (std::size_t entry = start[b]; entry < start[b + 1]; ++entry) {
      const Splat& s = splats[in_band[entry]];
      const auto [low, high] = rows_of(s);
      const auto [left, right] = covered(s.u, s.reach_u, grid.first[0], grid.pixel, grid.width);
      const int top = std::min(high, static_cast<int>(b + 1) * band);
      for (int j = std::max(low, static_cast<int>(b) * band); j < top; ++j) {
        const double dv = grid.first[1] + j * grid.pixel - s.v;
        for (int i = left; i < right; ++i) {
          const double du = grid.first[0] + i * grid.pixel - s.u;
          const double q2 = s.least + s.uu * (du * du) + 2 * s.uv * (du * dv) + s.vv * (dv * dv);
          if (q2 < support * support)
            paint(s, static_cast<std::size_t>(j) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(i),
                  s.amplitude * table(std::max(0.0, q2)));
        }
      }
    }
  });
}

/// What cracks have made of a particle does not pass over to its neighbours: a mean would show cracks as wide as h.
bool is_state_of_matter(const std::string& field) { return field.starts_with("damage"); }

std::size_t pixels(const PixelGrid& grid) {
  return static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height);
}

}  // namespace

template <int Dim>
Mat<Dim> ParticleView::metric(std::size_t i) const {
  if (smoothing_metric[0].empty()) return round_metric<Dim>(smoothing_length[i]);
  Symmetric<Dim> g;
  for (int k = 0; k < symmetric_size<Dim>; ++k) g[k] = smoothing_metric[static_cast<std::size_t>(k)][i];
  return matrix_of<Dim>(g);
}
template Mat<2> ParticleView::metric<2>(std::size_t) const;
template Mat<3> ParticleView::metric<3>(std::size_t) const;

PixelGrid centred_grid(int width, int height, std::array<double, 2> centre, double visible_width) {
  const double pixel = visible_width / width;
  return {width, height, {centre[0] - 0.5 * (width - 1) * pixel, centre[1] - 0.5 * (height - 1) * pixel}, pixel};
}

const SampledImage::Field& SampledImage::field(std::string_view name) const {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  assert(found != fields.end());
  return *found;
}

SampledImage sample_slice(const ParticleView& particles, std::span<const FieldView> fields, const KernelShape& kernel,
                          const PixelGrid& grid, double plane_y, double least_filling) {
  const auto& [x, y, z] = particles.position;
  std::vector<Splat> splats;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double volume = particles.mass[i] / particles.density[i];
    if (particles.dimension() == 2) {
      const Mat<2> g = particles.metric<2>(i);
      splats.push_back(
          splat_of(i, x[i], y[i], {Vec<2>::Zero(), 0, g}, volume * std::sqrt(g.determinant()), kernel.support));
    } else {
      if (particles.smoothing_metric[0].empty() &&
          std::abs(plane_y - y[i]) > kernel.support * particles.smoothing_length[i])
        continue;  // most are, and it is easily seen
      const Mat<3> g = particles.metric<3>(i);
      const Footprint print = section(g, plane_y - y[i]);
      if (print.least < kernel.support * kernel.support)
        splats.push_back(splat_of(i, x[i], z[i], print, volume * std::sqrt(g.determinant()), kernel.support));
    }
  }

  std::vector<std::span<const double>> sources;  // of components, one field after the other
  std::vector<bool> states;
  for (const FieldView& f : fields) {
    sources.insert(sources.end(), f.components.begin(), f.components.end());
    states.insert(states.end(), f.components.size(), is_state_of_matter(f.name));
  }
  // The sums of a pixel lie together, that of the weights last.
  const std::size_t n = sources.size(), count = pixels(grid);
  std::vector<double> sums(count * (n + 1), 0.0);
  std::vector<std::size_t> nearest(count, particles.size());
  std::vector<float> most(count, 0.0f);
  for_each_pixel(splats, grid, slice_table(kernel), kernel.support, [&](const Splat& s, std::size_t p, double weight) {
    double* sum = sums.data() + p * (n + 1);
    for (std::size_t k = 0; k < n; ++k) sum[k] += weight * sources[k][s.particle];
    sum[n] += weight;
    if (static_cast<float>(weight) > most[p]) {
      most[p] = static_cast<float>(weight);
      nearest[p] = s.particle;
    }
  });

  SampledImage image{grid, {}};
  std::vector<double*> targets;
  for (const FieldView& f : fields)
    image.fields.push_back(
        {f.name, f.unit, std::vector<std::vector<double>>(f.components.size(), std::vector<double>(count))});
  image.fields.push_back({"filling", "1", {std::vector<double>(count)}});
  for (SampledImage::Field& f : image.fields)
    for (std::vector<double>& component : f.components) targets.push_back(component.data());
  parallel_for(0, count, [&](std::size_t p) {
    const double* sum = sums.data() + p * (n + 1);
    const double filling = targets[n][p] = sum[n];
    for (std::size_t k = 0; k < n; ++k)
      targets[k][p] = filling < least_filling ? std::numeric_limits<double>::quiet_NaN()
                      : states[k]             ? sources[k][nearest[p]]
                                              : sum[k] / filling;
  });
  return image;
}

SampledImage sample_column_density(const ParticleView& particles, const KernelShape& kernel, const PixelGrid& grid) {
  const bool flat = particles.dimension() == 2;
  std::vector<Splat> splats;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    Footprint print = flat ? Footprint{Vec<2>::Zero(), 0, particles.metric<2>(i)} : projection(particles.metric<3>(i));
    print.form = widened(print.form, grid.pixel);
    splats.push_back(splat_of(i, particles.position[0][i], particles.position[flat ? 1 : 2][i], print,
                              particles.mass[i] * std::sqrt(print.form.determinant()), kernel.support));
  }
  SampledImage image{grid, {{"column_density", flat ? "kg/m^3" : "kg/m^2", {std::vector<double>(pixels(grid), 0.0)}}}};
  std::vector<double>& sum = image.fields[0].components[0];
  for_each_pixel(splats, grid, flat ? slice_table(kernel) : column_table(kernel), kernel.support,
                 [&](const Splat&, std::size_t p, double weight) { sum[p] += weight; });
  for (double& value : sum)
    if (value == 0) value = std::numeric_limits<double>::quiet_NaN();
  return image;
}

Channel image_channel(const SampledImage& image, std::string name) {
  Channel channel;
  channel.name = std::move(name);
  channel.kind = ChannelKind::image;
  channel.count = pixels(image.grid);
  channel.extent = {image.grid.width, image.grid.height, 1};
  channel.origin = {image.grid.first[0], image.grid.first[1], 0};
  channel.spacing = {image.grid.pixel, image.grid.pixel, image.grid.pixel};
  for (const SampledImage::Field& f : image.fields) channel.fields.push_back(f.view());
  return channel;
}

}  // namespace ejecta
