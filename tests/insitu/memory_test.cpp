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
  constexpr int warm_up = 10, frames = 40;
  const ShatteredBall ball(300, 5, 20, 0.2);
  CatalystBridge bridge(default_pipelines(scene_with(true)), ball.settings(fresh_folder("memory")));
  const std::vector<Channel> channels{ball.particles(), ball.slice(), ball.fragments()};
  double before = 0;
  for (int step = 0; step < warm_up + frames; ++step) {
    if (step == warm_up) before = resident_memory();
    ASSERT_EQ(bridge.execute(step, 1e-6 * step, channels).images.size(), 3u);
  }
  const double picture = 3.0 * 960 * 720;  // bytes
  EXPECT_LT(resident_memory() - before, 5 * picture) << "of " << 3 * frames << " pictures";
}

}  // namespace
}  // namespace ejecta
