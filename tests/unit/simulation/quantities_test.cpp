#include <gtest/gtest.h>

#include <algorithm>

#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

template <int Dim>
Quantities quantities_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  Simulation sim;
  auto sph = start<Dim>(text, overrides);
  sim.scene = sph->scene;
  sim.packages.push_back(std::move(sph));
  return quantities(sim);
}

const Quantity* find(const Quantities& list, const std::string& name) {
  const auto found = std::ranges::find(list, name, &Quantity::name);
  return found == list.end() ? nullptr : &*found;
}

double value(const Quantities& list, const std::string& name) { return std::get<double>(find(list, name)->value); }

TEST(QuantitiesOfARun, AreThoseThatApply) {
  const Quantities gas = quantities_of<2>(gas_tube), rock = quantities_of<3>(porous_impact);
  for (const char* none : {"min distension", "damaged mass fraction", "momentum z", "angular momentum z",
                           "angular momentum error", "external work"})
    EXPECT_EQ(find(gas, none), nullptr) << none;
  for (const char* there : {"min distension", "damaged mass fraction", "momentum z", "angular momentum x",
                            "angular momentum error"})
    EXPECT_NE(find(rock, there), nullptr) << there;
  EXPECT_EQ(find(rock, "external work"), nullptr);
  EXPECT_NE(find(quantities_of<3>(porous_impact, {"bodies.ball.driven=true"}), "external work"), nullptr);
}

TEST(QuantitiesOfARun, CountPerMetreOfDepthInPlaneStrain) {
  const Quantities gas = quantities_of<2>(gas_tube), rock = quantities_of<3>(porous_impact);
  EXPECT_EQ(find(gas, "kinetic energy")->unit, "J/m");
  EXPECT_EQ(find(gas, "mass")->unit, "kg/m");
  EXPECT_EQ(find(gas, "momentum x")->unit, "kg/s");
  EXPECT_EQ(find(rock, "kinetic energy")->unit, "J");
  EXPECT_EQ(find(rock, "angular momentum x")->unit, "kg m^2/s");
}

TEST(QuantitiesOfARun, AreSumsAndExtremesOfTheParticles) {
  const auto sph = start<3>(porous_impact);
  const Totals now = totals(sph->particles);
  const Quantities rock = quantities_of<3>(porous_impact);
  EXPECT_EQ(value(rock, "kinetic energy"), now.kinetic);
  EXPECT_EQ(value(rock, "total energy"), now.kinetic + now.internal);
  EXPECT_EQ(value(rock, "momentum z"), now.momentum[2]);
  EXPECT_EQ(value(rock, "mass"), now.mass);
  EXPECT_EQ(value(rock, "max density"), std::ranges::max(sph->particles.column(Field::density)));
  EXPECT_EQ(value(rock, "min density"), std::ranges::min(sph->particles.column(Field::density)));
  EXPECT_EQ(value(rock, "damaged mass fraction"), 0);
}

}  // namespace
}  // namespace ejecta
