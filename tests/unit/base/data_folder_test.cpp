#include "base/data_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "base/errors.hpp"

namespace ejecta {
namespace {

/// Sets EJECTA_DATA for as long as it lives.
struct Asked {
  explicit Asked(const char* folder) { setenv("EJECTA_DATA", folder, 1); }
  ~Asked() { unsetenv("EJECTA_DATA"); }
  Asked(const Asked&) = delete;
  Asked& operator=(const Asked&) = delete;
};

TEST(DataFolder, OfABuildIsTheSourceTree) {
  unsetenv("EJECTA_DATA");
  EXPECT_EQ(data_folder(), EJECTA_SOURCE_DIR);
}

TEST(DataFolder, DoesNotDependOnWhereTheProgramIsStarted) {
  unsetenv("EJECTA_DATA");
  const auto start = std::filesystem::current_path();
  std::filesystem::current_path(EJECTA_SOURCE_DIR);  // where the folders of data are there by their names
  EXPECT_EQ(data_folder(), EJECTA_SOURCE_DIR);
  std::filesystem::current_path(start);
}

TEST(DataFolder, IsWhatTheEnvironmentSays) {
  const auto folder = std::filesystem::temp_directory_path() / "ejecta_data_folder_test";
  std::filesystem::create_directories(folder / "inputs" / "materials");
  std::filesystem::create_directories(folder / "catalyst_scripts");
  const Asked asked(folder.c_str());
  EXPECT_EQ(data_folder(), folder);
  std::filesystem::remove_all(folder);
  EXPECT_THROW(data_folder(), InputError);
}

}  // namespace
}  // namespace ejecta
