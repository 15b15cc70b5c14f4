#include "base/flush_denormals.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace ejecta {
namespace {

float half_of_least() {
  volatile float least = std::numeric_limits<float>::min(), half = 0.5f;
  return least * half;
}

TEST(FlushDenormals, HoldsWhileItLives) {
  EXPECT_GT(half_of_least(), 0);
#ifdef __SSE2__
  {
    const FlushDenormals flush;
    EXPECT_EQ(half_of_least(), 0);
  }
#endif
  EXPECT_GT(half_of_least(), 0);
}

}  // namespace
}  // namespace ejecta
