#include "insitu/gl_probe.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

namespace ejecta {
namespace {

TEST(GlProbe, WorksWithoutADisplay) { EXPECT_TRUE(gl_works()); }

TEST(GlProbe, SaysNoWhereTheDriverIsMissing) {
  // Mesa loads its software renderer by this name.
  setenv("GALLIUM_DRIVER", "no-such-driver", 1);
  EXPECT_FALSE(gl_works());
  unsetenv("GALLIUM_DRIVER");
}

}  // namespace
}  // namespace ejecta
