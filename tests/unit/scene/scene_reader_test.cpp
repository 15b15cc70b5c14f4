#include "scene/scene_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "scene/describe.hpp"
#include "scene/names.hpp"
#include "unit/scene/scene_text.hpp"

namespace ejecta {
namespace {

TEST(ReadScene, ConvertsAndKeepsDefaults) {
  const Scene scene = parse_scene(valid_scene, "s.toml");
  EXPECT_EQ(scene.name, "test");
  EXPECT_EQ(scene.file, "s.toml");
  EXPECT_EQ(scene.spacing, 1e-3);
  EXPECT_EQ(scene.time_end, 20e-6);
  ASSERT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(scene.bodies[1].velocity, (Triple{0, -2580, 0}));
  EXPECT_EQ(scene.bodies[1].center, (Triple{0, 0.04, 0}));
  EXPECT_FALSE(is_set(scene.bodies[0].density));
  EXPECT_EQ(scene.numerics.kernel, Kernel::wendland_c2);
  EXPECT_EQ(scene.numerics.nodes_per_h, 1.3);
}

TEST(ReadScene, RiemannProblemsTakeSummedDensitiesUnlessAskedOtherwise) {
  const auto density = [](const std::string& numerics) {
    return parse_scene(valid_scene + "[numerics]\n" + numerics, "s.toml").numerics.density;
  };
  EXPECT_EQ(density("scheme = \"sph\"\n"), DensityMethod::continuity);
  EXPECT_EQ(density("scheme = \"gsph\"\n"), DensityMethod::summation);
  EXPECT_EQ(density("scheme = \"gsph\"\ndensity = \"continuity\"\n"), DensityMethod::continuity);
  EXPECT_EQ(density("scheme = \"gsph\"\npilot_width = 2.5\n"), DensityMethod::summation);
  EXPECT_EQ(density("scheme = \"hybrid\"\n"), DensityMethod::summation);
}

TEST(ReadScene, ReadsEveryKindOfValue) {
  const Scene scene = parse_scene(valid_scene + R"(
[numerics]
kernel = "quintic_spline"
precision = "mixed"
balsara = true
courant = 0.3
[insitu]
column_density = true
on_error = "abort"
[insitu.ranges]
pressure = ["-1 MPa", "2 GPa"]
damage = [0, 1]
[run]
threads = 3
[random]
seed = 12345678901
)",
                                  "s.toml");
  EXPECT_EQ(scene.numerics.kernel, Kernel::quintic_spline);
  EXPECT_EQ(scene.numerics.precision, Precision::mixed);
  EXPECT_EQ(scene.numerics.balsara, Switch::on);
  EXPECT_TRUE(scene.insitu.column_density);
  EXPECT_EQ(scene.insitu.on_error, OnError::abort);
  EXPECT_EQ(scene.insitu.ranges.at("pressure").min, -1e6);
  EXPECT_EQ(scene.insitu.ranges.at("pressure").max, 2e9);
  EXPECT_EQ(scene.insitu.ranges.size(), 2u);
  EXPECT_EQ(scene.threads, 3);
  EXPECT_EQ(scene.seed, 12345678901u);
}

TEST(Overrides, NeedNoQuotesAndReachWhatTheFileLeavesOut) {
  const Scene scene = parse_scene(valid_scene, "s.toml",
                                  {"time.end=30us", "insitu.enabled=false", "numerics.precision=mixed", "run.threads=2",
                                   "resolution.spacing=0.8 mm", "scene.title=A \"title\"", "numerics.nodes_per_h=1.5",
                                   "random.seed=7", "insitu.frames=9", "insitu.ranges.pressure=[0, \"1 MPa\"]"});
  EXPECT_EQ(scene.time_end, 30e-6);
  EXPECT_FALSE(scene.insitu.enabled);
  EXPECT_EQ(scene.numerics.precision, Precision::mixed);
  EXPECT_EQ(scene.threads, 2);
  EXPECT_EQ(scene.spacing, 0.8e-3);
  EXPECT_EQ(scene.title, "A \"title\"");
  EXPECT_EQ(scene.numerics.nodes_per_h, 1.5);
  EXPECT_EQ(scene.seed, 7u);
  EXPECT_EQ(scene.insitu.frames, 9);
  EXPECT_EQ(scene.insitu.ranges.at("pressure").max, 1e6);
}

TEST(Overrides, FindBodiesByIndexAndName) {
  const Scene scene = parse_scene(
      valid_scene, "s.toml",
      {"bodies[0].radius=2cm", "bodies.projectile.velocity=0 -3 0 km/s", "bodies.target.velocity=[\"1 m/s\", 0, 0]"});
  EXPECT_EQ(scene.bodies[0].radius, 0.02);
  EXPECT_EQ(scene.bodies[1].velocity, (Triple{0, -3000, 0}));
  EXPECT_EQ(scene.bodies[0].velocity, (Triple{1, 0, 0}));
}

TEST(Overrides, TheLastOneWins) {
  EXPECT_EQ(parse_scene(valid_scene, "s.toml", {"time.end=1us", "time.end=2us"}).time_end, 2e-6);
}

TEST(Overrides, OfMaterialsAreKeptForTheMaterialReader) {
  const Scene scene = parse_scene(valid_scene + "[materials.basalt.eos]\nA = \"20 GPa\"\n", "s.toml",
                                  {"materials.nylon.strength.yield_stress=1 MPa"});
  EXPECT_EQ(to_text(scene.materials.at("basalt").items.at("eos.A").literal), "\"20 GPa\"");
  EXPECT_EQ(scene.materials.at("basalt").items.at("eos.A").origin.text, "s.toml:18");
  EXPECT_EQ(scene.materials.at("nylon").items.at("strength.yield_stress").origin.text,
            "--set materials.nylon.strength.yield_stress");
}

TEST(SceneToml, ReadsBackAsTheSameScene) {
  for (const std::string& text :
       {valid_scene,
        valid_scene + "[insitu]\ncolumn_density = true\n[insitu.ranges]\npressure = [0.1, 0.30000000000000004]\n"}) {
    const Scene scene =
        parse_scene(text, "s.toml", {"scene.title=quo\"te \\ and tab\t", "bodies.target.center=0.1 0.2 0.3 um"});
    const std::string echo = scene_toml(scene);
    const Scene again = parse_scene(echo, "resolved.toml");
    EXPECT_EQ(scene_toml(again), echo);
    EXPECT_EQ(again.title, scene.title);
    EXPECT_EQ(again.bodies[0].center, scene.bodies[0].center);
    EXPECT_EQ(again.numerics.distension_tolerance, 1e-12);
  }
}

TEST(Boundary, FacesAreSaidTogetherOrOneByOne) {
  const auto read = [](const std::string& boundary) {
    return parse_scene(valid_scene + "[boundary]\n" + boundary, "s.toml");
  };
  using enum BoundaryKind;
  const std::array<BoundaryKind, 3> walls{reflecting, open, open}, none{};
  const Scene both = read("x = \"reflecting\"\nmin = [0, 0, 0]\nmax = [\"1 m\", 0, 0]\n");
  EXPECT_EQ(both.boundary.lower, walls);
  EXPECT_EQ(both.boundary.upper, walls);
  const Scene floor = read("x_min = \"reflecting\"\nmin = [0, 0, 0]\n");
  EXPECT_EQ(floor.boundary.lower, walls);
  EXPECT_EQ(floor.boundary.upper, none);
  const Scene except = read("x_max = \"open\"\nx = \"reflecting\"\nmin = [0, 0, 0]\n");  // in any order
  EXPECT_EQ(except.boundary.upper, none);
  for (const Scene& scene : {both, floor, except}) {
    const std::string echo = scene_toml(scene);
    EXPECT_EQ(scene_toml(parse_scene(echo, "resolved.toml")), echo);
    const Boundary again = parse_scene(echo, "resolved.toml").boundary;
    EXPECT_EQ(again.lower, scene.boundary.lower);
    EXPECT_EQ(again.upper, scene.boundary.upper);
  }
}

TEST(SceneToml, HasZeroForNotSetWhereZeroHasAlwaysMeantThat) {
  const Scene given =
      parse_scene(valid_scene, "s.toml", {"time.max_steps=9", "run.threads=2", "output.checkpoint_interval=5 s"});
  EXPECT_EQ(given.max_steps, 9);
  EXPECT_EQ(given.threads, 2);
  EXPECT_EQ(given.output.checkpoint_interval, 5);
  const Scene none =
      parse_scene(scene_toml(given), "s.toml", {"time.max_steps=0", "run.threads=0", "output.checkpoint_interval=0"});
  const Scene again = parse_scene(scene_toml(none), "resolved.toml");
  for (const Scene* scene : {&none, &again}) {
    EXPECT_FALSE(scene->max_steps);
    EXPECT_FALSE(scene->threads);
    EXPECT_FALSE(is_set(scene->output.checkpoint_interval));
  }
  EXPECT_NE(scene_toml(none).find("\nmax_steps = 0  #"), std::string::npos);
  EXPECT_EQ(scene_toml(again), scene_toml(none));
}

TEST(SceneToml, HoldsDefaultsInSi) {
  const std::string echo = scene_toml(parse_scene(valid_scene, "s.toml"));
  EXPECT_NE(echo.find("\nspacing = \"0.001 m\"  #"), std::string::npos);
  EXPECT_NE(echo.find("\nkernel = \"wendland_c2\"  #"), std::string::npos);
  EXPECT_NE(echo.find("\n# density: not set;"), std::string::npos);
}

TEST(SceneReference, NamesEveryKeyOfTheEcho) {
  Scene scene = parse_scene(valid_scene, "s.toml");
  Describer description;
  describe(description, scene);
  const std::string reference = scene_reference();
  for (const Setting& setting : description.settings())
    EXPECT_NE(reference.find("\n  " + setting.key + " "), std::string::npos) << setting.path();
}

TEST(SceneReference, CanBeLimitedToOneSection) {
  const std::string insitu = scene_reference("insitu");
  EXPECT_NE(insitu.find("[insitu.ranges]"), std::string::npos);
  EXPECT_NE(insitu.find("default 60"), std::string::npos);
  EXPECT_EQ(insitu.find("[numerics]"), std::string::npos);
  EXPECT_NE(scene_reference("bodies").find("[[bodies]]"), std::string::npos);
  EXPECT_EQ(scene_reference("in"), "");
}

TEST(NameOf, GivesTheWordOfTheScene) {
  EXPECT_EQ(name_of(Precision::double_precision), "double");
  EXPECT_EQ(name_of(Kernel::wendland_c4), "wendland_c4");
}

TEST(SceneReader, KnowsFormerWords) {
  EXPECT_EQ(parse_scene(valid_scene + "[insitu]\non_error = \"continue\"\n", "s.toml").insitu.on_error, OnError::warn);
}

TEST(SceneReader, FindsPipelinesBesideTheSceneAndThenAmongTheShippedOnes) {
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("ejecta_pipelines_{}", ::getpid());
  std::filesystem::create_directories(folder);
  for (const char* name : {"mine.py", "slice.py"}) std::ofstream(folder / name) << "# script-version: 2.0\n";
  const std::string list = "[insitu]\npipelines = [\"default\", \"mine.py\", \"slice.py\", \"ellipses.py\"]\n";
  const Scene scene = parse_scene(valid_scene + list, (folder / "s.toml").string());
  std::filesystem::remove_all(folder);
  std::vector<std::string> found;
  for (const Pipeline& pipeline : scene.insitu.pipelines) found.push_back(pipeline.script);
  EXPECT_EQ(found, (std::vector<std::string>{"default", folder / "mine.py", folder / "slice.py",
                                             EJECTA_SOURCE_DIR "/catalyst_scripts/ellipses.py"}));
}

}  // namespace
}  // namespace ejecta
