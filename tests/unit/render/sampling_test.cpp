#include "render/sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "base/parallel.hpp"

namespace ejecta {
namespace {

/// Normalised Wendland C2 of support 2 in `dimension` dimensions.
KernelShape wendland(int dimension) {
  const double norm = dimension == 2 ? 7 / (4 * std::numbers::pi) : 21 / (16 * std::numbers::pi);
  return {2.0, [norm](double q) { return q < 2 ? norm * std::pow(1 - 0.5 * q, 4) * (1 + 2 * q) : 0.0; }};
}

/// Lattice of n^dimension particles of unit spacing and density 3 from the origin on.
struct Lattice {
  std::array<std::vector<double>, 3> x;
  std::vector<double> mass, density, h;
  int dimension;
  Lattice(int dim, int n, double jitter = 0, double smoothing = 1.3) : dimension(dim) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> shift(-jitter, jitter);
    for (int k = 0; k < (dim == 3 ? n : 1); ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          x[0].push_back(i + shift(random));
          x[1].push_back(j + shift(random));
          if (dim == 3) x[2].push_back(k + shift(random));
        }
    mass.assign(x[0].size(), 3.0);
    density.assign(x[0].size(), 3.0);
    h.assign(x[0].size(), smoothing);
  }
  ParticleView view() const {
    ParticleView v;
    for (int a = 0; a < dimension; ++a) v.position[a] = x[a];
    v.mass = mass;
    v.density = density;
    v.smoothing_length = h;
    return v;
  }
};

TEST(Sampling, SliceOfALinearFieldIsExactWhereParticlesAreSymmetric) {
  for (const int dimension : {2, 3}) {
    const Lattice lattice(dimension, 13);
    const std::size_t vertical = dimension == 3 ? 2 : 1;
    std::vector<double> field(lattice.mass.size());
    for (std::size_t i = 0; i < field.size(); ++i) field[i] = 2 + 0.5 * lattice.x[0][i] - lattice.x[vertical][i];
    const std::vector<FieldView> fields{{"ramp", "1", {field}}};
    // Pixels of half a spacing: centres on lattice points and half way between them.
    const PixelGrid grid{13, 13, {3, 3}, 0.5};
    const SampledImage image = sample_slice(lattice.view(), fields, wendland(dimension), grid, 6.0);
    for (int j = 0; j < 13; ++j)
      for (int i = 0; i < 13; ++i)
        EXPECT_NEAR(image.field("ramp").components[0][static_cast<std::size_t>(13 * j + i)],
                    2 + 0.5 * (3 + 0.5 * i) - (3 + 0.5 * j), 1e-12);
    for (const double filling : image.field("filling").components[0])
      EXPECT_NEAR(filling, 1, 0.02);  // quadrature by the lattice
  }
}

TEST(Sampling, ShepardMeanOfAConstantIsTheConstantAndVoidIsNaN) {
  const Lattice lattice(3, 8, 0.2);
  const std::vector<double> constant(lattice.mass.size(), 42.0);
  const std::vector<FieldView> fields{{"pressure", "Pa", {constant, constant}}};
  const PixelGrid grid = centred_grid(60, 40, {3.5, 3.5}, 30);
  const SampledImage image = sample_slice(lattice.view(), fields, wendland(3), grid, 3.4);
  const auto& pressure = image.field("pressure");
  ASSERT_EQ(pressure.components.size(), 2u);
  EXPECT_NEAR(pressure.components[0][20 * 60 + 30], 42, 1e-12);
  EXPECT_TRUE(std::isnan(pressure.components[1][0]));
  std::size_t matter = 0;
  for (const double p : pressure.components[0]) matter += std::isnan(p) ? 0 : 1;
  EXPECT_NEAR(static_cast<double>(matter) * grid.pixel * grid.pixel, 64, 20);  // about the section of the cube
}

TEST(Sampling, SliceIsTheKernelSumAtAnyPoint) {
  const Lattice lattice(3, 6, 0.3);
  const KernelShape kernel = wendland(3);
  const PixelGrid grid{1, 1, {2.37, 3.11}, 0.1};
  const SampledImage image = sample_slice(lattice.view(), {}, kernel, grid, 2.8);
  double filling = 0;
  for (std::size_t i = 0; i < lattice.mass.size(); ++i) {
    const double r = std::hypot(lattice.x[0][i] - 2.37, lattice.x[1][i] - 2.8, lattice.x[2][i] - 3.11);
    filling += kernel.value(r / 1.3) / (1.3 * 1.3 * 1.3);
  }
  EXPECT_NEAR(image.field("filling").components[0][0], filling, 2e-6);
}

TEST(Sampling, ColumnDensityAddsUpToTheMass) {
  for (const int dimension : {2, 3})
    for (const double smoothing : {0.01, 1.3}) {  // finer than a pixel, and resolved
      const Lattice lattice(dimension, 8, 0.3, smoothing);
      const PixelGrid grid = centred_grid(80, 80, {3.5, 3.5}, 20);
      const SampledImage image = sample_column_density(lattice.view(), wendland(dimension), grid);
      double mass = 0;
      for (const double sigma : image.field("column_density").components[0])
        if (!std::isnan(sigma)) mass += sigma * grid.pixel * grid.pixel;
      const double expected = 3.0 * static_cast<double>(lattice.mass.size());
      EXPECT_NEAR(mass / expected, 1, smoothing > 1 ? 1e-4 : 5e-3);
    }
}

TEST(Sampling, SameBitsForEveryNumberOfThreads) {
  const Lattice lattice(3, 12, 0.3);
  const std::vector<FieldView> fields{{"x", "m", {lattice.x[0]}}};
  const PixelGrid grid = centred_grid(150, 150, {5.5, 5.5}, 16);
  const int before = max_threads();
  set_threads(1);
  const SampledImage one = sample_slice(lattice.view(), fields, wendland(3), grid, 5.2);
  const SampledImage column_one = sample_column_density(lattice.view(), wendland(3), grid);
  set_threads(3);
  const SampledImage three = sample_slice(lattice.view(), fields, wendland(3), grid, 5.2);
  const SampledImage column_three = sample_column_density(lattice.view(), wendland(3), grid);
  set_threads(before);
  const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
  };
  EXPECT_TRUE(same(one.field("x").components[0], three.field("x").components[0]));
  EXPECT_TRUE(same(column_one.fields[0].components[0], column_three.fields[0].components[0]));
}

TEST(Sampling, ANaNParticleOfAFailedRunSpoilsNothingElse) {
  Lattice lattice(3, 8);
  lattice.x[0][0] = std::nan("");
  const PixelGrid grid = centred_grid(20, 20, {3.5, 3.5}, 6);
  const SampledImage image = sample_slice(lattice.view(), {}, wendland(3), grid, 3.5);
  EXPECT_NEAR(image.field("filling").components[0][210], 1, 0.02);
}

TEST(Sampling, ChannelCarriesExtentOriginAndUnits) {
  const Lattice lattice(2, 8);
  const std::vector<FieldView> fields{{"density", "kg/m^3", {lattice.density}}};
  const SampledImage image = sample_slice(lattice.view(), fields, wendland(2), centred_grid(30, 20, {3, 4}, 15));
  const Channel channel = image_channel(image, "slice");
  EXPECT_EQ(channel.kind, ChannelKind::image);
  EXPECT_EQ(channel.extent, (std::array<int, 3>{30, 20, 1}));
  EXPECT_EQ(channel.count, 600u);
  EXPECT_DOUBLE_EQ(channel.spacing[0], 0.5);
  EXPECT_DOUBLE_EQ(channel.origin[0], 3 - 14.5 * 0.5);
  ASSERT_EQ(channel.fields.size(), 2u);
  EXPECT_EQ(channel.fields[0].unit, "kg/m^3");
  EXPECT_EQ(channel.fields[0].components[0].data(), image.fields[0].components[0].data());
}

}  // namespace
}  // namespace ejecta
