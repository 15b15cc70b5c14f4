#include "render/volume.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.hpp"

namespace ejecta {
namespace {

/// Wendland's C2 in space, q in smoothing lengths.
const KernelShape wendland{2, [](double q) {
                             const double t = 1 - q / 2;
                             return q < 2 ? 21 / (16 * std::numbers::pi) * t * t * t * t * (2 * q + 1) : 0.0;
                           }};

/// A block of `n`^3 particles one millimetre apart from the origin on; the upper half is another body.
struct Block {
  std::vector<double> x, y, z, mass, density, h;
  std::vector<std::int32_t> body;
  explicit Block(int n) {
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          x.push_back(1e-3 * (i + 0.5));
          y.push_back(1e-3 * (j + 0.5));
          z.push_back(1e-3 * (k + 0.5));
          body.push_back(2 * k >= n ? 1 : 0);
        }
    mass.assign(x.size(), 2e-6);
    density.assign(x.size(), 2000);
    h.assign(x.size(), 1.3e-3);
  }
  ParticleView view() const { return {{x, y, z}, mass, density, h, {}}; }
};

TEST(Volume, IsFullWithinMatterHalfFullAtItsFaceAndEmptyBeyond) {
  const Block block(16);
  const Lattice3 lattice = lattice_within({-4e-3, -4e-3, -4e-3}, {20e-3, 20e-3, 20e-3}, 1e-3, 1e6);
  const SampledVolume v = sample_volume(block.view(), block.body, wendland, lattice);
  const auto at = [&](int i, int j, int k) {
    return static_cast<std::size_t>(i + lattice.count[0] * (j + lattice.count[1] * k));
  };
  EXPECT_NEAR(v.filling[at(12, 12, 12)], 1, 0.01);
  EXPECT_NEAR(v.filling[at(4, 12, 12)], 0.5, 0.02);  // x = 0
  EXPECT_NEAR(v.filling[at(12, 12, 20)], 0.5, 0.02);
  EXPECT_EQ(v.filling[at(0, 12, 12)], 0);
  EXPECT_EQ(v.body[at(12, 12, 6)], 0);
  EXPECT_EQ(v.body[at(12, 12, 18)], 1);
  EXPECT_EQ(v.body[at(0, 0, 0)], -1);
  const Lattice3 fine = lattice_within({-4e-3, -4e-3, -4e-3}, {20e-3, 20e-3, 20e-3}, 0.37e-3, 1e6);
  double volume = 0;
  for (const double f : sample_volume(block.view(), block.body, wendland, fine).filling)
    volume += f * std::pow(fine.step, 3);
  EXPECT_NEAR(volume, std::pow(16e-3, 3), 1e-3 * std::pow(16e-3, 3));
}

TEST(Volume, ABodyReachesToTheMiddleBetweenItAndTheNextOneInWhateverOrder) {
  Block block(16);
  const Lattice3 lattice = lattice_within({0, 0, 0}, {16e-3, 16e-3, 16e-3}, 0.4e-3, 1e6);
  const auto check = [&] {
    const SampledVolume v = sample_volume(block.view(), block.body, wendland, lattice);
    for (int k = 0; k < lattice.count[2]; ++k) {
      const double z = lattice.step * k;
      if (std::abs(z - 8e-3) < 0.05e-3) continue;
      const auto at = static_cast<std::size_t>(20 + lattice.count[0] * (20 + lattice.count[1] * k));
      EXPECT_EQ(v.body[at], z > 8e-3 ? 1 : 0) << z;
    }
  };
  check();
  for (auto* column : {&block.x, &block.y, &block.z}) std::ranges::reverse(*column);
  std::ranges::reverse(block.body);
  check();
}

TEST(Volume, EllipsoidsAreDrawnOutAsTheirMetricSays) {
  Block one(1);
  std::vector<double> xx{1 / (4e-6)}, yy{1 / (1e-6)}, zero{0.0};  // semi-axes 2, 1, 1 mm
  ParticleView view = one.view();
  view.smoothing_metric = {xx, yy, yy, zero, zero, zero};
  const Lattice3 lattice = lattice_within({-6e-3, -6e-3, -6e-3}, {7e-3, 7e-3, 7e-3}, 0.25e-3, 1e7);
  const SampledVolume v = sample_volume(view, one.body, wendland, lattice);
  std::array<double, 3> reach{0, 0, 0};
  for (std::size_t p = 0; p < v.filling.size(); ++p) {
    if (!(v.filling[p] > 0)) continue;
    std::size_t rest = p;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto n = static_cast<std::size_t>(lattice.count[a]);
      const double place = lattice.first[a] + static_cast<double>(rest % n) * lattice.step;
      reach[a] = std::max(reach[a], std::abs(place - 0.5e-3));
      rest /= n;
    }
  }
  EXPECT_NEAR(reach[0], 4e-3, 0.3e-3);
  EXPECT_NEAR(reach[1], 2e-3, 0.3e-3);
  EXPECT_NEAR(reach[2], 2e-3, 0.3e-3);
}

TEST(Volume, DoesNotDependOnTheThreads) {
  const Block block(12);
  const Lattice3 lattice = lattice_within({0, 0, 0}, {12e-3, 12e-3, 12e-3}, 0.7e-3, 1e6);
  const int before = max_threads();
  set_threads(1);
  const SampledVolume one = sample_volume(block.view(), block.body, wendland, lattice);
  set_threads(4);
  const SampledVolume four = sample_volume(block.view(), block.body, wendland, lattice);
  set_threads(before);
  EXPECT_EQ(one.filling, four.filling);
  EXPECT_EQ(one.body, four.body);
}

TEST(Lattice, HasNoMorePointsThanItMay) {
  const Lattice3 fine = lattice_within({0, 0, 0}, {1, 1, 1}, 0.1, 1e4);
  EXPECT_DOUBLE_EQ(fine.step, 0.1);
  EXPECT_EQ(fine.count[0], 11);
  EXPECT_LT(lattice_within({0, 0, 0}, {1, 1, 1}, 1e-3, 1e4).size(), 1.2e4);
}

}  // namespace
}  // namespace ejecta
