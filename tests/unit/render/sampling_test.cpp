#include "render/sampling.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
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

using Metric = std::array<std::vector<double>, 6>;

template <int Dim>
Metric uniform_metric(const Mat<Dim>& g, std::size_t n) {
  Metric columns;
  const Symmetric<Dim> s = symmetric_of<Dim>(g);
  for (int k = 0; k < symmetric_size<Dim>; ++k) columns[static_cast<std::size_t>(k)].assign(n, s[k]);
  return columns;
}

ParticleView with_metric(ParticleView view, const Metric& metric) {
  for (std::size_t k = 0; k < metric.size(); ++k) view.smoothing_metric[k] = metric[k];
  return view;
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

/// A stretch along x of determinant 1, then a turn: longest over shortest axis `aspect`.
template <int Dim>
Mat<Dim> stretch(double aspect) {
  Mat<Dim> turn;
  if constexpr (Dim == 2)
    turn = Eigen::Rotation2Dd(0.5).toRotationMatrix();
  else
    turn = (Eigen::AngleAxisd(0.4, Vec<3>(1, 2, 0.5).normalized()) * Eigen::AngleAxisd(0.7, Vec<3>::UnitZ()))
               .toRotationMatrix();
  Vec<Dim> axes = Vec<Dim>::Constant(std::pow(aspect, -1.0 / Dim));
  axes[0] *= aspect;
  return turn * axes.asDiagonal();
}

/// Largest departure from 1 of the filling in the middle of a lattice of aspect 8.
template <int Dim>
double ripple(bool with_tensor) {
  Lattice lattice(Dim, Dim == 2 ? 31 : 25);
  const Mat<Dim> f = stretch<Dim>(8);
  const double middle = Dim == 2 ? 15 : 12;
  for (std::size_t i = 0; i < lattice.mass.size(); ++i) {
    Vec<Dim> x;
    for (int a = 0; a < Dim; ++a) x[a] = lattice.x[static_cast<std::size_t>(a)][i] - middle;
    const Vec<Dim> moved = f * x;
    for (int a = 0; a < Dim; ++a) lattice.x[static_cast<std::size_t>(a)][i] = moved[a];
  }
  const Mat<Dim> h = f.inverse() / 1.3;
  const Metric metric = uniform_metric<Dim>(h.transpose() * h, lattice.mass.size());
  const ParticleView view = with_tensor ? with_metric(lattice.view(), metric) : lattice.view();
  const SampledImage image = sample_slice(view, {}, wendland(Dim), centred_grid(24, 24, {0, 0}, 2.5), 0.3);
  double worst = 0;
  for (const double filling : image.field("filling").components[0]) worst = std::max(worst, std::abs(filling - 1));
  return worst;
}

TEST(Sampling, EllipsoidsFillAStretchedLatticeEvenlyAndSpheresDoNot) {
  EXPECT_LT(ripple<2>(true), 0.02);
  EXPECT_GT(ripple<2>(false), 0.1);
  EXPECT_LT(ripple<3>(true), 0.02);
  EXPECT_GT(ripple<3>(false), 0.1);
}

TEST(Sampling, ARoundMetricGivesThePictureOfTheSmoothingLength) {
  const Lattice lattice(3, 8, 0.3);
  const Metric metric = uniform_metric<3>(Mat<3>::Identity() / (1.3 * 1.3), lattice.mass.size());
  const PixelGrid grid = centred_grid(50, 50, {3.5, 3.5}, 9);
  const ParticleView round = lattice.view(), tensor = with_metric(lattice.view(), metric);
  EXPECT_EQ(sample_slice(round, {}, wendland(3), grid, 3.2, 0).fields[0].components,
            sample_slice(tensor, {}, wendland(3), grid, 3.2, 0).fields[0].components);
  const auto a = sample_column_density(round, wendland(3), grid), b = sample_column_density(tensor, wendland(3), grid);
  const auto &sigma = a.fields[0].components[0], &of_tensor = b.fields[0].components[0];
  EXPECT_EQ(std::memcmp(sigma.data(), of_tensor.data(), sigma.size() * sizeof(double)), 0);
}

TEST(Sampling, SliceOfAnEllipsoidIsItsKernelAtEveryPixel) {
  const Mat<3> f = stretch<3>(3), h = f.inverse() / 1.3, g = h.transpose() * h;
  const Lattice lattice(3, 1);
  const Metric metric = uniform_metric<3>(g, 1);
  const KernelShape kernel = wendland(3);
  const PixelGrid grid = centred_grid(40, 40, {0, 0}, 12);
  for (const double y : {0.0, 1.1}) {
    const SampledImage image = sample_slice(with_metric(lattice.view(), metric), {}, kernel, grid, y);
    double largest = 0;
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i) {
        const Vec<3> x(grid.first[0] + i * grid.pixel, y, grid.first[1] + j * grid.pixel);
        const double exact = h.determinant() * kernel.value(std::sqrt(x.dot(g * x)));
        largest = std::max(largest, exact);
        EXPECT_NEAR(image.field("filling").components[0][static_cast<std::size_t>(40 * j + i)], exact, 1e-6);
      }
    EXPECT_GT(largest, 0.05);
  }
}

TEST(Sampling, ColumnOfAnEllipsoidIsTheIntegralOfItsSlices) {
  const Mat<3> f = stretch<3>(3), h = f.inverse() / 1.3;
  const Lattice lattice(3, 1);
  const Metric metric = uniform_metric<3>(h.transpose() * h, 1);
  const ParticleView view = with_metric(lattice.view(), metric);
  const PixelGrid grid = centred_grid(30, 30, {0, 0}, 14);
  const SampledImage column = sample_column_density(view, wendland(3), grid);
  std::vector<double> sum(900, 0.0);
  constexpr double step = 0.05;
  for (int k = -160; k <= 160; ++k) {
    const SampledImage slice = sample_slice(view, {}, wendland(3), grid, k * step);
    for (std::size_t p = 0; p < 900; ++p) sum[p] += 3.0 * step * slice.field("filling").components[0][p];
  }
  double mass = 0;
  for (std::size_t p = 0; p < 900; ++p) {
    const double sigma = column.field("column_density").components[0][p];
    EXPECT_NEAR(std::isnan(sigma) ? 0 : sigma, sum[p], 2e-5);
    mass += std::isnan(sigma) ? 0 : sigma * grid.pixel * grid.pixel;
  }
  EXPECT_NEAR(mass / 3.0, 1, 1e-3);
}

/// However fine or slanted: what an ellipsoid leaves on the pixels is its mass.
TEST(Sampling, ColumnDensityOfEllipsoidsAddsUpToTheMass) {
  const auto mass_ratio = [](int dimension, const Metric& metric) {
    const Lattice lattice(dimension, 8, 0.3);
    const PixelGrid grid = centred_grid(120, 120, {3.5, 3.5}, 30);
    const SampledImage image = sample_column_density(with_metric(lattice.view(), metric), wendland(dimension), grid);
    double mass = 0;
    for (const double sigma : image.fields[0].components[0])
      if (!std::isnan(sigma)) mass += sigma * grid.pixel * grid.pixel;
    return mass / (3.0 * static_cast<double>(lattice.mass.size()));
  };
  for (const double size : {1.3, 0.2}) {  // the second is finer than a pixel along its short axes only
    const Mat<2> flat = (size * stretch<2>(8)).inverse();
    const Mat<3> solid = (size * stretch<3>(8)).inverse();
    EXPECT_NEAR(mass_ratio(2, uniform_metric<2>(flat.transpose() * flat, 64)), 1, 5e-3);
    EXPECT_NEAR(mass_ratio(3, uniform_metric<3>(solid.transpose() * solid, 512)), 1, 5e-3);
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
