#include "reference/charge_start.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/errors.hpp"
#include "material/material_reader.hpp"
#include "scene/scene_reader.hpp"

namespace ejecta {
namespace {

std::string blast(const std::string& charge = "", const std::string& more = "") {
  return R"([scene]
name = "b"
dimension = 2
[resolution]
spacing = "20 cm"
[time]
end = "1 ms"
[charge]
center = ["1 m", "2 m"]
radius = "0.5 m"
density = "1000 kg/m^3"
energy_per_length = "4.184e12 J/m"
)" + charge +
         R"(
[gas]
density = "1.225 kg/m^3"
pressure = "102 kPa"
[numerics]
scheme = "gsph"
)" + more;
}

const std::string box = "[boundary]\nmin = [\"-50 m\", \"-50 m\"]\nmax = [\"50 m\", \"50 m\"]\n";

/// A scene that lives as long as what is asked about it.
struct Blast {
  explicit Blast(const std::string& text)
      : scene(parse_scene(text, "s.toml")),
        materials(read_materials(scene, std::string(EJECTA_SOURCE_DIR) + "/inputs/materials")),
        start(charge_start(scene, materials.list)) {}
  Scene scene;
  Materials materials;
  std::optional<RadialState> start;
};

std::string refusal(const std::string& text) {
  try {
    const Blast blast(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ChargeStart, WaitsUntilTheShockHasComeSixteenSpacings) {
  const Blast b(blast("", box));
  ASSERT_TRUE(b.start);
  EXPECT_NEAR(b.start->radius(), 3.2, 0.3);  // and what lies ahead of it
  EXPECT_GT(b.start->time, 18e-6);           // 2.8 m (docs/results.md)
  EXPECT_LT(b.start->time, 25e-6);
  EXPECT_GT(b.start->charge_radius, 2);
}

TEST(ChargeStart, HoldsTheMassAndTheEnergyOfTheChargeAndOfTheGas) {
  const Blast b(blast("start = \"40 us\"\n", box));
  ASSERT_TRUE(b.start);
  EXPECT_EQ(b.start->time, 40e-6);
  double mass = 0, energy = 0;
  for (std::size_t i = 0; i < b.start->density.size(); ++i) {
    const double r = static_cast<double>(i) * b.start->spacing, dr = b.start->spacing;
    const double m = b.start->density[i] * std::numbers::pi * (2 * r + dr) * dr;
    mass += m;
    energy += m * (b.start->specific_energy[i] + 0.5 * b.start->velocity[i] * b.start->velocity[i]);
  }
  const double r = b.start->radius(), swept = std::numbers::pi * (r * r - 0.25);
  EXPECT_NEAR(mass, 250 * std::numbers::pi + 1.225 * swept, 1e-9 * mass);
  EXPECT_NEAR(energy, 4.184e12 + 102e3 / 0.4 * swept, 1e-9 * energy);
}

TEST(ChargeStart, IsNoLaterThanTheFirstOutput) {
  const Blast b(blast("", box + "[output]\ntimes = [\"1 ms\", \"12 us\"]\n"));
  ASSERT_TRUE(b.start);
  EXPECT_EQ(b.start->time, 12e-6);
}

TEST(ChargeStart, LeavesTheRunSomethingToDo) {
  Blast b(blast("", box));
  b.scene.time_end = 100e-6;
  EXPECT_NEAR(charge_start(b.scene, b.materials.list)->time, 10e-6, 1e-12);
}

TEST(ChargeStart, LeavesAloneWhatItCannotOrNeedNot) {
  EXPECT_FALSE(Blast(blast("start = \"0 s\"\n", box)).start);
  // As wide as sixteen spacings.
  Blast fine(blast("", box));
  fine.scene.spacing = 0.05;
  EXPECT_FALSE(charge_start(fine.scene, fine.materials.list));
  // A wall, a body.
  EXPECT_FALSE(
      Blast(
          blast("", "[boundary]\nmin = [\"-0.4 m\", \"-50 m\"]\nmax = [\"50 m\", \"50 m\"]\nx_min = \"reflecting\"\n"))
          .start);
  const std::string block = R"([[bodies]]
name = "block"
material = "air"
shape = "disc"
center = ["2.5 m", "2 m"]
radius = "0.5 m"
density = "5 kg/m^3"
pressure = "102 kPa"
)";
  EXPECT_FALSE(Blast(blast("", box + block)).start);
}

TEST(ChargeStart, GoesOnBesideAPlaneOfSymmetryThroughTheCharge) {
  EXPECT_TRUE(
      Blast(blast("", "[boundary]\nmin = [\"1 m\", \"-50 m\"]\nmax = [\"50 m\", \"50 m\"]\nx_min = \"symmetry\"\n"))
          .start);
}

TEST(ChargeStart, RefusesATimeAtWhichTheWaveHasMetSomething) {
  EXPECT_NE(
      refusal(blast("start = \"2 ms\"\n", box)).find("charge.start: expected a time before the end, 1 ms, got 2 ms"),
      std::string::npos);
  const std::string wall =
      "[boundary]\nmin = [\"-4 m\", \"-50 m\"]\nmax = [\"50 m\", \"50 m\"]\nx_min = \"reflecting\"\n";
  EXPECT_NE(
      refusal(blast("start = \"100 us\"\n", wall)).find("charge.start: expected a time at which the wave has met"),
      std::string::npos);
}

}  // namespace
}  // namespace ejecta
