#include "insitu/pipelines.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "base/errors.hpp"
#include "insitu/picture.hpp"

namespace ejecta {
namespace {

std::vector<std::string> problems_of(const std::vector<std::string>& paths) {
  try {
    check_pipeline_scripts(plain_pipelines(paths));
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}

TEST(Pipelines, TheDefaultOnesPassTheCheck) {
  EXPECT_EQ(default_pipelines(scene_with(false)).size(), 3u);
  EXPECT_EQ(default_pipelines(scene_with(true)).size(), 4u);
  Scene plane;
  plane.dimension = 2;
  EXPECT_EQ(default_pipelines(plane).size(), 2u);
  EXPECT_TRUE(problems_of(default_pipelines(scene_with(true))).empty());
  Scene grid;
  grid.numerics.scheme = SchemeKind::fvm;
  EXPECT_EQ(default_pipelines(grid).size(), 1u);
}

TEST(Pipelines, TheDefaultOnesMayBeNamedAmongOthers) {
  EXPECT_EQ(pipelines_of(scene_with(true)), plain_pipelines(default_pipelines(scene_with(true))));
  std::vector<Pipeline> expected = plain_pipelines(default_pipelines(scene_with(false)));
  for (Pipeline& pipeline : expected) pipeline.every = "2 us";
  expected.insert(expected.begin(), {"/mine.py", {"a"}, ""});
  expected.push_back({"/yours.py", {}, "step"});
  Scene scene = scene_with(false);
  scene.insitu.pipelines = {{"/mine.py", {"a"}, ""}, {"default", {}, "2 us"}, {"/yours.py", {}, "step"}};
  EXPECT_EQ(pipelines_of(scene), expected);
}

TEST(Pipelines, ASyntaxErrorIsNamedWithFileAndLine) {
  const std::string path = fresh_folder("syntax") + "/bad.py";
  std::ofstream(path) << "# script-version: 2.0\nx = 1\ndef f(:\n";
  const auto problems = problems_of({path});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].rfind(path + ":3: ", 0), 0u) << problems[0];
}

TEST(Pipelines, NothingOfAScriptIsRunByTheCheck) {
  const std::string folder = fresh_folder("not_run"), path = folder + "/writes.py";
  std::ofstream(path) << "# script-version: 2.0\nopen('" << folder << "/trace', 'w')\n";
  EXPECT_TRUE(problems_of({path}).empty());
  EXPECT_FALSE(std::filesystem::exists(folder + "/trace"));
}

TEST(Pipelines, EveryProblemIsReportedAtOnce) {
  const std::string folder = fresh_folder("several"), old_style = folder + "/old.py";
  std::ofstream(old_style) << "def DoCoProcessing(description): pass\n";
  const auto problems = problems_of({folder + "/missing.py", old_style});
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_NE(problems[0].find("missing.py: expected a Catalyst script, found no such file"), std::string::npos);
  EXPECT_NE(problems[1].find("old.py:1: expected the line `# script-version: 2.0`"), std::string::npos);
}

TEST(Pipelines, SettingsAreWrittenAsJson) {
  PipelineSettings s;
  s.run_folder = "/a \"b\"\n";
  s.slice_fields = {"pressure", "sound_speed"};
  s.styles = {{"pressure", {"bulk pressure", ColourMap::cool_warm, ColourRange{-1e6, 2.5e8}, 1e6}}};
  Channel channel;
  channel.fields = {{"pressure", "Pa", {}}, {"sound_speed", "m/s", {}}};
  const std::string json = frame_json(s, std::span(&channel, 1));
  EXPECT_NE(json.find(R"("run_folder":"/a \"b\"\u000a")"), std::string::npos) << json;
  EXPECT_NE(json.find(R"("slice_fields":["pressure","sound_speed"])"), std::string::npos) << json;
  EXPECT_NE(
      json.find(R"("pressure":{"unit":"Pa","label":"bulk pressure","range":[-1000000,250000000],"map":"cool_warm",)"
                R"("linear_to":1000000})"),
      std::string::npos)
      << json;
  EXPECT_NE(
      json.find(R"("sound_speed":{"unit":"m/s","label":"sound speed","range":null,"map":"viridis","linear_to":0})"),
      std::string::npos)
      << json;
}

}  // namespace
}  // namespace ejecta
