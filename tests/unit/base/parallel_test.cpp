#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "unit/base/thread_counts.hpp"

namespace ejecta {
namespace {

std::vector<double> random_numbers(std::size_t n) {
  std::mt19937_64 random(7);
  std::lognormal_distribution<double> spread(0, 8);
  std::vector<double> values(n);
  for (double& v : values) v = (random() & 1 ? 1 : -1) * spread(random);
  return values;
}

TEST(ParallelSum, IsTheSameNumberForEveryThreadCount) {
  for (const std::size_t n : {0u, 1u, 63u, 64u, 65u, 100003u}) {
    const std::vector<double> values = random_numbers(n);
    std::vector<double> sums;
    for_thread_counts([&](int) { sums.push_back(parallel_sum<double>(n, [&](std::size_t i) { return values[i]; })); });
    EXPECT_EQ(sums[0], sums[1]) << n;
    EXPECT_EQ(sums[0], sums[2]) << n;
    long double exact = 0, scale = 0;
    for (const double v : values) {
      exact += v;
      scale += std::abs(v);
    }
    EXPECT_NEAR(sums[0], static_cast<double>(exact), 1e-13 * static_cast<double>(scale)) << n;
  }
}

TEST(ParallelMin, FindsTheLowestIndexOfTheSmallestValue) {
  std::vector<double> values(100003, 5.0);
  values[70000] = values[70001] = values[99999] = 2;
  for_thread_counts([&](int) {
    const IndexedMin least = parallel_min(values.size(), 4.0, [&](std::size_t i) { return values[i]; });
    EXPECT_EQ(least.value, 2);
    EXPECT_EQ(least.index, 70000u);
  });
}

TEST(ParallelMin, NothingBelowTheInitialValueGivesIndexN) {
  const std::vector<double> values(1000, 5.0);
  const IndexedMin least = parallel_min(values.size(), 5.0, [&](std::size_t i) { return values[i]; });
  EXPECT_EQ(least.index, values.size());
  EXPECT_EQ(least.value, 5);
  EXPECT_EQ(parallel_min(0, 1.0, [](std::size_t) { return 0.0; }).index, 0u);
}

TEST(ParallelFor, VisitsEveryIndexOnce) {
  for_thread_counts([](int) {
    std::vector<int> visits(10000, 0);
    parallel_for(17, 9001, [&](std::size_t i) { ++visits[i]; });
    EXPECT_EQ(std::accumulate(visits.begin(), visits.end(), 0), 9001 - 17);
    EXPECT_EQ(*std::max_element(visits.begin(), visits.end()), 1);
    EXPECT_EQ(visits[16] + visits[9001], 0);
    parallel_for(5, 5, [&](std::size_t) { FAIL() << "an empty range has no body"; });
  });
}

TEST(ParallelBlocks, CutIntoConsecutiveBlocksOfTheGrain) {
  for_thread_counts([](int) {
    std::vector<std::size_t> ends(4, 0);
    parallel_blocks(100, 30, [&](std::size_t begin, std::size_t end) { ends.at(begin / 30) = end; });
    EXPECT_EQ(ends, (std::vector<std::size_t>{30, 60, 90, 100}));
  });
}

TEST(ParallelBlocks, RethrowAnExceptionAfterTheLoop) {
  for_thread_counts([](int threads) {
    try {
      parallel_for(0, 50000, [](std::size_t i) {
        if (i == 31234) throw std::runtime_error("index 31234");
      });
      ADD_FAILURE() << "no exception with " << threads << " threads";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "index 31234");
    }
  });
}

}  // namespace
}  // namespace ejecta
