#include "scene/every.hpp"

#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "scene/scene_reader.hpp"
#include "scene/settings_io.hpp"

namespace ejecta {
namespace {

TEST(Every, ReadsTimeStepsAndWallTime) {
  EXPECT_DOUBLE_EQ(parse_every("2 us").time, 2e-6);
  EXPECT_EQ(parse_every("100 steps").steps, 100);
  EXPECT_EQ(parse_every("step").steps, 1);
  EXPECT_DOUBLE_EQ(parse_every("30 s wall").wall, 30);
  EXPECT_FALSE(is_set(parse_every("30 s wall").time));
}

TEST(Every, RefusesTheRest) {
  for (const char* text :
       {"", "2", "2 m", "0 us", "-1 us", "0 steps", "1.5 steps", "-3 steps", "wall", "soon", "1e999 s"})
    EXPECT_THROW(parse_every(text), InputError) << text;
}

constexpr const char* scene_text = R"([scene]
name = "s"
[resolution]
spacing = "1 mm"
[time]
end = "1 ms"
[[bodies]]
name = "b"
material = "basalt"
radius = "5 cm"
[insitu]
)";

TEST(Pipelines, AreWrittenShortOrAtLengthAndComeBackFromTheEcho) {
  const std::string list = R"(pipelines = ["default", {script = "slice.py", args = ["-a", "b"], every = "2 us"}])";
  const Scene scene = parse_scene(scene_text + list + "\ntimes = \"dense early\"\n", "s.toml");
  ASSERT_EQ(scene.insitu.pipelines.size(), 2u);
  EXPECT_EQ(scene.insitu.pipelines[0], (Pipeline{"default", {}, ""}));
  EXPECT_EQ(scene.insitu.pipelines[1].args, (std::vector<std::string>{"-a", "b"}));
  EXPECT_EQ(scene.insitu.pipelines[1].every, "2 us");
  EXPECT_TRUE(scene.insitu.times.dense_early);
  const Scene again = parse_scene(scene_toml(scene), "echo.toml");
  EXPECT_EQ(again.insitu.pipelines, scene.insitu.pipelines);
  EXPECT_TRUE(again.insitu.times.dense_early);
}

TEST(Pipelines, OnTheCommandLineReplaceThoseOfTheScene) {
  for (const char* list :
       {"pipelines = [\"default\", \"slice.py\"]", "pipelines = [{script = \"default\"}, {script = \"slice.py\"}]",
        "[[insitu.pipelines]]\nscript = \"default\"\n[[insitu.pipelines]]\nscript = \"slice.py\""}) {
    const Scene scene = parse_scene(std::string(scene_text) + list, "s.toml",
                                    {R"(insitu.pipelines=[{script="default", every="3 steps"}])"});
    ASSERT_EQ(scene.insitu.pipelines.size(), 1u) << list;
    EXPECT_EQ(scene.insitu.pipelines[0].every, "3 steps");
  }
}

TEST(Pipelines, MistakesNameTheKey) {
  for (const auto& [list, complaint] :
       {std::pair{"pipelines = [{script = \"slice.py\", every = \"soon\"}]",
                  "insitu.pipelines[0].every: expected a time such as"},
        {"pipelines = [{scrip = \"slice.py\"}]",
         "insitu.pipelines[0].scrip: unknown key, did you mean insitu.pipelines[0].script?"},
        {"pipelines = [3]", "insitu.pipelines: expected a list such as"},
        {"every = [\"2 m\"]", "insitu.every: expected a time such as"},
        {"times = \"early\"", "insitu.times: expected \"dense early\" or a list of times"},
        {"events = [\"contact\"]", "insitu.events: expected some of \"first contact\""},
        {"events = [\"first fragment\"]", "insitu.events: \"first fragment\" needs fragments.enabled = true"}}) {
    try {
      parse_scene(std::string(scene_text) + list, "s.toml");
      ADD_FAILURE() << list;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(complaint), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace ejecta
