/// A whole run of two frames through ParaView: the default pipelines, a user's script and a failing one.
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <set>
#include <sstream>

#include "insitu/catalyst_bridge.hpp"
#include "insitu/picture.hpp"
#include "insitu/shattered_ball.hpp"

namespace ejecta {
namespace {

void own_handler(int) {}

class Ball : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = fresh_folder("ball");
    std::ofstream(folder + "/mine.py") << "# script-version: 2.0\n"
                                          "from paraview.simple import *\n"
                                          "from paraview import catalyst\n"
                                          "particles = PVTrivialProducer(registrationName='particles')\n"
                                          "view = CreateView('RenderView')\n"
                                          "Show(particles, view).Representation = 'Points'\n"
                                          "png = CreateExtractor('PNG', view, registrationName='PNG1')\n"
                                          "png.Writer.FileName = 'mine_{timestep:06d}.png'\n"
                                          "png.Writer.ImageResolution = [320, 240]\n"
                                          "options = catalyst.Options()\n";
    std::ofstream(folder + "/fails.py") << "# script-version: 2.0\n"
                                           "from paraview import catalyst\n"
                                           "options = catalyst.Options()\n"
                                           "def catalyst_execute(info):\n"
                                           "    raise ValueError('out of luck')\n";
    std::ofstream(folder + "/exits.py") << "# script-version: 2.0\n"
                                           "import sys\n"
                                           "from paraview import catalyst\n"
                                           "options = catalyst.Options()\n"
                                           "def catalyst_execute(info):\n"
                                           "    sys.exit(7)\n";
    // A writer of VTK that is given what it cannot write: no exception, only an error of VTK.
    std::ofstream(folder + "/writes_nothing.py") << "# script-version: 2.0\n"
                                                    "from paraview.simple import *\n"
                                                    "from paraview import catalyst\n"
                                                    "source = PVTrivialProducer(registrationName='particles')\n"
                                                    "out = CreateExtractor('VTPD', source, registrationName='VTPD1')\n"
                                                    "out.Trigger = 'TimeStep'\n"
                                                    "out.Writer.FileName = 'p_{timestep:06d}.vtpd'\n"
                                                    "options = catalyst.Options()\n";
    std::vector<std::string> scripts = default_pipelines(scene_with(true));
    scripts.insert(scripts.begin(),
                   {folder + "/fails.py", folder + "/mine.py", folder + "/exits.py", folder + "/writes_nothing.py"});
    check_pipeline_scripts(plain_pipelines(scripts));
    signal(SIGINT, own_handler);
    const ShatteredBall young(3000, 20, 100, 0.1), old(3000, 20, 100, 0.3);
    CatalystBridge bridge(plain_pipelines(scripts), young.settings(folder));
    for (const std::string& channel : young.settings(folder).channels)
      if (bridge.reads(channel.c_str())) read.insert(channel);
    first = bridge.execute(0, 0, young.channels(), every_frame(bridge));
    second = bridge.execute(25, 30e-6, old.channels(), every_frame(bridge));
    repeated = bridge.execute(25, 30e-6, old.channels(), every_frame(bridge));
    counts = bridge.counts();
  }

  static std::string image(const std::string& file) { return folder + "/images/" + file; }

  static inline std::string folder;
  static inline FrameReport first, second, repeated;
  static inline std::set<std::string> read;  ///< channels, before the first frame
  static inline std::vector<PipelineCount> counts;
};

TEST_F(Ball, EveryViewHasAnImageEachFrame) {
  const std::vector<std::string> expected{image("cutaway_000025.png"), image("fragments_000025.png"),
                                          image("mine_000025.png"), image("slice_000025.png"),
                                          image("surface_000025.png")};
  std::vector<std::string> files = second.files;  // in the order of the pipelines
  std::ranges::sort(files);
  EXPECT_EQ(files, expected);
  EXPECT_EQ(first.files.size(), 5u);
}

TEST_F(Ball, ImagesHaveTheSceneSizeAndShowTheObjectWithinTheFrame) {
  for (const char* view : {"cutaway", "fragments", "slice", "surface"})
    for (const char* step : {"_000000.png", "_000025.png"}) {
      SCOPED_TRACE(std::string(view) + step);
      const Picture picture(image(view + std::string(step)));
      EXPECT_EQ(picture.width, 960);
      EXPECT_EQ(picture.height, 720);
      EXPECT_GT(picture.colours(), 60u);
      EXPECT_GT(picture.coloured_share(), 0.06);
      EXPECT_TRUE(picture.band_and_margins_are_clean());
    }
}

TEST_F(Ball, FramesDifferButTheirColourBarsDoNot) {
  const Picture a(image("slice_000000.png")), b(image("slice_000025.png"));
  EXPECT_NE(a.pixels, b.pixels);
  const auto below_panels = a.pixels.begin() + 220 * a.width;  // the bars, with their titles and numbers
  EXPECT_TRUE(std::equal(a.pixels.begin(), below_panels, b.pixels.begin()));
}

TEST_F(Ball, TheTableOfImagesAgreesWithTheFolder) {
  std::ifstream in(image("data.csv"));
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "time,step,view,reason,FILE");
  int rows = 0;
  while (std::getline(in, line)) {
    ++rows;
    EXPECT_TRUE(std::filesystem::exists(image(line.substr(line.rfind(',') + 1)))) << line;
    EXPECT_TRUE(line.rfind("0,0,", 0) == 0 || line.rfind("3e-05,25,", 0) == 0) << line;
  }
  EXPECT_EQ(rows, 10);
}

TEST_F(Ball, AUsersExtractorWritesIntoTheRunFolder) {
  const Picture picture(image("mine_000025.png"));
  EXPECT_EQ(picture.width, 320);
  EXPECT_EQ(picture.height, 240);
}

TEST_F(Ball, FailuresAreReportedAndCountedAndTheOthersGoOn) {
  for (const FrameReport& report : {first, second}) {
    ASSERT_EQ(report.failures.size(), 3u);
    EXPECT_EQ(report.failures[0].text, folder + "/fails.py:5: ValueError: out of luck");
    EXPECT_NE(report.failures[1].text.find("exits.py:6: RuntimeError: the script asked Python to exit, with 7"),
              std::string::npos)
        << report.failures[1].text;
    EXPECT_NE(report.failures[2].text.find("a vtkPartitionedDataSet is required"), std::string::npos)
        << report.failures[2].text;
  }
  ASSERT_EQ(counts.size(), 8u);
  for (std::size_t k = 0; k < counts.size(); ++k) {
    EXPECT_EQ(counts[k].frames, 2) << counts[k].name;
    EXPECT_EQ(counts[k].failures, k == 1 || k > 3 ? 0 : 2) << counts[k].name;
  }
  std::ostringstream log;
  log << std::ifstream(folder + "/insitu.log").rdbuf();
  EXPECT_NE(log.str().find("ValueError: out of luck"), std::string::npos);
}

TEST_F(Ball, TheChannelsThatScriptsReadAreKnownBeforeTheFirstFrame) {
  EXPECT_EQ(read, (std::set<std::string>{"particles", "slice", "volume", "fragments"}));
}

TEST_F(Ball, AStepIsShownOnce) { EXPECT_TRUE(repeated.files.empty()); }

TEST_F(Ball, TheRunsSignalHandlersSurvive) {
  struct sigaction now {};
  sigaction(SIGINT, nullptr, &now);
  EXPECT_EQ(now.sa_handler, own_handler);
}

}  // namespace
}  // namespace ejecta
