#include <gtest/gtest.h>

#include <cmath>

#include "material/distension_solver.hpp"
#include "sph/stages.hpp"
#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

/// A cube of 10^3 particles with exact gradients of linear flows in the middle.
std::unique_ptr<Sph<3>> cube(const std::string& material, const std::vector<std::string>& overrides = {}) {
  return start<3>(R"([scene]
name = "cube"
[resolution]
spacing = "1 mm"
[time]
end = "1 ms"
[[bodies]]
name = "cube"
shape = "box"
size = ["10 mm", "10 mm", "10 mm"]
material = ")" + material +
                      "\"\n",
                  overrides);
}

void set_flow(Sph<3>& sim, const Mat<3>& gradient) {
  for (std::size_t i = 0; i < sim.particles.size(); ++i)
    sim.particles.set_vector(Field::velocity, i, gradient * sim.particles.vector(Field::position, i));
}

void set_deviator(Sph<3>& sim, const Deviator<3>& s) {
  for (int k = 0; k < 5; ++k) std::ranges::fill(sim.particles.column(Field::deviatoric_stress, k), s[k]);
}

std::size_t middle(const Sph<3>& sim) {
  std::size_t i = 0;
  while (sim.particles.vector(Field::position, i).norm() > 1e-3) ++i;
  return i;
}

Mat<3> rate_of_stress(const Sph<3>& sim, std::size_t i) {
  Deviator<3> rate;
  for (int k = 0; k < 5; ++k) rate[k] = sim.particles.column(Field::stress_rate, k)[i];
  return full_tensor<3>(rate);
}

Mat<3> some_flow() {
  Mat<3> A;
  A << -3, 1, 2, 0.5, -1, 4, -2, 0.25, 1;
  return 1000 * A;
}
const Deviator<3> some_stress{1e6, -3e6, 2e6, 0.5e6, -1e6};

TEST(StrainRates, AreContinuityAndTheJaumannRateOfHookesLaw) {
  const auto sim = cube("aluminium");
  const Mat<3> A = some_flow();
  set_flow(*sim, A);
  set_deviator(*sim, some_stress);
  evaluate(*sim);
  const std::size_t i = middle(*sim);
  const double G = sim->materials[0].elastic->shear_modulus;
  EXPECT_NEAR(sim->particles.column(Field::compression_rate)[i], -A.trace(), 1e-9 * A.norm());
  const Mat<3> strain = 0.5 * (A + A.transpose()), spin = 0.5 * (A - A.transpose()), S = full_tensor<3>(some_stress);
  const Mat<3> expected = 2 * G * (strain - strain.trace() / 3 * Mat<3>::Identity()) + spin * S - S * spin;
  EXPECT_LT((rate_of_stress(*sim, i) - expected).norm(), 1e-9 * expected.norm());
}

TEST(StrainRates, OfACrushedBodyAreThoseOfItsSolid) {
  const auto sim = cube("pumice");
  // Nearly compact: earlier all the strain closes pores and the solid sees none of it.
  for (double& rho : sim->particles.column(Field::density)) rho *= 3.2;
  for (double& h : sim->particles.column(Field::smoothing_length)) h /= std::cbrt(3.2);
  for (int a = 0; a < 3; ++a)
    for (double& x : sim->particles.column(Field::position, a)) x /= std::cbrt(3.2);
  sim->lists.invalidate();
  const Mat<3> A = some_flow();
  set_flow(*sim, A);
  set_deviator(*sim, some_stress);
  evaluate(*sim);
  const auto& p = sim->particles;
  const std::size_t i = middle(*sim);
  const Material& pumice = sim->materials[0];
  const double rho = p.column(Field::density)[i], e = p.column(Field::specific_energy)[i],
               alpha = p.column(Field::distension)[i], P = p.column(Field::pressure)[i];
  ASSERT_LT(alpha, 0.9 * pumice.porosity->initial_distension());
  // How fast the pores close when the body is compressed a little more, without heat coming in.
  const double more = 1e-6;
  const double next = std::visit(
      [&](const auto& eos) {
        return solve_distension(pumice.porosity->curve, eos, rho * (1 + more), e + P / rho * more, alpha,
                                {DistensionSolver::bisection, 1e-14})
            .alpha;
      },
      pumice.eos);
  const double closing = (next / alpha - 1) / more;  // d(ln alpha)/d(ln rho)
  EXPECT_GT(1 + closing, 0.01);
  EXPECT_NEAR(p.column(Field::stress_factor)[i], 1 + closing, 1e-4);

  const Mat<3> strain = 0.5 * (A + A.transpose()), spin = 0.5 * (A - A.transpose());
  for (const double sign : {1, -1}) {
    const Deviator<3> stress = sign * some_stress;
    set_deviator(*sim, stress);
    strain_rates(*sim);
    const Mat<3> S = full_tensor<3>(stress);
    const bool loads = S.cwiseProduct(A).sum() > 0;  // else the solid gives back all it can
    const Mat<3> expected = 2 * pumice.elastic->shear_modulus / alpha * (loads ? 1 + closing : 1) *
                                (strain - strain.trace() / 3 * Mat<3>::Identity()) +
                            spin * S - S * spin + closing * A.trace() * S;
    EXPECT_LT((rate_of_stress(*sim, i) - expected).norm(), 1e-3 * expected.norm()) << (loads ? "loads" : "unloads");
  }
}

TEST(ShearSwitch, IsOneInCompressionAndSmallInRotation) {
  const auto sim = cube("aluminium", {"numerics.balsara=true"});
  const std::size_t i = middle(*sim);
  const auto switch_in = [&](const Mat<3>& flow) {
    set_flow(*sim, flow);
    evaluate(*sim);
    return sim->particles.column(Field::viscosity_factor)[i];
  };
  Mat<3> spin = Mat<3>::Zero();
  spin(0, 1) = -1e6;
  spin(1, 0) = 1e6;
  const double floor =
      1e-4 * sim->particles.column(Field::sound_speed)[i] / sim->particles.column(Field::smoothing_length)[i];
  EXPECT_LT(switch_in(spin), 1e-6);
  EXPECT_NEAR(switch_in(-1e6 * Mat<3>::Identity()), 3e6 / (3e6 + floor), 1e-6);
  EXPECT_NEAR(switch_in(spin - 1e6 * Mat<3>::Identity()), 3e6 / (3e6 + 2e6 + floor), 1e-6);
}

TEST(ShockSwitch, DecaysAtRestAndRisesWhereMatterIsCompressed) {
  const auto sim = cube("aluminium", {});
  auto& p = sim->particles;
  const std::size_t i = middle(*sim);
  // A fifth of the sound crossings of h: down to 1/e after five of them.
  const double crossing = p.column(Field::smoothing_length)[i] / p.column(Field::sound_speed)[i];
  sim->clock.dt = 0.01 * crossing;
  std::ranges::fill(p.column(Field::shock_switch), 1.0);
  for (int k = 0; k < 500; ++k) viscosity_switches(*sim);
  EXPECT_NEAR(p.column(Field::shock_switch)[i], 1 / std::exp(1), 2e-3);
  for (int k = 0; k < 10000; ++k) viscosity_switches(*sim);
  EXPECT_NEAR(p.column(Field::shock_switch)[i], 0, 1e-6);
  // A hundredth of a crossing in which the density grows by this share.
  const auto after = [&](double compression) {
    sim->clock.dt = 1e-4 * crossing;
    set_flow(*sim, -compression / 3 / (100 * sim->clock.dt) * Mat<3>::Identity());
    pair_rates(*sim);
    for (int k = 0; k < 100; ++k) viscosity_switches(*sim);
    return p.column(Field::shock_switch)[i];
  };
  EXPECT_NEAR(after(-0.1), 0, 1e-6) << "expansion is no shock";
  EXPECT_NEAR(after(0.1), 1 - std::exp(-2), 0.005) << "a shock brings nearly all of it";
}

/// Density of a particle of the cube after it has been held; x chooses which.
template <class Choose>
double held(Sph<3>& sim, double density, const Choose& choose) {
  auto& p = sim.particles;
  std::size_t i = 0;
  while (!choose(p.vector(Field::position, i))) ++i;
  p.column(Field::density)[i] = density;
  strain_rates(sim);
  return p.column(Field::density)[i];
}

TEST(HeldDensity, FollowsTheNeighboursWhereContinuityHasLostThem) {
  const auto sim = cube("aluminium");
  const double whole = sim->materials[0].bulk_density();
  const auto middle = [](const Vec<3>& x) { return x.norm() < 1e-3; };
  const auto corner = [](const Vec<3>& x) { return x.minCoeff() > 4e-3; };
  // A lattice of that spacing has the density it was made with.
  EXPECT_NEAR(held(*sim, 1e-6 * whole, middle) / whole, 0.6, 0.01);
  EXPECT_NEAR(held(*sim, 20 * whole, middle) / whole, 1.7, 0.03);
  for (const double kept : {0.7, 0.999, 1.5}) EXPECT_EQ(held(*sim, kept * whole, middle), kept * whole);
  // Half of the neighbours are no measure of how dense a particle is, but it is not thinner than they say.
  EXPECT_EQ(held(*sim, 20 * whole, corner), 20 * whole);
  const double thin = held(*sim, 1e-6 * whole, corner) / whole;
  EXPECT_GT(thin, 0.05);
  EXPECT_LT(thin, 0.5);
  // Twice as coarse a body beside it: particles there count finer ones as their own.
  sim->scene.bodies.push_back(sim->scene.bodies[0]);
  sim->scene.bodies[1].spacing_factor = 2;
  EXPECT_NEAR(held(*sim, 1e-6 * whole, middle) / whole, 0.6 / 8, 0.01);
  EXPECT_NEAR(held(*sim, 20 * whole, middle) / whole, 1.7 * 8, 0.2);
}

/// Crushed pores beside a particle crowd its neighbours: it must not be pressed by the count alone, or it does work
/// that nobody has done on it.
TEST(HeldDensity, ACrowdThickensVapourAlone) {
  const auto sim = cube("aluminium");
  auto& p = sim->particles;
  const double whole = sim->materials[0].bulk_density();
  const std::size_t i = middle(*sim);
  const Vec<3> x = p.vector(Field::position, i);
  const auto it = [&](const Vec<3>& other) { return other == x; };
  p.column(Field::mass)[i] *= 3;  // as three times as many neighbours
  const auto heat = [&](double reach) {
    const double u = (reach - 1) * p.column(Field::sound_speed)[i];
    p.column(Field::specific_energy)[i] = 0.5 * u * u;
  };
  heat(1.3);
  EXPECT_EQ(held(*sim, 1.05 * whole, it), 1.05 * whole);
  EXPECT_NEAR(held(*sim, 0.5 * whole, it) / whole, 1, 1e-9);
  heat(4);
  EXPECT_NEAR(held(*sim, 0.5 * whole, it) / whole, 1.8, 0.03);
}

TEST(SmoothingLengths, StayWithinTheirBounds) {
  const auto sim = cube("aluminium");
  auto h = sim->particles.column(Field::smoothing_length), sum = sim->particles.column(Field::zeroth_moment);
  const double h0 = sim->scene.numerics.nodes_per_h * 1e-3;
  std::ranges::fill(sum, 0.0);  // nobody near: grow
  for (int k = 0; k < 20; ++k) smoothing_lengths(*sim);
  EXPECT_NEAR(h[middle(*sim)], sim->scene.numerics.smoothing_growth * h0, 1e-9 * h0);
  std::ranges::fill(sum, 1e9);  // crowded: shrink
  for (int k = 0; k < 20; ++k) smoothing_lengths(*sim);
  EXPECT_NEAR(h[middle(*sim)], 0.25 * h0, 1e-9 * h0);
}

/// Error of the densities near a contact between particles of different sizes, after 60 steps at rest: the mean of
/// |ln(rho/exact)|.
double error_at_contact(const char* fill_space) {
  const auto sim = start<2>(gas_tube, {"numerics.scheme=gsph", "bodies.right.pressure=1 Pa",
                                       std::string("numerics.fill_space=") + fill_space});
  for (int k = 0; k < 60; ++k) step(*sim, 1);
  double error = 0;
  int near = 0;
  for (std::size_t i = 0; i < sim->particles.size(); ++i) {
    if (std::abs(sim->particles.column(Field::position)[i]) > 0.2) continue;
    const double exact = sim->particles.label(Label::body)[i] == 0 ? 1 : 0.25;
    error += std::abs(std::log(sim->particles.column(Field::density)[i] / exact));
    ++near;
  }
  return error / near;
}

TEST(SummedDensity, VolumesThatFillSpaceKeepAContactSharper) {
  const double by_number = error_at_contact("false"), filled = error_at_contact("auto");
  EXPECT_GT(by_number, 0.05);
  EXPECT_LT(filled, 0.7 * by_number);
}

}  // namespace
}  // namespace ejecta
