#include "schemes/support_size.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "schemes/kernels.hpp"

namespace ejecta {
namespace {

constexpr Kernel all_kernels[] = {Kernel::cubic_spline, Kernel::quintic_spline, Kernel::wendland_c2,
                                  Kernel::wendland_c4};

/// Zeroth moment of a particle of a cubic lattice of unit spacing with smoothing length h.
double lattice_moment(Kernel kernel, int dim, double h) {
  return with_kernel(kernel, [&](auto k) {
    using K = decltype(k);
    const int n = static_cast<int>(K::support * h) + 1, depth = dim == 3 ? n : 0;
    double sum = 0;
    for (int x = -n; x <= n; ++x)
      for (int y = -n; y <= n; ++y)
        for (int z = -depth; z <= depth; ++z)
          if (const double q = std::sqrt(double(x * x + y * y + z * z)) / h; q > 0)
            sum -= q * K::slope_over_q(q, 1 / q);
    return sum;
  });
}

TEST(SupportSize, Psi0OfTheCubicSplineIsTheExactLatticeSum) {
  // Sums over the square and cubic lattice of |dW/deta| for W = 1 - 1.5 q^2 + 0.75 q^3, computed independently.
  struct Row {
    double nodes_per_h, in_2d, in_3d;
  };
  for (const Row& row : {Row{1.00, 2.00735, 2.00159}, Row{1.25, 2.61745, 2.53897}, Row{1.51, 3.22166, 3.10796},
                         Row{2.01, 4.31983, 4.14001}, Row{2.50, 5.40628, 5.16018}, Row{3.01, 6.51569, 6.21060},
                         Row{4.01, 8.69416, 8.27657}}) {
    EXPECT_NEAR(SupportSize(Kernel::cubic_spline, 2, 2).psi0(row.nodes_per_h), row.in_2d, 6e-6);
    EXPECT_NEAR(SupportSize(Kernel::cubic_spline, 3, 2).psi0(row.nodes_per_h), row.in_3d, 6e-6);
  }
}

TEST(SupportSize, Psi0OfEveryKernelIsTheExactLatticeSum) {
  // At n_h = 1.3, 1.51, 2.01, 3.01, with the profiles as in kernels.hpp; computed independently.
  struct Row {
    Kernel kernel;
    int dim;
    double psi0[4];
  };
  for (const Row& row : {Row{Kernel::cubic_spline, 2, {2.74055, 3.22166, 4.31983, 6.51569}},
                         Row{Kernel::cubic_spline, 3, {2.65102, 3.10796, 4.14001, 6.21060}},
                         Row{Kernel::quintic_spline, 2, {24.79626, 28.99429, 38.84506, 58.36366}},
                         Row{Kernel::quintic_spline, 3, {12.29440, 14.31427, 19.08519, 28.59867}},
                         Row{Kernel::wendland_c2, 2, {2.49321, 2.97417, 4.04663, 6.13004}},
                         Row{Kernel::wendland_c2, 3, {2.45130, 2.88177, 3.86353, 5.80278}},
                         Row{Kernel::wendland_c4, 2, {2.30304, 2.76641, 3.80170, 5.77591}},
                         Row{Kernel::wendland_c4, 3, {2.23156, 2.63143, 3.54774, 5.33529}}}) {
    const SupportSize size(row.kernel, row.dim, 2);
    constexpr double nodes_per_h[] = {1.3, 1.51, 2.01, 3.01};
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(size.psi0(nodes_per_h[k]), row.psi0[k], 6e-6);
  }
}

TEST(SupportSize, GrowthFollowsOwen2010) {
  const SupportSize size(Kernel::wendland_c2, 3, 1.5);
  const auto growth_at = [&](double nodes) { return size.growth(std::pow(size.psi0(nodes), 3)); };
  // s = 1.5/2 = 0.75: a = 0.4 (1 + 0.5625) = 0.625, growth 0.375 + 0.625 * 0.75
  EXPECT_NEAR(growth_at(2), 0.84375, 1e-6);
  // s = 1.5/1.2 = 1.25: a = 0.4 (1 + 0.512) = 0.6048, growth 0.3952 + 0.6048 * 1.25
  EXPECT_NEAR(growth_at(1.2), 1.1512, 1e-6);
  // s is held at 1/4: a = 0.425
  EXPECT_NEAR(growth_at(7.5), 1 - 0.425 * 0.75, 1e-6);
}

TEST(SupportSize, WithNoNeighboursHalfTheTargetIsAssumed) {
  for (const int dim : {2, 3}) {
    const SupportSize size(Kernel::wendland_c2, dim, 1.5);
    EXPECT_EQ(size.effective_nodes_per_h(0), 0.75);
    EXPECT_NEAR(size.growth(0), 1 + 0.45, 1e-15);  // s = 2: a = 0.4 (1 + 1/8)
  }
}

TEST(SupportSize, APerfectLatticeIsAFixedPoint) {
  for (const Kernel kernel : all_kernels)
    for (const int dim : {2, 3})
      for (const double target : {1.3, 1.5, 2.01}) {
        const SupportSize size(kernel, dim, target);
        const double sum = lattice_moment(kernel, dim, target);
        EXPECT_NEAR(size.effective_nodes_per_h(sum), target, 1e-6);
        EXPECT_NEAR(size.growth(sum), 1, 1e-6);
      }
}

TEST(SupportSize, IterationFindsTheFixedPointFromAfar) {
  for (const Kernel kernel : all_kernels)
    for (const int dim : {2, 3})
      for (const double start : {0.4, 0.8, 2.0, 4.0}) {
        const double target = 1.5;
        const SupportSize size(kernel, dim, target);
        double h = start;
        for (int k = 0; k < 30; ++k) h *= size.growth(lattice_moment(kernel, dim, h));
        EXPECT_NEAR(h, target, 1e-3 * target) << "dimension " << dim << ", from " << start;
      }
}

TEST(SupportSize, GoesOnBeyondTheTable) {
  const SupportSize size(Kernel::wendland_c2, 3, 1.5);
  EXPECT_NEAR(size.effective_nodes_per_h(std::pow(2 * size.psi0(8), 3)), 16, 1e-6);
  EXPECT_NEAR(size.effective_nodes_per_h(1e-30), 0.5, 0.011);  // where the nearest neighbours reach the support
}

}  // namespace
}  // namespace ejecta
