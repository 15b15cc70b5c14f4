#include <gtest/gtest.h>

namespace ejecta {
namespace {

TEST(Assertions, AreOnInDebugBuilds) {
#if !defined(EJECTA_DEBUG)
  GTEST_SKIP() << "of another kind of build";
#elif defined(NDEBUG)
  FAIL() << "NDEBUG is defined";
#endif
}

}  // namespace
}  // namespace ejecta
