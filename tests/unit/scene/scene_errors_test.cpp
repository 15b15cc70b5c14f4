/// One bad input for every message the scene reader can give.
#include <gtest/gtest.h>

#include "unit/scene/scene_text.hpp"

namespace ejecta {
namespace {

struct BadScene {
  std::string label;
  std::string from, to;  ///< replaced in the valid scene; an empty `from` appends
  std::string message;   ///< the only problem
};
void PrintTo(const BadScene& bad, std::ostream* out) { *out << bad.label; }

class RefusesScene : public testing::TestWithParam<BadScene> {};

TEST_P(RefusesScene, WithOneMessage) {
  const BadScene& bad = GetParam();
  std::string text = valid_scene;
  if (bad.from.empty())
    text += bad.to;
  else
    text.replace(text.find(bad.from), bad.from.size(), bad.to);
  EXPECT_EQ(problems_of(text), std::vector<std::string>{bad.message});
}

const std::string kernels = "cubic_spline, quintic_spline, wendland_c2, wendland_c4, gaussian";

INSTANTIATE_TEST_SUITE_P(
    Scene, RefusesScene,
    testing::Values(
        BadScene{"unknown_key", "", "[numerics]\nkernal = 1\n",
                 "s.toml:18: numerics.kernal: unknown key, did you mean numerics.kernel?"},
        BadScene{"hole_too_wide", "radius = \"3 cm\"", "radius = \"3 cm\"\ninner_radius = \"3 cm\"",
                 "s.toml:11: bodies[0].inner_radius: expected less than the radius 30 mm, got 30 mm"},
        BadScene{"formula", "", "[bodies.profile]\nspecific_energy = \"2*q\"\n",
                 "s.toml:18: bodies[1].profile.specific_energy: expected a formula of x, y, z, r, dx and pi, got \"2*q\": "
                 "Unexpected token \"q\" found at position 2."},
        BadScene{"too_few_formulas", "", "[bodies.profile]\nvelocity = [\"x\", \"y\"]\n",
                 "s.toml:18: bodies[1].profile.velocity: expected 3 formulas in 3D, got 2"},
        BadScene{"profile_gives_two_energies", "", "[bodies.profile]\npressure = \"1\"\nspecific_energy = \"1\"\n",
                 "s.toml:18: bodies[1].profile.pressure: expected either pressure or specific_energy, got both"},
        BadScene{"unknown_key_far", "", "[numerics]\nabcdefgh = 1\n", "s.toml:18: numerics.abcdefgh: unknown key"},
        BadScene{"key_of_another_section", "", "[numerics]\nthreads = 1\n",
                 "s.toml:18: numerics.threads: unknown key, did you mean run.threads?"},
        BadScene{"unknown_section", "", "[numeric]\nkernel = \"x\"\nscheme = 3\n",
                 "s.toml:17: numeric: unknown section, did you mean numerics?"},
        BadScene{"value_for_section", "[scene]", "insitu = 3\n[scene]", "s.toml:1: insitu: expected a section, got 3"},
        BadScene{"section_for_value", "end = \"20 us\"", "end = \"20 us\"\nmax_steps = {a = 1}",
                 "s.toml:7: time.max_steps: expected a value, got a section"},
        BadScene{"wrong_unit", "\"20 us\"", "\"20 mm\"",
                 "s.toml:6: time.end: expected a time such as \"20 us\", got \"20 mm\""},
        BadScene{"missing_unit", "\"20 us\"", "20",
                 "s.toml:6: time.end: expected a time such as \"20 us\", got 20 (the unit is missing)"},
        BadScene{"negative", "\"1 mm\"", "\"-1 mm\"",
                 "s.toml:4: resolution.spacing: expected a length such as \"1.2 mm\", > 0, got \"-1 mm\""},
        BadScene{"infinite", "\"1 mm\"", "inf",
                 "s.toml:4: resolution.spacing: expected a length such as \"1.2 mm\", got inf (the unit is missing)"},
        BadScene{"out_of_range", "", "[numerics]\nnodes_per_h = 0.5\n",
                 "s.toml:18: numerics.nodes_per_h: expected a number such as 1.5, from 1 to 4, got 0.5"},
        BadScene{"not_a_number", "", "[numerics]\ncourant = nan\n",
                 "s.toml:18: numerics.courant: expected a number such as 1.5, from 0 to 1, got nan"},
        BadScene{"number_expected", "", "[numerics]\ncourant = true\n",
                 "s.toml:18: numerics.courant: expected a number such as 1.5, got true"},
        BadScene{"not_whole", "", "[insitu]\nframes = 2.5\n",
                 "s.toml:18: insitu.frames: expected a whole number, >= 2, got 2.5"},
        BadScene{"too_few_frames", "", "[insitu]\nframes = 1\n",
                 "s.toml:18: insitu.frames: expected a whole number, >= 2, got 1"},
        BadScene{"not_a_flag", "", "[insitu]\nenabled = \"yes\"\n",
                 "s.toml:18: insitu.enabled: expected true or false, got \"yes\""},
        BadScene{"not_a_text", "name = \"test\"", "name = 3", "s.toml:2: scene.name: expected a text in quotes, got 3"},
        BadScene{"not_a_list", "", "[insitu]\npipelines = \"mass.py\"\n",
                 "s.toml:18: insitu.pipelines: expected a list such as [\"default\", \"a.py\", {script = \"b.py\", "
                 "every = \"2 "
                 "us\"}], got \"mass.py\""},
        BadScene{
            "not_a_vector", "[0, \"4 cm\", 0]", "[0]",
            "s.toml:15: bodies[1].center: expected two or three components, each a length such as \"1.2 mm\", got [0]"},
        BadScene{"wrong_unit_in_vector", "\"-2.58 km/s\"", "\"-2.58 km\"",
                 "s.toml:16: bodies[1].velocity: expected a speed such as \"5 km/s\", got \"-2.58 km\""},
        BadScene{"not_a_word", "", "[numerics]\nkernel = \"wendland\"\n",
                 "s.toml:18: numerics.kernel: expected one of " + kernels + ", got \"wendland\""},
        BadScene{"misspelt_word", "", "[numerics]\nkernel = \"wendland_c3\"\n",
                 "s.toml:18: numerics.kernel: expected one of " + kernels +
                     ", got \"wendland_c3\", did you mean wendland_c2?"},
        BadScene{"riemann_in_single", "", "[numerics]\nscheme = \"gsph\"\nprecision = \"mixed\"\n",
                 "s.toml:19: numerics.precision: expected double with scheme gsph, got mixed"},
        BadScene{"gaussian_alone", "", "[numerics]\nkernel = \"gaussian\"\n",
                 "s.toml:18: numerics.kernel: expected scheme gsph, agsph or hybrid with gaussian, got sph"},
        BadScene{"pilot_in_a_hybrid", "", "[numerics]\nscheme = \"hybrid\"\npilot_width = 2.5\n",
                 "s.toml:19: numerics.pilot_width: expected scheme gsph with it, got hybrid"},
        BadScene{"space_filled_by_a_hybrid", "", "[numerics]\nscheme = \"hybrid\"\nfill_space = true\n",
                 "s.toml:19: numerics.fill_space: expected scheme gsph or agsph with it, got hybrid"},
        BadScene{"space_filled_by_continuity", "",
                 "[numerics]\nscheme = \"gsph\"\nfill_space = true\ndensity = \"continuity\"\n",
                 "s.toml:19: numerics.fill_space: expected density summation with it, got continuity"},
        BadScene{"pilot_with_continuity", "",
                 "[numerics]\nscheme = \"gsph\"\npilot_width = 2.5\ndensity = \"continuity\"\n",
                 "s.toml:19: numerics.pilot_width: expected density summation with it, got continuity"},
        BadScene{"conduction_with_viscosity", "", "[numerics]\nlinear_conduction = 0.1\n",
                 "s.toml:18: numerics.linear_conduction: expected scheme gsph, agsph or hybrid with it, got sph"},
        BadScene{"riemann_with_viscosity", "", "[numerics]\nscheme = \"agsph\"\nshock_switch = true\n",
                 "s.toml:19: numerics.shock_switch: scheme agsph has none"},
        BadScene{
            "empty_range", "", "[insitu.ranges]\ndamage = [1, 1]\n",
            "s.toml:18: insitu.ranges.damage: expected a smallest and a larger value such as [0, 1] or [\"-1 MPa\", "
            "\"1 GPa\"], got [1, 1]"},
        BadScene{"date", "", "[random]\nseed = 2020-01-01\n",
                 "s.toml:18: random.seed: expected a text, number, true, false or a list of them, got a date"},
        BadScene{"toml_syntax", "[time]", "[time",
                 "s.toml:5: not valid TOML: Error while parsing table header: expected ']', saw '\\n'"},
        BadScene{"missing_value", "spacing = \"1 mm\"", "",
                 "s.toml:3: resolution.spacing: missing: distance between particles at the start"},
        BadScene{"value_for_material", "", "[materials]\nbasalt = 3\n",
                 "s.toml:18: materials.basalt: expected a section, got 3"},
        BadScene{"unused_material", "", "[materials.iron.eos]\nA = 3\n",
                 "s.toml:18: materials.iron: no body is made of it"},
        BadScene{"same_name", "name = \"projectile\"", "name = \"target\"",
                 "s.toml:12: bodies[1].name: expected a name of its own, got \"target\" again"},
        BadScene{"bad_name", "name = \"test\"", "name = \"a/b\"",
                 "s.toml:2: scene.name: expected letters, digits, _ and -, got \"a/b\""},
        BadScene{"shape_needs_size", "radius = \"3 cm\"", "", "s.toml:7: bodies[0].radius: missing: a sphere needs it"},
        BadScene{"shape_has_no_size", "radius = \"3 cm\"", "radius = \"3 cm\"\nlength = \"1 cm\"",
                 "s.toml:11: bodies[0].length: a sphere has none"},
        BadScene{"shape_of_2d", "radius = \"3 cm\"", "radius = \"3 cm\"\nshape = \"disc\"",
                 "s.toml:11: bodies[0].shape: expected sphere, box or cylinder in 3D, got \"disc\""},
        BadScene{"flat_box", "radius = \"3 cm\"", "size = [\"1 cm\", 0, \"1 cm\"]\nshape = \"box\"",
                 "s.toml:10: bodies[0].size: expected 3 lengths > 0"},
        BadScene{"body_too_small", "radius = \"3 cm\"", "radius = \"0.4 mm\"",
                 "s.toml:10: bodies[0].radius: expected at least one particle across, got 800 um at a spacing of 1 mm"},
        BadScene{"no_axis", "radius = \"3 cm\"", "radius = \"3 cm\"\naxis = [0, 0, 0]",
                 "s.toml:11: bodies[0].axis: expected a direction, got [0, 0, 0]"},
        BadScene{"energy_and_pressure", "radius = \"3 cm\"",
                 "radius = \"3 cm\"\npressure = \"1 Pa\"\nspecific_energy = \"1 J/kg\"",
                 "s.toml:11: bodies[0].pressure: expected either pressure or specific_energy, got both"},
        BadScene{"detonator_nowhere", "", "[[detonators]]\ntime = \"1 us\"\n",
                 "s.toml:17: detonators[0].position: missing: the point, one end of the line, or a point of the plane"},
        BadScene{"line_without_end", "", "[[detonators]]\nshape = \"line\"\nposition = [0, 0, 0]\n",
                 "s.toml:17: detonators[0].end: missing: a line needs it"},
        BadScene{"line_without_length", "",
                 "[[detonators]]\nshape = \"line\"\nposition = [0, 0, \"1 mm\"]\nend = [0, 0, \"1 mm\"]\n",
                 "s.toml:20: detonators[0].end: expected another place than position"},
        BadScene{"plane_without_direction", "",
                 "[[detonators]]\nshape = \"plane\"\nposition = [0, 0, 0]\nnormal = [0, 0, 0]\n",
                 "s.toml:20: detonators[0].normal: expected a direction, got [0, 0, 0]"},
        BadScene{"point_with_normal", "", "[[detonators]]\nposition = [0, 0, 0]\nnormal = [0, 0, 1]\n",
                 "s.toml:19: detonators[0].normal: a point has none"},
        BadScene{"boundary_without_box", "", "[boundary]\nx = \"periodic\"\n",
                 "s.toml:18: boundary.x: needs boundary.min along x"},
        BadScene{"face_without_place", "", "[boundary]\nx_max = \"symmetry\"\nmin = [0, 0, 0]\n",
                 "s.toml:18: boundary.x_max: needs boundary.max along x"},
        BadScene{"half_periodic", "", "[boundary]\nz = \"periodic\"\nz_max = \"open\"\nmin = [0, 0, 0]\n",
                 "s.toml:18: boundary.z: expected both faces to be periodic or none, got periodic and open"},
        BadScene{"boundary_inside_out", "",
                 "[boundary]\ny = \"periodic\"\nmin = [0, \"1 m\", 0]\nmax = [0, \"-1 m\", 0]\n",
                 "s.toml:18: boundary.y: expected boundary.min < boundary.max along y, got 1 m and -1 m"},
        BadScene{"missing_pipeline", "", "[insitu]\npipelines = [\"no.py\"]\n",
                 "s.toml:18: insitu.pipelines[0].script: expected a script, got \"no.py\": no such file no.py, "
                 "nor " EJECTA_SOURCE_DIR "/catalyst_scripts/no.py"}),
    [](const auto& info) { return info.param.label; });

TEST(RefusesScenes, TwoDimensional) {
  const std::string text = R"([scene]
name = "flat"
dimension = 2
[resolution]
spacing = "1 mm"
[time]
end = "1 us"
[[bodies]]
name = "a"
material = "basalt"
radius = "1 cm"
[[bodies]]
name = "b"
material = "basalt"
shape = "disc"
radius = "1 cm"
velocity = [0, 0, "1 m/s"]
[boundary]
z = "periodic"
[[detonators]]
position = [0, 0, "1 mm"]
)";
  EXPECT_EQ(problems_of(text),
            (std::vector<std::string>{"s.toml:8: bodies[0].shape: expected disc or rectangle in 2D, got \"sphere\"",
                                      "s.toml:17: bodies[1].velocity: expected no z component in 2D",
                                      "s.toml:19: boundary.z: expected open in 2D",
                                      "s.toml:21: detonators[0].position: expected no z component in 2D"}));
}

TEST(RefusesScenes, WithoutBodies) {
  const std::string text = "[scene]\nname = \"x\"\n[resolution]\nspacing = \"1 mm\"\n[time]\nend = \"1 us\"\n";
  EXPECT_EQ(problems_of(text),
            std::vector<std::string>{"s.toml: bodies: expected at least one, each written under [[bodies]]"});
  EXPECT_EQ(problems_of(text + "[bodies]\nname = \"a\"\n"),
            std::vector<std::string>{"s.toml:7: bodies: expected at least one, each written under [[bodies]]"});
}

TEST(RefusesScenes, ThatAreMissing) {
  EXPECT_THROW(
      try { read_scene("no/such.toml"); } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "no/such.toml: no such file");
        throw;
      },
      InputError);
}

TEST(RefusesScenes, WithAllProblemsInTheOrderOfTheLines) {
  std::string text = valid_scene + "[numerics]\nkernal = 1\n";
  text.replace(text.find("\"1 mm\""), 6, "\"1 s\"");
  text.replace(text.find("\"20 us\""), 7, "20");
  const std::vector<std::string> problems = problems_of(text, {"insitu.frames=0"});
  ASSERT_EQ(problems.size(), 4u);
  EXPECT_TRUE(problems[0].starts_with("s.toml:4: resolution.spacing:"));
  EXPECT_TRUE(problems[1].starts_with("s.toml:6: time.end:"));
  EXPECT_TRUE(problems[2].starts_with("s.toml:18: numerics.kernal:"));
  EXPECT_EQ(problems[3], "--set insitu.frames: expected a whole number, >= 2, got 0");
}

TEST(RefusesOverrides, WithTheirKey) {
  const auto problem = [](const std::string& assignment) { return problems_of(valid_scene, {assignment}); };
  using One = std::vector<std::string>;
  EXPECT_EQ(problem("time.end"), One{"--set time.end: expected key=value such as time.end=20us"});
  EXPECT_EQ(problem("=3"), One{"--set =3: expected key=value such as time.end=20us"});
  EXPECT_EQ(problem("time.end="), One{"--set time.end=: expected key=value such as time.end=20us"});
  EXPECT_EQ(problem("time.end=20"),
            One{"--set time.end: expected a time such as \"20 us\", got 20 (the unit is missing)"});
  EXPECT_EQ(problem("time.ende=20us"), One{"--set time.ende: unknown key, did you mean time.end?"});
  EXPECT_EQ(problem("end=20us"), One{"--set end: unknown key, did you mean time.end?"});
  EXPECT_EQ(problem("bodies.moon.radius=1m"),
            One{"--set bodies.moon.radius: expected one of the bodies \"target\", \"projectile\""});
  EXPECT_EQ(problem("bodies[2].radius=1m"),
            One{"--set bodies[2].radius: expected one of the bodies \"target\", \"projectile\""});
  EXPECT_EQ(problem("bodies.target.radius=1s"),
            One{"--set bodies.target.radius: bodies[0].radius: expected a length such as \"1.2 mm\", got \"1s\""});
}

}  // namespace
}  // namespace ejecta
