#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "material/tensor_damage.hpp"
#include "sph/stages.hpp"
#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

/// A block of basalt with tensor damage, whose particles do not act on one another: stages are called by hand.
template <int Dim>
struct Element {
  std::unique_ptr<Sph<Dim>> sim;
  Particles<Dim>& p;
  explicit Element(const std::string& strain, const std::vector<std::string>& more = {})
      : sim(start<Dim>(std::string("[scene]\nname = \"element\"\ndimension = ") + (Dim == 2 ? "2" : "3") + R"(
[resolution]
spacing = "1 mm"
[time]
end = "1 ms"
[[bodies]]
name = "rock"
material = "basalt_von_mises"
shape = ")" + (Dim == 2 ? "rectangle" : "box") +
                           R"("
size = ["1 mm", "1 mm", "1 mm"]
[materials.basalt_von_mises.damage]
model = "grady_kipp_tensor"
weibull_m = 8.5
weibull_k = "5e34 1/m^3"
growth = "benz_asphaug"
strain = ")" + strain + "\"\n",
                       more)),
        p(sim->particles) {}
  double& at(Field f, int component = 0) { return p.column(f, component)[0]; }
  void set_gradient(const Mat<Dim>& gradient) {
    for (const Field f : {Field::velocity_gradient, Field::uncut_gradient})
      for (int a = 0; a < Dim && p.has(f); ++a)
        for (int b = 0; b < Dim; ++b) at(f, a * Dim + b) = gradient(a, b);
  }
  void run(double dt) {
    sim->clock.dt = dt;
    damage(*sim);
  }
};

/// A damaged, strained element makes a full turn: nothing but round-off is left.
template <int Dim>
void expect_a_full_turn_returns(const std::string& strain, int steps) {
  Element<Dim> element(strain);
  Mat<Dim> spin = Mat<Dim>::Zero();
  spin(0, 1) = -3, spin(1, 0) = 3;
  if (Dim == 3) spin(0, Dim - 1) = 4, spin(Dim - 1, 0) = -4;
  element.set_gradient(spin);
  Mat<Dim> damaged = Mat<Dim>::Zero(), strained = Mat<Dim>::Zero();
  damaged(0, 0) = 0.8, damaged(1, 1) = 0.3, damaged(0, 1) = damaged(1, 0) = 0.2;
  strained(0, 0) = 0.3, strained(1, 1) = -0.1, strained(0, 1) = strained(1, 0) = 0.05;
  element.at(Field::flaw_strain) = 1e3;  // no crack grows
  element.p.set_symmetric(Field::damage_tensor, 0, damaged);
  element.p.set_symmetric(Field::strain_history, 0, strained);
  double quarter_error = 0;
  for (int k = 1; k <= steps; ++k) {
    element.run(2 * std::numbers::pi / ((Dim == 2 ? 3 : 5) * steps));
    if (Dim == 2 && 4 * k == steps) {
      const Mat<Dim> now = element.p.symmetric(Field::damage_tensor, 0);
      quarter_error = std::abs(now(0, 0) - 0.3) + std::abs(now(1, 1) - 0.8) + std::abs(now(0, 1) + 0.2);
    }
  }
  EXPECT_LT(quarter_error, 1e-12);
  EXPECT_LT((element.p.symmetric(Field::damage_tensor, 0) - damaged).norm(), 1e-12);
  EXPECT_LT((element.p.symmetric(Field::strain_history, 0) - strained).norm(), 1e-12);
}

TEST(TensorDamageStage, AFullTurnReturnsDamageAndStrainHistory) {
  for (const int steps : {200, 2000})
    for (const char* strain : {"pseudo_plastic", "strain_history"}) {
      expect_a_full_turn_returns<2>(strain, steps);
      expect_a_full_turn_returns<3>(strain, steps);
    }
}

/// Stretched along x at a steady rate: the accumulated strain, and the crack it opens, against the integral
/// D^(1/3) = c_g/R int (strain/weakest)^m dt from the opening of the weakest flaw on.
void expect_hand_integration(const std::string& strain, double share) {
  Element<3> element(strain);
  const double rate = 4e4, weakest = 2e-3, exponent = 3;
  element.at(Field::flaw_strain) = weakest;
  element.at(Field::flaw_exponent) = exponent;
  element.at(Field::flaw_count) = 1000;
  Mat<3> gradient = Mat<3>::Zero();
  gradient(0, 0) = rate;
  element.set_gradient(gradient);
  const double speed = 0.4 * element.at(Field::sound_speed), h = element.at(Field::smoothing_length);
  const double opens = weakest / (share * rate), end = 1.5 * opens;
  // The cracks stay short of the share of the flaws that are open.
  const double crack = speed / h * opens / (exponent + 1) * (std::pow(1.5, exponent + 1) - 1);
  ASSERT_LT(crack, 0.15) << "the test asks for a small crack";
  const int steps = 40;  // the integral is that of each step
  for (int k = 0; k < steps; ++k) element.run(end / steps);
  const Mat<3> history = element.p.symmetric(Field::strain_history, 0);
  EXPECT_NEAR(history(0, 0), share * rate * end, 1e-10);
  EXPECT_NEAR(history(1, 1), share == 1 ? 0 : -rate * end / 3, 1e-10);
  EXPECT_NEAR(std::cbrt(element.at(Field::damage_tensor)), crack, 1e-3 * crack);
  EXPECT_EQ(element.at(Field::damage), element.at(Field::damage_tensor)) << "the largest eigenvalue";
  EXPECT_EQ(element.at(Field::damage_tensor, 1), 0);
}

TEST(TensorDamageStage, AccumulatesStrainAndCracksAsIntegratedByHand) {
  expect_hand_integration("strain_history", 1);
  expect_hand_integration("pseudo_plastic", 2.0 / 3);
}

/// D^(1/3) grows by n c_g/h for n open flaws, in the plane too.
template <int Dim>
void expect_growth_of_benz_and_asphaug() {
  Element<Dim> element("benz_asphaug");
  EXPECT_FALSE(element.p.has(Field::crack_length)) << "the scalar model's";
  element.at(Field::flaw_strain) = 1e-3;
  element.at(Field::flaw_exponent) = 3;
  element.at(Field::flaw_count) = 64;
  const double young = element.sim->materials[0].elastic->young(), sigma = 2e-3 * young;
  const double rate = 8 * 0.4 * element.at(Field::sound_speed) / element.at(Field::smoothing_length);
  const double dt = 0.1 / rate;
  for (int k = 0; k < 4; ++k) {
    element.at(Field::pressure) = -sigma / 3;
    element.at(Field::deviatoric_stress, 0) = 2 * sigma / 3;
    element.at(Field::deviatoric_stress, 1) = -sigma / 3;
    element.run(k == 0 ? 0 : dt);  // the strain does not rise within a step
  }
  const double d = 0.3 * 0.3 * 0.3;
  EXPECT_NEAR(element.at(Field::damage_tensor), d, 1e-12);
  EXPECT_NEAR(element.at(Field::damage), d, 1e-12);
  EXPECT_NEAR(element.at(Field::pressure), -(1 - d) * sigma / 3, 1e-6 * sigma);
  EXPECT_EQ(element.sim->particles.column(Field::intact_share)[0], 1) << "the deviator is cut pair by pair";
}

TEST(TensorDamageStage, BenzAsphaugGrowsAsTheScalarModelUnderSteadyTension) {
  expect_growth_of_benz_and_asphaug<2>();
  expect_growth_of_benz_and_asphaug<3>();
}

TEST(TensorDamageStage, BrokenRockWithAFrictionLawYieldsByItsLargestEigenvalueAndCutsNoPairs) {
  const std::vector<std::string> friction{"materials.basalt_von_mises.strength.model=drucker_prager",
                                          "materials.basalt_von_mises.strength.cohesion=10 MPa",
                                          "materials.basalt_von_mises.strength.friction_angle=30 deg"};
  Element<3> element("strain_history", friction), bonded("strain_history");
  EXPECT_FALSE(element.sim->materials[0].cuts_pairs());
  EXPECT_TRUE(bonded.sim->materials[0].cuts_pairs());
  for (auto* e : {&element, &bonded}) {
    e->p.set_symmetric(Field::damage_tensor, 0, Vec<3>(0.2, 1, 0).asDiagonal());
    e->at(Field::pressure) = 1e9;
    e->run(0);
    EXPECT_NEAR(e->at(Field::damage), 1, 1e-15);
    EXPECT_EQ(e->sim->particles.column(Field::intact_share)[0], 1);
    e->at(Field::pressure) = 0;
    e->at(Field::deviatoric_stress, 2) = 1e6;
    strength(*e->sim);
  }
  EXPECT_EQ(element.at(Field::deviatoric_stress, 2), 0) << "no cohesion is left, and no pressure rubs";
  EXPECT_EQ(bonded.at(Field::deviatoric_stress, 2), 1e6) << "what is left depends on the direction of the pair";
}

/// Pumice with tensor damage hit by basalt with scalar damage: both in one run, both break.
TEST(TensorDamageStage, ScalarAndTensorDamageGoTogether) {
  const std::vector<std::string> both{"bodies.ball.material=basalt", "materials.pumice.damage.model=grady_kipp_tensor",
                                      "materials.pumice.damage.weibull_m=9.5",
                                      "materials.pumice.damage.weibull_k=1.6e44 1/m^3",
                                      "materials.pumice.damage.strain=strain_history"};
  const auto sim = start<3>(porous_impact, both);
  const Particles<3>& p = sim->particles;
  auto before = by_id(p, Field::damage);
  for (int k = 0; k < 240; ++k) {
    step(*sim, no_limit);
    const auto after = by_id(p, Field::damage);
    for (std::size_t i = 0; i < after.size(); ++i) ASSERT_GE(after[i], before[i]) << "nothing heals";
    before = after;
  }
  double scalar = 0, tensor = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double largest = largest_eigenvalue<3>(p.symmetric(Field::damage_tensor, i));
    ASSERT_LE(largest, 1 + 1e-12);
    if (sim->materials[static_cast<std::size_t>(p.label(Label::material)[i])].tensor_damage()) {
      tensor = std::max(tensor, largest);
      EXPECT_EQ(p.column(Field::crack_length)[i], 0);
      EXPECT_GE(p.column(Field::damage)[i], std::min(largest, 1.0) - 1e-12);
    } else {
      scalar = std::max(scalar, p.column(Field::damage)[i]);  // by cracks and by shear
      EXPECT_EQ(largest, 0);
    }
  }
  EXPECT_GT(scalar, 0.9);
  EXPECT_GT(tensor, 0.9);
  EXPECT_LT(std::abs(conservation_errors(sim->initial, totals(p)).energy), 1e-12);
}

/// A disc of basalt that spins steadily, with cracks across x in every particle: after a quarter turn they lie across
/// y. The disc widens a little under the centrifugal load and turns a little less: the matter itself says by how much.
void expect_cracks_turn_with_the_body(double damaged, const std::string& correction) {
  const auto sim = start<2>(R"([scene]
name = "disc"
dimension = 2
[resolution]
spacing = "1 mm"
[time]
end = "1 s"
[[bodies]]
name = "disc"
material = "basalt_von_mises"
shape = "disc"
radius = "6 mm"
[bodies.profile]
velocity = ["-40000*y", "40000*x"]
[materials.basalt_von_mises.damage]
model = "grady_kipp_tensor"
weibull_m = 8.5
weibull_k = "1e-30 1/m^3"
)",
                            {"numerics.gradient_correction=" + correction});
  Particles<2>& p = sim->particles;
  Mat<2> across_x = Mat<2>::Zero();
  across_x(0, 0) = damaged;
  for (std::size_t i = 0; i < p.size(); ++i) p.set_symmetric(Field::damage_tensor, i, across_x);
  evaluate(*sim);
  const auto x0 = by_id(p, Field::position, 0), y0 = by_id(p, Field::position, 1);
  const double quarter = 0.5 * std::numbers::pi / 40000;
  while (sim->clock.time < quarter * (1 - 1e-12)) step(*sim, quarter - sim->clock.time);
  double worst = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Mat<2> damage = p.symmetric(Field::damage_tensor, i);
    EXPECT_NEAR(largest_eigenvalue<2>(damage), damaged, 1e-12);
    EXPECT_NEAR(damage.trace(), damaged, 1e-12);
    const auto id = static_cast<std::size_t>(p.label(Label::id)[i]);
    const Vec<2> from(x0[id], y0[id]), to = p.vector(Field::position, i);
    const double turn = std::atan2(from[0] * to[1] - from[1] * to[0], from.dot(to));
    const Mat<2> expected = turned<2>(across_x, Eigen::Rotation2Dd(turn).toRotationMatrix());
    worst = std::max(worst, (damage - expected).norm() / (damaged * std::numbers::sqrt2));
  }
  printf("  D = %g, correction %s: orientation error %.2g rad in %d steps\n", damaged, correction.c_str(), worst,
         static_cast<int>(sim->clock.step));
  EXPECT_LT(worst, 0.01) << "damage " << damaged << ", gradient correction " << correction;
}

TEST(TensorDamageStage, CracksTurnWithTheBody) {
  for (const double damaged : {0.01, 0.5})
    for (const char* correction : {"true", "false"}) expect_cracks_turn_with_the_body(damaged, correction);
}

}  // namespace
}  // namespace ejecta
