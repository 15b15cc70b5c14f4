#include <gtest/gtest.h>

namespace ejecta {
namespace {

/// They cost a tenth of the time of a pair pass, so they are for debug builds and sanitizers.
TEST(Assertions, AreOnInDebugBuildsAndUnderSanitizersOnly) {
#if defined(NDEBUG)
  constexpr bool on = false;
#else
  constexpr bool on = true;
#endif
  EXPECT_EQ(on, EJECTA_ASSERTIONS);
}

}  // namespace
}  // namespace ejecta
