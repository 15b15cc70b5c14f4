/// Frames are drawn for as long as a run lasts: none may leave anything behind in memory.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "insitu/catalyst_bridge.hpp"
#include "insitu/picture.hpp"
#include "insitu/shattered_ball.hpp"

namespace ejecta {
namespace {

/// What the process holds now [bytes].
double resident_memory() {
  std::ifstream in("/proc/self/statm");
  double all = 0, resident = 0;
  in >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

TEST(Memory, DoesNotGrowWithTheNumberOfFrames) {
  constexpr int warm_up = 10, frames = 300;
  const ShatteredBall ball(300, 5, 20, 0.2);
  PipelineSettings settings = ball.settings(fresh_folder("memory"));
  settings.image_width = 320;
  settings.image_height = 240;
  CatalystBridge bridge(plain_pipelines(default_pipelines(scene_with(true))), settings);
  const std::vector<Channel> channels = ball.channels();
  double before = 0;
  for (int step = 0; step < warm_up + frames; ++step) {
    if (step == warm_up) before = resident_memory();
    ASSERT_EQ(bridge.execute(step, 1e-6 * step, channels, every_frame(bridge)).files.size(), 4u);
  }
  const double pictures = 4.0 * frames * 3 * settings.image_width * settings.image_height;  // bytes
  EXPECT_LT(resident_memory() - before, 0.05 * pictures);
}

}  // namespace
}  // namespace ejecta
