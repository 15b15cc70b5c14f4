#include "particles/spatial_order.hpp"

#include <gtest/gtest.h>

#include "unit/base/thread_counts.hpp"
#include "unit/particles/cloud.hpp"

namespace ejecta {
namespace {

template <int Dim>
std::vector<std::int32_t> ids(const Particles<Dim>& p) {
  const auto id = p.label(Label::id);
  return {id.begin(), id.end()};
}

/// Mean diagonal of the boxes around every `cluster_size` consecutive particles.
template <int Dim>
double mean_diagonal(const Particles<Dim>& p, std::size_t cluster_size) {
  double sum = 0;
  for (std::size_t begin = 0; begin < p.size(); begin += cluster_size) {
    Vec<Dim> low = p.vector(Field::position, begin), high = low;
    for (std::size_t i = begin; i < std::min(p.size(), begin + cluster_size); ++i) {
      low = low.cwiseMin(p.vector(Field::position, i));
      high = high.cwiseMax(p.vector(Field::position, i));
    }
    sum += (high - low).norm();
  }
  return sum / std::ceil(static_cast<double>(p.size()) / static_cast<double>(cluster_size));
}

TEST(SpatialOrder, IsAPermutation) {
  const auto p = random_cloud<3>(1003, 1, 0.1, 0.1);
  std::vector<std::uint32_t> order;
  spatial_order(p, 8, order);
  std::sort(order.begin(), order.end());
  ASSERT_EQ(order.size(), 1003u);
  for (std::uint32_t i = 0; i < 1003; ++i) EXPECT_EQ(order[i], i);
}

TEST(SpatialOrder, DependsOnThePositionsAlone) {
  auto p = random_cloud<3>(2000, 2, 0.1, 0.1);
  for (int a = 0; a < 3; ++a)  // many equal coordinates
    for (double& x : p.column(Field::position, a)) x = std::round(10 * x);
  auto shuffled = p;
  std::vector<std::uint32_t> order(2000);
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  shuffled.reorder(order);
  ASSERT_NE(ids(p), ids(shuffled));
  sort_in_space(p, 8);
  for_thread_counts([&](int) {
    auto copy = shuffled;
    sort_in_space(copy, 8);
    EXPECT_EQ(ids(p), ids(copy));
  });
}

TEST(SpatialOrder, KeepsMaterialsApart) {
  auto p = random_cloud<2>(500, 4, 0.1, 0.1);
  const std::vector<Range> ranges{{0, 13}, {13, 13}, {13, 400}, {400, 500}};
  p.set_material_ranges(ranges);
  sort_in_space(p, 8);
  for (const Range& range : ranges)
    for (std::size_t i = range.begin; i < range.end; ++i) {
      EXPECT_GE(static_cast<std::size_t>(p.label(Label::id)[i]), range.begin);
      EXPECT_LT(static_cast<std::size_t>(p.label(Label::id)[i]), range.end);
    }
}

TEST(SpatialOrder, MakesCompactClusters) {
  // Eight particles at this density fill a cube (square) of this edge; a box around them should be little wider.
  auto p3 = random_cloud<3>(8192, 5, 0.1, 0.1);
  auto p2 = random_cloud<2>(8192, 6, 0.1, 0.1);
  sort_in_space(p3, 8);
  sort_in_space(p2, 8);
  EXPECT_LT(mean_diagonal(p3, 8), 1.2 * std::sqrt(3.0) * std::cbrt(8.0 / 8192));
  EXPECT_LT(mean_diagonal(p2, 8), 1.2 * std::sqrt(2.0) * std::sqrt(8.0 / 8192));
}

TEST(SpatialOrder, ServesNoParticlesAndOne) {
  std::vector<std::uint32_t> order{7, 8};
  spatial_order(random_cloud<3>(0, 7, 0.1, 0.1), 8, order);
  EXPECT_TRUE(order.empty());
  spatial_order(random_cloud<3>(1, 7, 0.1, 0.1), 8, order);
  EXPECT_EQ(order, std::vector<std::uint32_t>{0});
}

}  // namespace
}  // namespace ejecta
