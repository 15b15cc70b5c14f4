#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "base/errors.hpp"
#include "schemes/kernels.hpp"
#include "schemes/lattice_sums.hpp"
#include "unit/base/thread_counts.hpp"
#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

/// The scene with the ball first.
std::string ball_first() {
  const std::size_t target = porous_impact.find("[[bodies]]"), ball = porous_impact.find("[[bodies]]", target + 1);
  return porous_impact.substr(0, target) + porous_impact.substr(ball) + porous_impact.substr(target, ball - target);
}

/// Weakest flaw of the pumice particles by where they are.
std::map<std::array<double, 3>, double> flaws_by_position(const Sph<3>& sim) {
  std::map<std::array<double, 3>, double> flaws;
  const auto& p = sim.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (sim.materials[static_cast<std::size_t>(p.label(Label::material)[i])].name == "pumice")
      flaws[{p.column(Field::position, 0)[i], p.column(Field::position, 1)[i], p.column(Field::position, 2)[i]}] =
          p.column(Field::flaw_strain)[i];
  return flaws;
}

TEST(SetUp, FlawsDoNotDependOnTheOrderOfParticlesOrThreads) {
  const auto flaws = flaws_by_position(*start<3>(porous_impact));
  ASSERT_GT(flaws.size(), 400u);
  EXPECT_EQ(flaws, flaws_by_position(*start<3>(ball_first())));
  for_thread_counts([&](int) { EXPECT_EQ(flaws, flaws_by_position(*start<3>(porous_impact))); });
  EXPECT_NE(flaws, flaws_by_position(*start<3>(porous_impact, {"random.seed=2"})));
}

TEST(SetUp, EveryParticleHasAFlawAndTheyDiffer) {
  std::map<double, int> strains;
  for (const auto& [x, flaw] : flaws_by_position(*start<3>(porous_impact))) {
    EXPECT_GT(flaw, 0);
    ++strains[flaw];
  }
  EXPECT_GT(strains.size(), 400u);
}

/// A charge in a tube, both on lattices that are scaled to their volumes.
std::string tube_about_disc(double bore, double wall, double spacing, bool tube_first) {
  const std::string disc =
      fmt::format("[[bodies]]\nname = \"disc\"\nmaterial = \"copper\"\nshape = \"disc\"\nradius = \"{} mm\"\n", bore);
  const std::string tube = fmt::format(
      "[[bodies]]\nname = \"tube\"\nmaterial = \"iron\"\nshape = \"disc\"\ninner_radius = \"{} mm\"\nradius = \"{} "
      "mm\"\n",
      bore, bore + wall);
  return fmt::format(
      "[scene]\nname = \"tube\"\ndimension = 2\n[resolution]\nspacing = \"{} mm\"\n[time]\nend = \"1 us\"\n{}", spacing,
      tube_first ? tube + disc : disc + tube);
}

TEST(SetUp, ABodyMayFillTheHoleOfAnother) {
  for (const double bore : {6, 10, 17, 25})
    for (const double wall : {2, 5, 15})
      for (const double spacing : {0.8, 0.5})
        for (const bool tube_first : {false, true})
          EXPECT_NO_THROW(start<2>(tube_about_disc(bore, wall, spacing, tube_first)))
              << bore << " " << wall << " " << spacing;
  try {
    start<2>(tube_about_disc(10, 5, 0.8, false), {"bodies.tube.inner_radius=9.2 mm"});
    FAIL() << "an overlap of a spacing was taken";
  } catch (const InputError& error) {
    EXPECT_NE(
        std::string(error.what()).find("bodies.tube: expected a body clear of all earlier ones, got an overlap of"),
        std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("particles with disc"), std::string::npos) << error.what();
  }
}

TEST(SetUp, BodiesHaveTheirMassVelocityAndState) {
  const auto sim = start<3>(porous_impact);
  const auto& p = sim->particles;
  const Range target = p.material_ranges()[0], ball = p.material_ranges()[1];
  EXPECT_EQ(target.end, ball.begin);
  EXPECT_EQ(ball.end, p.size());
  double mass = 0;
  for (std::size_t i = target.begin; i < target.end; ++i) {
    mass += p.column(Field::mass)[i];
    EXPECT_EQ(p.vector(Field::velocity, i), Vec<3>(0, 0, 0));
    EXPECT_EQ(p.column(Field::distension)[i], sim->materials[0].porosity->initial_distension());
    EXPECT_EQ(p.label(Label::body)[i], 0);
  }
  for (std::size_t i = ball.begin; i < ball.end; ++i) {
    EXPECT_EQ(p.vector(Field::velocity, i), Vec<3>(0, 200, -3000));
    EXPECT_EQ(p.column(Field::distension)[i], 1);
    EXPECT_EQ(p.label(Label::body)[i], 1);
  }
  const double volume = 4 * std::numbers::pi / 3 * std::pow(0.035, 3);
  EXPECT_NEAR(mass, volume * sim->materials[0].bulk_density(), 1e-12 * mass);
}

TEST(SetUp, MassesInMixedPrecisionAreNumbersThatSinglePrecisionHolds) {
  const auto sim = start<3>(porous_impact, {"numerics.precision=mixed"}), exact = start<3>(porous_impact);
  const auto mass = sim->particles.column(Field::mass);
  for (const double m : mass) EXPECT_EQ(m, static_cast<double>(static_cast<float>(m)));
  EXPECT_NEAR(totals(sim->particles).mass / totals(exact->particles).mass, 1, 1e-7);
}

TEST(SetUp, AUniformGasIsInEquilibrium) {
  const auto sim =
      start<2>(gas_tube, {"bodies[1].density=1 kg/m^3", "bodies[1].pressure=1 Pa", "bodies[1].spacing_factor=1"});
  const auto& p = sim->particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_NEAR(p.column(Field::density)[i], 1, 0.02);
    EXPECT_NEAR(p.column(Field::pressure)[i], 1, 0.02);
    EXPECT_LT(p.vector(Field::acceleration, i).norm(), 1e-9);
    // n_h particles per smoothing length
    EXPECT_NEAR(p.column(Field::smoothing_length)[i], sim->scene.numerics.nodes_per_h * 0.025, 1e-3 * 0.025);
  }
}

TEST(SetUp, FormulasReplaceUniformValues) {
  const auto sim = start<2>(gas_tube, {R"s(bodies.left.profile.velocity=["3*x", "-hypot(x, y)"])s",
                                       "bodies.left.profile.density=2 + x", "bodies.left.profile.pressure=r + dx"});
  const auto& p = sim->particles;
  double left = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec<2> x = p.vector(Field::position, i), v = p.vector(Field::velocity, i);
    if (p.label(Label::body)[i] != 0) {
      EXPECT_EQ(v, Vec<2>(0, 0));
      continue;
    }
    left += 1;
    EXPECT_DOUBLE_EQ(v[0], 3 * x[0]);
    EXPECT_DOUBLE_EQ(v[1], -x.norm());
    const double density = 2 + x[0], r = (x - Vec<2>(-0.5, 0)).norm();
    EXPECT_NEAR(p.column(Field::mass)[i], density * 0.025 * 0.025, 1e-15);
    EXPECT_NEAR(p.column(Field::specific_energy)[i], (r + 0.025) / (0.4 * density), 1e-12);
  }
  EXPECT_EQ(left, 320);
}

TEST(SetUp, AFormulaWithoutAValueIsAnInputErrorThatNamesThePlace) {
  try {
    start<2>(gas_tube, {R"s(bodies.left.profile.velocity=["sqrt(x + 0.5)", "0"])s"});
    FAIL() << "no error";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("bodies.left.profile.velocity: expected a finite number, got"), std::string::npos) << text;
  }
  EXPECT_THROW(start<2>(gas_tube, {"bodies.left.profile.density=x"}), InputError);  // negative on the left
}

TEST(SetUp, DisplacementAndJitterMoveParticlesAndKeepTheirMass) {
  const auto still = start<2>(gas_tube);
  const auto moved = start<2>(gas_tube, {R"s(bodies.left.profile.displacement=["0.01*y", "0"])s"});
  const auto shaken = start<2>(gas_tube, {"bodies.left.jitter=0.2"});
  const auto reseeded = start<2>(gas_tube, {"bodies.left.jitter=0.2", "random.seed=2"});
  const auto x = by_id(still->particles, Field::position, 0), y = by_id(still->particles, Field::position, 1);
  const auto moved_x = by_id(moved->particles, Field::position, 0),
             shaken_x = by_id(shaken->particles, Field::position, 0);
  EXPECT_EQ(by_id(still->particles, Field::mass), by_id(shaken->particles, Field::mass));
  EXPECT_NE(shaken_x, by_id(reseeded->particles, Field::position, 0));
  double widest = 0, sum = 0;
  for (std::size_t i = 0; i < 320; ++i) {
    EXPECT_DOUBLE_EQ(moved_x[i], x[i] + 0.01 * y[i]);
    widest = std::max(widest, std::abs(shaken_x[i] - x[i]) / 0.025);
    sum += (shaken_x[i] - x[i]) / 0.025;
  }
  EXPECT_LE(widest, 0.2 * (1 + 1e-9));
  EXPECT_GT(widest, 0.19);
  EXPECT_LT(std::abs(sum / 320), 0.03);  // 4 standard errors of a uniform number
}

TEST(SetUp, BodiesEndAtTheWalls) {
  constexpr auto corner = R"([scene]
name = "corner"
dimension = 2
[resolution]
spacing = "10 mm"
[time]
end = "1 s"
[[bodies]]
name = "gas"
material = "air"
shape = "disc"
radius = "1 m"
inner_radius = "0.5 m"
[numerics]
density = "summation"
[boundary]
x = "reflecting"
y = "reflecting"
min = [0, 0]
max = ["2 m", "2 m"]
)";
  const auto quarter = start<2>(corner);
  const auto& p = quarter->particles;
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_GT(p.vector(Field::position, i).minCoeff(), 0);
  EXPECT_NEAR(totals(p).mass, 1.204 * std::numbers::pi / 4 * 0.75, 1e-12);
}

TEST(SetUp, FlawsAreThoseOfTheSolidVolume) {
  // Three times the pores: the same flaws, at strains lower by the factor in solid volume to the power 1/m.
  const auto dense = flaws_by_position(*start<3>(porous_impact, {"materials.pumice.porosity.initial_distension=2"}));
  const auto light = flaws_by_position(*start<3>(porous_impact, {"materials.pumice.porosity.initial_distension=4"}));
  for (const auto& [x, flaw] : dense) EXPECT_NEAR(light.at(x) / flaw, std::pow(2, 1 / 9.5), 1e-9);
}

TEST(SetUp, OverlappingBodiesAreAnInputError) {
  try {
    start<3>(porous_impact, {"bodies[1].center=[0, 0, \"30 mm\"]"});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("bodies.ball"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("overlap"), std::string::npos) << error.what();
  }
}

/// h = n_h (volume)^(1/2), with the volume that a kernel 2.5 times as wide leaves a particle; beside the contact that
/// is not what counting neighbours gives.
TEST(SetUp, SmoothingLengthsFollowAPilotDensity) {
  constexpr double width = 2.5, height = 0.8;
  std::vector<std::string> settings{"numerics.scheme=gsph",
                                    "numerics.density=summation",
                                    "bodies.left.size=[\"1 m\", \"0.8 m\"]",
                                    "boundary.min=[\"-1 m\", \"-0.4 m\"]",
                                    "boundary.max=[\"1 m\", \"0.4 m\"]",
                                    "bodies.right.size=[\"1 m\", \"0.8 m\"]"};
  const auto counted = start<2>(gas_tube, settings);
  settings.push_back("numerics.pilot_width=2.5");
  const auto sim = start<2>(gas_tube, settings);
  const Numerics& n = sim->scene.numerics;
  const double of_lattice = lattice_sums(n.kernel, 2, width * n.nodes_per_h).density;
  const auto& p = sim->particles;
  const auto h = p.column(Field::smoothing_length);
  double apart = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (std::abs(p.column(Field::position)[i]) > 0.3) continue;  // mirrors
    double number = 0;
    for (std::size_t j = 0; j < p.size(); ++j)
      for (const double shift : {-height, 0.0, height}) {
        const Vec<2> x = p.vector(Field::position, j) + Vec<2>(0, shift) - p.vector(Field::position, i);
        const double reach = width * h[i];
        number += WendlandC2::norm<2> * WendlandC2::value(x.norm() / reach) / (reach * reach);
      }
    EXPECT_NEAR(h[i], n.nodes_per_h * std::sqrt(of_lattice / number), 1e-3 * h[i]) << p.vector(Field::position, i);
    apart = std::max(apart, std::abs(h[i] / counted->particles.column(Field::smoothing_length)[i] - 1));
  }
  EXPECT_EQ(n.kernel, Kernel::wendland_c2);
  EXPECT_GT(apart, 0.05);
}

/// A blast that begins in one dimension, and a puff of gas with a profile of its own outside of it.
const std::string blast_beside_a_puff = R"([scene]
name = "b"
dimension = 2
[resolution]
spacing = "0.5 m"
[time]
end = "1 ms"
[charge]
radius = "0.5 m"
density = "1000 kg/m^3"
energy_per_length = "1e9 J/m"
[gas]
density = "1 kg/m^3"
pressure = "100 kPa"
[[bodies]]
name = "puff"
material = "air"
shape = "disc"
center = ["12 m", "0 m"]
radius = "2 m"
density = "5 kg/m^3"
pressure = "100 kPa"
[bodies.profile]
velocity = ["x", "0"]
[boundary]
min = ["-16 m", "-16 m"]
max = ["16 m", "16 m"]
)";

TEST(SetUp, ABlastLeavesOtherBodiesAlone) {
  const auto sim = start<2>(blast_beside_a_puff, {"numerics.scheme=gsph"});
  const auto& p = sim->particles;
  EXPECT_GT(sim->clock.time, 0);
  int puff = 0;
  double mass = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (sim->scene.bodies[static_cast<std::size_t>(p.label(Label::body)[i])].name != "puff") continue;
    if (++puff == 1) mass = p.column(Field::mass)[i];
    ASSERT_NEAR(p.column(Field::mass)[i], mass, 1e-12);
    ASSERT_EQ(p.column(Field::velocity, 0)[i], p.column(Field::position, 0)[i]);
  }
  EXPECT_GT(puff, 40);
  EXPECT_NEAR(mass * puff, 5 * std::numbers::pi * 4, 1e-9);
}

TEST(SetUp, MassesOfABlastFitInSinglePrecision) {
  const auto sim = start<2>(blast_beside_a_puff, {"numerics.precision=mixed"});
  EXPECT_GT(sim->clock.time, 0);
  for (const double mass : sim->particles.column(Field::mass)) ASSERT_EQ(mass, static_cast<float>(mass));
}

}  // namespace
}  // namespace ejecta
