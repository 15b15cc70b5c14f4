#include "output/checkpoint.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "base/errors.hpp"
#include "output/hdf5_file.hpp"

namespace ejecta {
namespace {

namespace fs = std::filesystem;

class CheckpointTest : public testing::Test {
 protected:
  CheckpointTest() {
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (int i = 0; i < 1000; ++i) {
      x.push_back(0.1 * i);
      id.push_back(1000 - i);
    }
    view.time = 1.0 / 3;
    view.dt = 1e-9;
    view.step = 42;
    view.scalars = {{"initial_energy", 2.5}};
    view.scene = std::string(100000, '#') + "\nname = \"größe\"\n";
    view.columns = {{"position_x", "m", x}, {"density", "kg/m^3", x}};
    view.labels = {{"id", "1", id}};
  }
  fs::path folder = fs::path(testing::TempDir()) /
                    (std::string("ejecta_checkpoint_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  std::vector<double> x;
  std::vector<std::int32_t> id;
  CheckpointView view;
};

TEST_F(CheckpointTest, RoundTripIsBitwise) {
  const fs::path file = folder / "a.h5";
  write_checkpoint(file, view);
  const Checkpoint back = read_checkpoint(file);
  EXPECT_EQ(back.time, view.time);
  EXPECT_EQ(back.dt, view.dt);
  EXPECT_EQ(back.step, 42);
  EXPECT_EQ(back.size(""), 1000u);
  EXPECT_EQ(back.scene, view.scene);
  EXPECT_EQ(back.scalar("initial_energy"), 2.5);
  EXPECT_EQ(back.column("position_x"), x);
  EXPECT_EQ(back.label("id"), id);
  EXPECT_EQ(Hdf5File(file, Hdf5File::Mode::read).unit("/columns/density"), "kg/m^3");
  EXPECT_FALSE(fs::exists(folder / "a.h5.part"));
}

TEST_F(CheckpointTest, KeepsTheNewestTwo) {
  EXPECT_FALSE(latest_checkpoint(folder / "checkpoints"));
  for (const int step : {9, 10, 100}) {
    view.step = step;
    write_rotating_checkpoint(folder / "checkpoints", view);
  }
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder / "checkpoints")) ++files;
  EXPECT_EQ(files, 2u);
  EXPECT_EQ(read_checkpoint(*latest_checkpoint(folder / "checkpoints")).step, 100);
}

TEST_F(CheckpointTest, KeepsAsManyAsAskedFor) {
  for (const int step : {1, 2, 3, 4}) {
    view.step = step;
    write_rotating_checkpoint(folder / "checkpoints", view, 3);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "checkpoints"), {}), 3);
}

/// Any byte that changes is noticed.
TEST_F(CheckpointTest, ADamagedOneIsNamedAndTheOneBeforeItIsUsed) {
  for (const int step : {10, 20}) {
    view.step = step;
    write_rotating_checkpoint(folder, view);
  }
  const fs::path newest = *latest_checkpoint(folder);
  for (const auto at : {600, 2000, 60000, static_cast<int>(fs::file_size(newest)) - 1}) {
    std::fstream file(newest, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(at);
    const char byte = static_cast<char>(file.get());
    const auto put = [&](char value) { file.seekp(at).put(value).flush(); };
    put(static_cast<char>(byte ^ 4));
    std::vector<std::string> problems;
    EXPECT_EQ(read_latest_checkpoint(folder, problems).step, 10) << at;
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_NE(problems[0].find("checkpoint_000000000020.h5"), std::string::npos);
    put(byte);
    EXPECT_EQ(read_latest_checkpoint(folder, problems).step, 20);
  }
  EXPECT_EQ(set_later_checkpoints_aside(folder, 10), std::vector<std::string>{"checkpoint_000000000020.h5"});
  EXPECT_EQ(latest_checkpoint(folder)->filename(), "checkpoint_000000000010.h5");
  EXPECT_TRUE(fs::exists(newest.string() + ".aside"));
}

TEST_F(CheckpointTest, NamesWhatIsWrong) {
  const auto message = [](auto&& call) {
    try {
      call();
    } catch (const InputError& error) {
      return std::string(error.what());
    } catch (const OutputError& error) {
      return "output: " + std::string(error.what());
    }
    return std::string("no error");
  };
  const fs::path file = folder / "b.h5";
  write_checkpoint(file, view);
  EXPECT_NE(message([&] { read_checkpoint(file).column("damage"); }).find("\"damage\""), std::string::npos);
  fs::resize_file(file, fs::file_size(file) / 2);
  EXPECT_NE(message([&] { read_checkpoint(file); }).find("truncated"), std::string::npos);
  EXPECT_NE(message([&] { read_checkpoint(folder / "absent.h5"); }).find("missing"), std::string::npos);
  std::ofstream(folder / "text.h5") << "no HDF5";
  EXPECT_NE(message([&] { read_checkpoint(folder / "text.h5"); }).find("another format"), std::string::npos);
  EXPECT_NE(message([&] { write_checkpoint(file / "c.h5", view); }).find("cannot be written: Not a directory"),
            std::string::npos);

  id.pop_back();
  view.labels = {{"id", "1", id}};
  write_checkpoint(file, view);
  EXPECT_NE(message([&] { read_checkpoint(file); }).find("holds 999 values"), std::string::npos);
  Hdf5File(folder / "other.h5", Hdf5File::Mode::create).write_attribute("format", std::int64_t{77});
  EXPECT_NE(message([&] { read_checkpoint(folder / "other.h5"); }).find("got 77"), std::string::npos);
}

}  // namespace
}  // namespace ejecta
