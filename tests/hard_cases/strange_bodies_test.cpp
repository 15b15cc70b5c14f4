/// Bodies and places that a lattice of particles hardly stands for: one particle, one layer, one row, none, two at
/// once.
#include <gtest/gtest.h>

#include "hard_cases/small_runs.hpp"

namespace ejecta {
namespace {

/// Alone, a particle has no neighbours and nothing acts on it: over hundreds of steps beside somebody else's impact its
/// velocity and state keep every bit, and it stays on its line to the last bit (x = y = z at the start, and its speeds
/// are equal). Its smoothing length grows to its limit and not beyond, so that the search for others stays short.
TEST(StrangeBodies, AnIsolatedParticleIsBallistic) {
  const auto sim = start<3>(porous_impact + R"([[bodies]]
name = "stone"
material = "nylon"
shape = "box"
center = ["1.1 m", "1.1 m", "1.1 m"]
size = ["7 mm", "7 mm", "7 mm"]
velocity = ["123.4 m/s", "123.4 m/s", "123.4 m/s"]
density = "1.1 g/cm^3"
)");
  const auto& p = sim->particles;
  const std::int32_t id = p.label(Label::id)[p.size() - 1];
  const auto bits = [&] {
    const std::size_t i = place_of(p, id);
    std::vector<double> state{p.column(Field::density)[i], p.column(Field::specific_energy)[i],
                              p.column(Field::pressure)[i]};
    for (int a = 0; a < 3; ++a) state.push_back(p.column(Field::velocity, a)[i]);
    return state;
  };
  const std::vector<double> before = bits();
  ASSERT_LT(before[2], 0) << "it is stretched, and has nobody to pull at";
  for (int k = 0; k < 300; ++k) {
    step(*sim, no_limit);
    const Vec<3> x = p.vector(Field::position, place_of(p, id));
    ASSERT_EQ(x[0], x[1]);
    ASSERT_EQ(x[0], x[2]);
  }
  EXPECT_EQ(bits(), before);
  const std::size_t i = place_of(p, id);
  EXPECT_NEAR(p.column(Field::position, 0)[i], 1.1 + 123.4 * sim->clock.time, 1e-13);
  const Numerics& n = sim->scene.numerics;
  EXPECT_NEAR(p.column(Field::smoothing_length)[i], n.smoothing_growth * n.nodes_per_h * 7e-3, 1e-12);
}

/// A target of one particle is hit like any other: it is crushed, broken and thrown ahead of the ball.
TEST(StrangeBodies, ATargetOfOneParticle) {
  for (const char* precision : {"double", "mixed"}) {
    const auto sim = start<3>(R"([scene]
name = "grain"
[resolution]
spacing = "1 mm"
[time]
end = "5 us"
[[bodies]]
name = "target"
material = "pumice"
shape = "box"
size = ["1 mm", "1 mm", "1 mm"]
[[bodies]]
name = "ball"
material = "nylon"
radius = "3 mm"
center = [0, 0, "5 mm"]
velocity = [0, 0, "-3 km/s"]
)",
                              {std::string("numerics.precision=") + precision});
    const Outcome outcome = follow(*sim);
    EXPECT_EQ(outcome.error, "");
    EXPECT_LT(outcome.conservation.momentum, 1e-14);
    EXPECT_LT(std::abs(outcome.conservation.energy), 1e-8);
    const std::size_t i = place_of(sim->particles, 0);
    EXPECT_LT(sim->particles.column(Field::velocity, 2)[i], -2500);
    EXPECT_GT(sim->particles.column(Field::damage)[i], 0.5);
    EXPECT_LT(sim->particles.column(Field::distension)[i], 2);
  }
}

/// An iron needle, one particle thick, thrown point first at an aluminium plate, one particle thick: it goes through
/// and makes a hole. The neighbours of such particles do not span space, so corrected gradients fade in the directions
/// where there are none, and all stays finite.
TEST(StrangeBodies, ANeedleGoesThroughASheet) {
  for (const char* corrected : {"false", "true"}) {
    const auto sim = start<3>(R"([scene]
name = "needle"
[resolution]
spacing = "1 mm"
[time]
end = "10 us"
[[bodies]]
name = "sheet"
material = "aluminium"
shape = "box"
size = ["30 mm", "30 mm", "1 mm"]
[[bodies]]
name = "needle"
material = "iron"
shape = "box"
size = ["1 mm", "1 mm", "30 mm"]
center = ["0.5 mm", "0.5 mm", "18 mm"]
velocity = [0, 0, "-2 km/s"]
)",
                              {std::string("numerics.gradient_correction=") + corrected});
    ASSERT_EQ(sim->particles.size(), 930u);
    const Outcome outcome = follow(*sim);
    EXPECT_EQ(outcome.error, "");
    EXPECT_LT(std::abs(outcome.conservation.energy), 1e-13);
    double lowest = 0;
    for (std::size_t i = 0; i < sim->particles.size(); ++i)
      if (sim->particles.label(Label::body)[i] == 1)
        lowest = std::min(lowest, sim->particles.column(Field::position, 2)[i]);
    EXPECT_LT(lowest, -5e-3);
    for (const double rho : sim->particles.column(Field::density)) EXPECT_GT(rho, 500);
  }
}

/// Two particles at one place, or nearly so, push each other neither apart nor together: the slope of a kernel is zero
/// at its centre. From there on they move as one, others push them as ever, and energy is kept.
TEST(StrangeBodies, ParticlesAtOnePlaceMoveAsOne) {
  for (const double distance : {0.0, 1e-15, 1e-9}) {
    const auto sim = start<3>(porous_impact);
    auto& p = sim->particles;
    const std::int32_t one = p.label(Label::id)[p.size() - 1], other = one - 1;  // of the ball, which has no flaws
    p.set_vector(Field::position, place_of(p, one),
                 p.vector(Field::position, place_of(p, other)) + Vec<3>(distance, 0, 0));
    begin_from_here(*sim);
    const Outcome outcome = follow(*sim, 60);
    EXPECT_EQ(outcome.error, "");
    EXPECT_LT(std::abs(outcome.conservation.energy), 1e-13);
    const Vec<3> apart = p.vector(Field::position, place_of(p, one)) - p.vector(Field::position, place_of(p, other));
    EXPECT_LE(apart.norm(), 20 * distance) << "the flow draws them apart, nothing else; one place stays one place";
  }
}

const std::string disc = R"([scene]
name = "disc"
dimension = 2
[resolution]
spacing = "1 mm"
[time]
end = "1 ms"
[[bodies]]
name = "disc"
material = "basalt"
shape = "disc"
radius = "8 mm"
)";

/// A displacement may put a whole compressed body onto a line or into a point. Senseless, but finite: particles at one
/// place do not push each other, those on a line push along it, and energy is kept.
TEST(StrangeBodies, ABodyFoldedIntoALineOrAPointStaysFinite) {
  for (const char* displacement : {R"(["-x", "0"])", R"(["-x", "-y"])", R"f(["x - abs(x)", "0"])f"}) {
    const auto sim =
        start<2>(disc + "density = \"2.8 g/cm^3\"\n[bodies.profile]\ndisplacement = " + displacement + "\n");
    const Outcome outcome = follow(*sim, 50);
    EXPECT_EQ(outcome.error, "") << displacement;
    const Totals now = totals(sim->particles);  // of an energy that is zero at the start
    EXPECT_LE(std::abs(now.energy()), 1e-13 * now.kinetic) << displacement;
    EXPECT_LT(outcome.conservation.momentum, 1e-13) << displacement;
    EXPECT_EQ(top_speed(sim->particles) > 0, std::string(displacement) != R"(["-x", "-y"])") << displacement;
  }
}

/// What leaves a body without particles, or takes a place twice, is refused before the run, by the name of the body.
TEST(StrangeBodies, NoneAndTwiceAreRefused) {
  const std::string too_small = refusal<2>(disc, {"bodies.disc.radius=0.4 mm"});
  EXPECT_TRUE(too_small.starts_with("InputError")) << too_small;
  EXPECT_TRUE(mentions(too_small, "expected at least one particle across")) << too_small;
  const std::string between = refusal<2>(disc, {"bodies.disc.radius=0.6 mm"});  // no point of the lattice is in it
  EXPECT_TRUE(mentions(between, "InputError")) << between;
  EXPECT_TRUE(mentions(between, "bodies.disc: expected room for at least one particle")) << between;
  const std::string outside =
      refusal<2>(disc + "[boundary]\nx = \"reflecting\"\nmin = [\"1 m\", 0]\nmax = [\"2 m\", 0]\n");
  EXPECT_TRUE(mentions(outside, "bodies.disc: expected room for at least one particle")) << outside;
  const std::string twice = refusal<2>(disc + disc.substr(disc.find("[[bodies]]")), {"bodies[1].name=again"});
  EXPECT_TRUE(mentions(twice, "InputError")) << twice;
  EXPECT_TRUE(mentions(twice, "bodies.again: expected a body clear of all earlier ones")) << twice;
}

/// Not-a-number is refused wherever a number is read, and where a formula yields it, with the place.
TEST(StrangeBodies, NotANumberIsRefused) {
  for (const char* override : {"bodies.disc.radius=nan mm", "bodies.disc.velocity=nan 0 m/s", "numerics.courant=nan",
                               "bodies.disc.specific_energy=nan J/kg", "bodies.disc.center=[\"inf m\", 0]",
                               "materials.basalt.eos.A=nan GPa", "time.end=nan s"})
    EXPECT_TRUE(refusal<2>(disc, {override}).starts_with("InputError")) << override;
  for (const char* line : {"velocity = [\"sqrt(x)\", \"0\"]", "density = \"0/0\"", "displacement = [\"1/0\", \"0\"]",
                           "specific_energy = \"ln(-1)\"", "deviatoric_stress = [\"0\", \"acos(2)\", \"0\"]"}) {
    const std::string message = refusal<2>(disc + "[bodies.profile]\n" + line + "\n");
    EXPECT_TRUE(message.starts_with("InputError")) << line << ": " << message;
    EXPECT_TRUE(mentions(message, "bodies.disc.profile.")) << message;
  }
}

/// A scene may ask for what no number can hold. The first state that is not finite, or the step that is too short for
/// the run to end, names the particle.
TEST(StrangeBodies, NumbersBeyondReachAreNamed) {
  for (const char* override : {"bodies.disc.density=1e-300 kg/m^3", "bodies.disc.density=1e300 kg/m^3",
                               "bodies.disc.specific_energy=1e300 J/kg", "bodies.disc.specific_energy=1e40 J/kg",
                               "numerics.viscosity_alpha=1e300"}) {
    const std::string message = refusal<2>(disc, {override});
    EXPECT_TRUE(message.starts_with("SimulationError")) << override << ": " << message;
    EXPECT_TRUE(mentions(message, "(body \"disc\", material \"basalt\")")) << message;
  }
}

}  // namespace
}  // namespace ejecta
