#include "sph/outset.hpp"

#include <gtest/gtest.h>

#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

/// A scene of bodies of these names; driven ones begin with "grip".
std::size_t target_of(std::vector<std::pair<std::string, BodyAtOutset>> bodies, const std::string& named = "") {
  Scene scene;
  std::vector<BodyAtOutset> outset;
  for (const auto& [name, body] : bodies) {
    scene.bodies.emplace_back().name = name;
    outset.push_back(body);
  }
  scene.fragments.target = named;
  return target_body(scene, outset);
}

TEST(Outset, TheBodyStruckIsTheHeaviestAtRest) {
  EXPECT_EQ(target_of({{"ball", {9, {0, 0, -1}}}, {"plate", {1, {0, 0, 0}}}, {"rock", {2, {0, 0, 0}}}}), 2u);
  EXPECT_EQ(target_of({{"ball", {9, {0, 0, -1}}}, {"rock", {2, {1e-17, 0, 0}}}}), 1u);  // a spinning body's sum
}

TEST(Outset, WithoutOneAtRestItIsTheSlowestAboutTheCentreOfMass) {
  EXPECT_EQ(target_of({{"ball", {1, {0, 0, -1}}}, {"rock", {50, {0, 0, 6}}}}), 1u);
  EXPECT_EQ(target_of({{"left", {1, {1, 0, 0}}}, {"right", {1, {-1, 0, 0}}}}), 0u);
}

TEST(Outset, GripsAndGasesAreLeftOutUnlessNamed) {
  const BodyAtOutset air{90, {0, 0, 0}, false}, ball{1, {3, 0, 0}, true};
  EXPECT_EQ(target_of({{"air", air}, {"ball", ball}}), 1u);
  EXPECT_EQ(target_of({{"air", air}, {"ball", ball}}, "air"), 0u);
  EXPECT_EQ(target_of({{"air", air}}), 0u);
}

const std::string ring = R"([scene]
name = "ring"
dimension = 2
[resolution]
spacing = "1 mm"
[time]
end = "20 us"
[[bodies]]
name = "ring"
material = "steel_304"
shape = "disc"
inner_radius = "8 mm"
radius = "10 mm"
[bodies.profile]
velocity = ["200*x/r", "200*y/r"]
)";

TEST(Outset, SpeedsOfAProfileGiveTheScaleOfPressure) {
  const auto sim = start<2>(ring);
  EXPECT_NEAR(sim->outset.speed, 200, 1e-9);
  EXPECT_LT(sim->outset.bodies[0].velocity.norm(), 1e-9);
  // A tenth of rho u c with 7900 kg/m^3, 200 m/s and some 5.8 km/s.
  EXPECT_GT(sim->outset.pressure, 0.5e9);
  EXPECT_LT(sim->outset.pressure, 1.5e9);
}

TEST(Outset, WhatMovesAsAWholeIsNotExpectedToBePressed) {
  const auto sim = start<2>(ring, {"bodies.ring.profile.velocity=[\"200\", \"0\"]"});
  EXPECT_NEAR(sim->outset.speed, 200, 1e-9);
  EXPECT_LT(sim->outset.pressure, 1e3);
}

TEST(Outset, WhatMovesTowardsAWallIsExpectedToBePressed) {
  std::vector<std::string> overrides{"bodies.ring.profile.velocity=[\"200\", \"0\"]", "boundary.x_max=reflecting",
                                     "boundary.max=[\"11 mm\", \"0 mm\"]"};
  EXPECT_NEAR(start<2>(ring, overrides)->outset.pressure, start<2>(ring)->outset.pressure, 0.5e9);
  overrides[0] = "bodies.ring.profile.velocity=[\"0\", \"200\"]";  // it only moves along
  EXPECT_LT(start<2>(ring, overrides)->outset.pressure, 1e3);
  // Of a liquid that is all at one speed nothing is known, and what a sum has rounded is nothing.
  overrides = {"bodies.ring.profile.velocity=[\"200/3\", \"100/7\"]", "bodies.ring.material=water"};
  EXPECT_EQ(start<2>(ring, overrides)->outset.pressure, 0);
}

TEST(Outset, PiecesOfMatterWithoutDamageAreRemarkedOn) {
  const auto text = [](const std::vector<std::string>& overrides) {
    const auto remarks = start<2>(ring, overrides)->remarks_at_start();
    return remarks.empty() ? "" : remarks[0].text;
  };
  const std::string asked = "fragments.enabled=true";
  EXPECT_EQ(text({asked, "bodies.ring.material=steel_4340"}),
            "fragments of ring: steel_4340 has no damage: where it comes apart is decided by particles that lose their "
            "neighbours, not by cracks");
  EXPECT_EQ(text({"bodies.ring.material=steel_4340"}), "");
  EXPECT_EQ(text({asked, "bodies.ring.material=basalt"}), "");
  EXPECT_EQ(text({asked, "bodies.ring.material=rubber"}), "");
}

TEST(Outset, GasGivesTheLargestPressureThereIs) {
  const auto sim = start<2>(gas_tube);
  EXPECT_NEAR(sim->outset.pressure, 1, 0.05);
  EXPECT_FALSE(sim->outset.bodies[0].may_be_target);
  EXPECT_EQ(pieces_of_bodies(sim->scene, sim->materials, sim->body_material), (std::vector<std::int32_t>{-1, -1}));
}

}  // namespace
}  // namespace ejecta
