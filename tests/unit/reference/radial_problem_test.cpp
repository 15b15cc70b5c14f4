#include "reference/radial_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/errors.hpp"
#include "material/material_reader.hpp"
#include "reference/reference_run.hpp"
#include "scene/scene_reader.hpp"

namespace ejecta {
namespace {

/// A scene that stays where the problem looks for it.
struct Input {
  explicit Input(const std::string& text)
      : scene(parse_scene(text, "s.toml")),
        materials(read_materials(scene, std::string(EJECTA_SOURCE_DIR) + "/inputs/materials")) {}
  RadialProblem problem(std::optional<Geometry> geometry = {}) const {
    return radial_problem(scene, materials.list, geometry);
  }
  Scene scene;
  Materials materials;
};

std::string problem_of(const std::string& text, std::optional<Geometry> geometry = {}) {
  const Input input(text);
  try {
    start_flow(input.problem(geometry), input.problem(geometry).default_spacing);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string blast(int dimension, const std::string& more = "") {
  return "[scene]\nname = \"b\"\ndimension = " + std::to_string(dimension) +
         R"(
[resolution]
spacing = "20 cm"
[time]
end = "1 ms"
[charge]
center = ["1 m", "2 m"]
radius = "0.537 m"
density = "1000 kg/m^3"
)" + (dimension == 2 ? "energy_per_length = \"1e9 J/m\"" : "energy = \"1e9 J\"") +
         R"(
[gas]
density = "1.225 kg/m^3"
pressure = "102 kPa"
[numerics]
scheme = "fvm"
)" + more;
}

const std::string tube = R"([scene]
name = "tube"
dimension = 2
[resolution]
spacing = "1 cm"
[time]
end = "0.1 s"
[[bodies]]
name = "left"
material = "air"
shape = "rectangle"
center = ["-0.25 m", "0 m"]
size = ["0.5 m", "0.1 m"]
density = "1 kg/m^3"
pressure = "1 Pa"
velocity = ["0.5 m/s", "0 m/s"]
[[bodies]]
name = "right"
material = "air"
shape = "rectangle"
center = ["0.25 m", "0 m"]
size = ["0.5 m", "0.1 m"]
density = "0.125 kg/m^3"
pressure = "0.1 Pa"
)";

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const auto place = text.rfind(old);
  EXPECT_NE(place, std::string::npos) << old;
  return text.replace(place, old.size(), replacement);
}

/// Whatever the cells, the charge has its mass and its energy, though its edge lies within a cell.
TEST(RadialProblem, ChargeIsWhole) {
  for (const int dimension : {2, 3}) {
    const Input input(blast(dimension));
    const RadialProblem problem = input.problem();
    EXPECT_EQ(problem.geometry, dimension == 2 ? Geometry::cylindrical : Geometry::spherical);
    ASSERT_TRUE(problem.blast);
    EXPECT_NEAR(problem.blast->energy, 1e9, 1e-6);
    EXPECT_DOUBLE_EQ(problem.blast->ambient_pressure, 102e3);
    EXPECT_DOUBLE_EQ(problem.default_spacing, 0.00537);
    for (const double spacing : {0.00537, 0.05, 0.3}) {
      const RadialFlow flow = start_flow(problem, spacing);
      double mass = 0, energy = 0;
      for (std::size_t i = 0; i < flow.position().size(); ++i) {
        const double r = flow.position()[i];
        const double volume =
            all_directions(problem.geometry) * shell_volume(problem.geometry, r - 0.5 * spacing, r + 0.5 * spacing);
        mass += (flow.density()[i] - 1.225) * volume;
        energy += (flow.density()[i] * flow.specific_energy()[i] - 102e3 / 0.4) * volume;
      }
      const double r = 0.537, volume = std::numbers::pi * r * r * (dimension == 2 ? 1 : 4 * r / 3);
      EXPECT_NEAR(mass, (1000 - 1.225) * volume, 1e-10 * 1000 * volume);
      EXPECT_NEAR(energy, 1e9 - 102e3 / 0.4 * volume, 1e-10 * 1e9);
    }
  }
}

TEST(RadialProblem, BodiesAlongALine) {
  const Input input(with(tube, "density = \"1 kg/m^3\"", "density = \"2 kg/m^3\""));
  const RadialProblem problem = input.problem();
  EXPECT_EQ(problem.geometry, Geometry::planar);
  EXPECT_DOUBLE_EQ(problem.start, -0.5);
  EXPECT_DOUBLE_EQ(problem.end, 0.5);
  EXPECT_EQ(problem.lower, RadialEdge::open);
  EXPECT_DOUBLE_EQ(problem.default_spacing, 0.0025);
  // Two cells of twice the width fill the line too.
  EXPECT_DOUBLE_EQ(fitting_spacing(problem, 0.0101), 0.01);
  // A cell that holds both bodies: momentum and energy are sums, the velocity is that of the sum.
  const RadialFlow flow = start_flow(problem, 0.2);
  ASSERT_EQ(flow.density().size(), 5u);
  EXPECT_NEAR(flow.density()[2], 0.5 * 2.125, 1e-9);
  EXPECT_NEAR(flow.velocity()[2], 1 / 2.125, 1e-9);
  EXPECT_NEAR(flow.velocity()[1], 0.5, 1e-12);
  EXPECT_EQ(flow.velocity()[3], 0);
}

TEST(RadialProblem, FacesOfTheBox) {
  const Input input(tube + R"([boundary]
x_min = "symmetry"
x_max = "open"
min = ["-0.4 m", "-1 m"]
max = ["0.3 m", "1 m"]
)");
  const RadialProblem problem = input.problem();
  EXPECT_DOUBLE_EQ(problem.start, -0.4);
  EXPECT_DOUBLE_EQ(problem.end, 0.3);
  EXPECT_EQ(problem.lower, RadialEdge::mirror);
  EXPECT_EQ(problem.upper, RadialEdge::open);
  const RadialProblem ball = input.problem(Geometry::spherical);
  EXPECT_EQ(ball.start, 0);
  EXPECT_DOUBLE_EQ(ball.end, 0.3 + 0.25);  // from the centre of the first body
  EXPECT_EQ(ball.lower, RadialEdge::mirror);
}

TEST(RadialProblem, SaysWhatIsNoSuchProblem) {
  const auto of_basalt = [](std::string text) {
    const std::string old = "pressure = \"0.1 Pa\"";
    return with(with(std::move(text), "\"air\"", "\"basalt\""),
                text.find(old) == text.npos ? "pressure = \"1 Pa\"" : old, "");
  };
  EXPECT_NE(problem_of(of_basalt(tube)).find("expected one material"), std::string::npos);
  EXPECT_NE(problem_of(of_basalt(of_basalt(tube))).find("which has strength"), std::string::npos);
  EXPECT_NE(problem_of(with(tube, "[\"0.5 m/s\", \"0 m/s\"]", "[\"0.5 m/s\", \"2 m/s\"]")).find("across it"),
            std::string::npos);
  EXPECT_NE(problem_of(with(tube, "[\"0.25 m\", \"0 m\"]", "[\"0.35 m\", \"0 m\"]")).find("none at x = "),
            std::string::npos);
  EXPECT_NE(
      problem_of(blast(2, "[[bodies]]\nname = \"wall\"\nmaterial = \"air\"\nshape = \"disc\"\nradius = \"1 m\"\n"))
          .find("expected none beside"),
      std::string::npos);
  EXPECT_NE(
      problem_of(tube + "[boundary]\nx = \"periodic\"\nmin = [\"-0.5 m\", \"-1 m\"]\nmax = [\"0.5 m\", \"1 m\"]\n",
                 Geometry::cylindrical)
          .find("no periodic faces"),
      std::string::npos);
  EXPECT_EQ(problem_of(tube), "");
}

TEST(ReferenceRun, RiemannsProblemIsFoundAndMet) {
  const Input input(tube);
  const RadialProblem problem = input.problem();
  const auto riemann = riemann_problem(problem);
  ASSERT_TRUE(riemann);
  EXPECT_NEAR(riemann->interface, 0, 1e-9);
  EXPECT_EQ(riemann->left.velocity, 0.5);
  EXPECT_NEAR(riemann->right.pressure, 0.1, 1e-15);
  const double times[] = {0.05, 0.1, 0.6};
  const ReferenceRun coarse = run_reference(problem, 0.01, times), fine = run_reference(problem, 0.005, times);
  ASSERT_EQ(fine.profiles.size(), 3u);
  EXPECT_EQ(fine.profiles[1].time, 0.1);
  const auto a = difference(coarse.profiles[1], 0.01, *riemann), b = difference(fine.profiles[1], 0.005, *riemann);
  ASSERT_TRUE(a && b);
  EXPECT_LT(b->density, 0.004);
  EXPECT_GT(a->density / b->density, 1.6);
  EXPECT_GT(a->velocity / b->velocity, 1.6);
  EXPECT_GT(a->pressure / b->pressure, 1.6);
  EXPECT_FALSE(difference(fine.profiles[2], 0.005, *riemann));  // a wave has reached an end
  const MeanDifference step = difference(coarse.profiles[1], fine.profiles[1]);
  EXPECT_NEAR(step.density, a->density - b->density, 0.5 * a->density);
  const Input periodic(tube +
                       "[boundary]\nx = \"periodic\"\nmin = [\"-0.5 m\", \"-1 m\"]\nmax = [\"0.5 m\", \"1 m\"]\n");
  EXPECT_FALSE(riemann_problem(periodic.problem()));
}

/// A small charge is soon a point source, whose shock has the speed that Sedov says.
TEST(ReferenceRun, ShockIsRecordedWithItsSpeed) {
  const Input input(with(blast(2), "density = \"1000 kg/m^3\"", "density = \"1.225 kg/m^3\""));
  const RadialProblem problem = input.problem();
  const double times[] = {1.03e-3, 3e-3};
  const ReferenceRun run = run_reference(problem, 0.05, times);
  EXPECT_EQ(run.profiles.size(), 2u);
  EXPECT_EQ(run.shocks.size(), 201u);
  const std::size_t k = run.shock_at(1.03e-3);
  EXPECT_EQ(run.shocks[k].time, 1.03e-3);
  EXPECT_EQ(run.shocks.back().time, 3e-3);
  EXPECT_NEAR(run.shock_speed(k), 0.5 * run.shocks[k].radius / run.shocks[k].time, 0.03 * run.shock_speed(k));
  EXPECT_NEAR(run.shock_speed(200), 0.5 * run.shocks[200].radius / 3e-3, 0.06 * run.shock_speed(200));
  EXPECT_LT(std::abs(run.errors.energy), 1e-13);
}

/// A dense charge of 1 kt/m in air: radii computed independently with cells of 2 cm.
TEST(ReferenceRun, DenseChargeOfAKiloton) {
  std::string text = with(blast(2), "0.537 m", "0.5 m");
  const Input input(with(text, "1e9 J/m", "4.184e12 J/m"));
  const double times[] = {18e-6, 56e-6, 100e-6, 225e-6, 631e-6, 1e-3};
  const double radii[] = {2.8170, 6.7443, 10.5930, 18.8828, 35.1664, 45.1328};
  const ReferenceRun run = run_reference(input.problem(), 0.02, times);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(run.shocks[run.shock_at(times[k])].radius, radii[k], 1e-4 * radii[k]);
  EXPECT_NEAR(run.shock_speed(run.shock_at(1e-3)), 23.8e3, 0.1e3);
  EXPECT_LT(std::abs(run.errors.mass), 1e-13);
  EXPECT_LT(std::abs(run.errors.energy), 1e-13);
}

TEST(ReferenceRun, DensityBehindAShock) {
  const double sound = std::sqrt(1.4 * 1e5 / 1.2);
  EXPECT_DOUBLE_EQ(density_behind_shock(1.4, 1.2, 1e5, sound), 1.2);
  EXPECT_NEAR(density_behind_shock(1.4, 1.2, 1e5, 2 * sound), 1.2 * 6 * 4 / (4 + 5), 1e-12);
  EXPECT_NEAR(density_behind_shock(1.4, 1.2, 1e5, 1e6), 7.2, 1e-3);
}

}  // namespace
}  // namespace ejecta
