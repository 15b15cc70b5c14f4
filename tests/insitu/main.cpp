#include <gtest/gtest.h>

#include <string_view>

#include "insitu/gl_probe.hpp"

/// gl_works() runs this program again as `<program> gl-probe`.
int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "gl-probe") return ejecta::run_gl_probe();
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
