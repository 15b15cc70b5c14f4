#include "sph/integrator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/particles/cloud.hpp"

namespace ejecta {
namespace {

const std::vector<Field> fluid{Field::smoothing_length, Field::density, Field::compression_rate, Field::specific_energy,
                               Field::specific_energy_rate};

const std::vector<Field> solid{
    Field::smoothing_length,     Field::density,           Field::compression_rate, Field::specific_energy,
    Field::specific_energy_rate, Field::deviatoric_stress, Field::stress_rate};

/// Starts with the present rates as the previous ones, as set-up does.
template <int Dim, class Rates>
void begin(Particles<Dim>& p, Rates&& rates) {
  rates(p);
  for (int a = 0; a < Dim; ++a)
    std::ranges::copy(p.column(Field::acceleration, a), p.previous(Field::acceleration, a).begin());
}

template <int Dim, class Rates>
void advance(Particles<Dim>& p, Rates&& rates, double dt, double& previous_dt) {
  predict(p, dt, previous_dt);
  rates(p);
  correct(p, dt);
  previous_dt = dt;
}

/// A damped oscillator of unit mass: what the spring and the friction take from its motion goes into its heat, and its
/// density follows d(rho)/dt = -v rho.
void oscillator(Particles<2>& p) {
  const double x = p.column(Field::position)[0], v = p.column(Field::velocity)[0];
  const double a = -x - 0.3 * v;
  p.column(Field::acceleration)[0] = a;
  p.column(Field::specific_energy_rate)[0] = -a * v;
  p.column(Field::compression_rate)[0] = -v;
}

struct Outcome {
  double x, v, energy, density;
};
/// From x = 1 at rest to t = 4 in n steps whose lengths alternate by the given ratio.
Outcome oscillate(int n, double ratio) {
  auto p = random_cloud<2>(1, 1, 1, 1, fluid);
  p.set_vector(Field::position, 0, Vec<2>(1, 0));
  p.column(Field::density)[0] = 1;
  begin(p, oscillator);
  const double dt = 4.0 / n * 2 / (1 + ratio);
  double previous_dt = 0;
  for (int k = 0; k < n; ++k) advance(p, oscillator, k % 2 == 0 ? dt : ratio * dt, previous_dt);
  return {p.column(Field::position)[0], p.column(Field::velocity)[0], p.column(Field::specific_energy)[0],
          p.column(Field::density)[0]};
}
Outcome exact() {
  const double t = 4, d = 0.15, w = std::sqrt(1 - d * d), fade = std::exp(-d * t);
  const double x = fade * (std::cos(w * t) + d / w * std::sin(w * t)), v = -fade / w * std::sin(w * t);
  return {x, v, -0.5 * v * v, std::exp(1 - x)};
}

TEST(Integrator, IsOfSecondOrderWithEqualAndUnequalSteps) {
  const Outcome truth = exact();
  for (const double ratio : {1.0, 1.5}) {
    const Outcome coarse = oscillate(100, ratio), fine = oscillate(200, ratio);
    const auto expect_order = [&](double Outcome::*value, const char* name) {
      const double error = std::abs(coarse.*value - truth.*value), finer = std::abs(fine.*value - truth.*value);
      EXPECT_LT(error, 3e-3) << name;
      EXPECT_NEAR(std::log2(error / finer), 2, 0.25) << name << ", ratio " << ratio;
    };
    expect_order(&Outcome::x, "position");
    expect_order(&Outcome::v, "velocity");
    expect_order(&Outcome::density, "density");
    // Heat and motion together are exact, so the heat is as good as the velocity.
    expect_order(&Outcome::energy, "energy");
  }
}

/// Elastic waves: the stress is driven by the motion and the motion by the stress, with angular frequency 1.
void wave(Particles<2>& p) {
  p.column(Field::acceleration)[0] = -p.column(Field::deviatoric_stress)[0];
  p.column(Field::stress_rate)[0] = p.column(Field::velocity)[0];
}

TEST(Integrator, ElasticWavesFadeSlowlyAndNeverGrow) {
  for (const double ratio : {1.0, 1.5}) {  // of neighbouring steps
    for (const double w : {0.1, 0.2, 0.4, 0.7}) {
      auto p = random_cloud<2>(1, 1, 1, 1, solid);
      p.column(Field::velocity)[0] = 1;
      begin(p, wave);
      double previous_dt = 0, most = 0;
      constexpr int steps = 4000;
      for (int k = 0; k < steps; ++k) {
        advance(p, wave, k % 2 == 0 ? w : w / ratio, previous_dt);
        const double amplitude = std::hypot(p.column(Field::velocity)[0], p.column(Field::deviatoric_stress)[0]);
        if (k >= steps / 2) most = std::max(most, amplitude);
      }
      // At most a step and the first ones, which have none before them, can raise it.
      EXPECT_LT(most, 1) << "w dt " << w << ", ratio " << ratio;
      if (ratio != 1.0 || w > 0.2) continue;
      EXPECT_NEAR(std::log(most) / (-0.125 * std::pow(w, 4) * steps / 2), 1, 0.2) << "w dt " << w;
    }
  }
}

TEST(Integrator, ConservesTotalEnergyWhateverTheStepsAndForces) {
  constexpr std::size_t n = 40;
  auto p = random_cloud<3>(n, 2, 1, 1, fluid);
  Uniform uniform(3);
  for (std::size_t i = 0; i < n; ++i) {
    p.column(Field::mass)[i] = uniform(0.5, 2);
    p.set_vector(Field::velocity, i, Vec<3>(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
  }
  // Random pair forces that know nothing of the positions; each side is heated by a random share of the work.
  const auto random_forces = [&](Particles<3>& q) {
    for (int a = 0; a < 3; ++a) std::ranges::fill(q.column(Field::acceleration, a), 0.0);
    std::ranges::fill(q.column(Field::specific_energy_rate), 0.0);
    const auto m = q.column(Field::mass);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Vec<3> force(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        const double lost = -force.dot(q.vector(Field::velocity, i) - q.vector(Field::velocity, j));
        const double share = uniform(0, 1);
        q.set_vector(Field::acceleration, i, q.vector(Field::acceleration, i) + force / m[i]);
        q.set_vector(Field::acceleration, j, q.vector(Field::acceleration, j) - force / m[j]);
        q.column(Field::specific_energy_rate)[i] += share * lost / m[i];
        q.column(Field::specific_energy_rate)[j] += (1 - share) * lost / m[j];
      }
  };
  const auto energy = [&] {
    double total = 0;
    for (std::size_t i = 0; i < n; ++i)
      total += p.column(Field::mass)[i] *
               (p.column(Field::specific_energy)[i] + 0.5 * p.vector(Field::velocity, i).squaredNorm());
    return total;
  };
  begin(p, random_forces);
  const double before = energy();
  double previous_dt = 0, exchanged = 0;
  for (int step = 0; step < 200; ++step) {
    advance(p, random_forces, uniform(0.001, 0.3), previous_dt);
    for (std::size_t i = 0; i < n; ++i) exchanged = std::max(exchanged, std::abs(p.column(Field::specific_energy)[i]));
    ASSERT_NEAR(energy(), before, 1e-13 * (before + n * exchanged)) << "step " << step;
  }
  EXPECT_GT(exchanged, 10 * before / n) << "the test must move energy about";
}

TEST(Integrator, IsExactUnderConstantAcceleration) {
  auto p = random_cloud<3>(1, 4, 1, 1, fluid);
  p.set_vector(Field::position, 0, Vec<3>(1, 2, 3));
  p.set_vector(Field::velocity, 0, Vec<3>(4, 5, 6));
  const auto fall = [](Particles<3>& q) { q.set_vector(Field::acceleration, 0, Vec<3>(0.5, -1, -10)); };
  begin(p, fall);
  Uniform uniform(5);
  double t = 0, previous_dt = 0;
  for (int step = 0; step < 100; ++step) {
    const double dt = uniform(0.001, 0.1);
    advance(p, fall, dt, previous_dt);
    t += dt;
  }
  const Vec<3> a(0.5, -1, -10), v = Vec<3>(4, 5, 6) + t * a, x = Vec<3>(1, 2, 3) + t * (Vec<3>(4, 5, 6) + 0.5 * t * a);
  EXPECT_LT((p.vector(Field::velocity, 0) - v).norm(), 1e-13 * v.norm());
  EXPECT_LT((p.vector(Field::position, 0) - x).norm(), 1e-13 * x.norm());
}

TEST(Integrator, DensityStaysPositiveHoweverFastMatterIsDrawnApart) {
  for (const double rate : {-1e9, -3.0, 3.0, 1e9}) {
    auto p = random_cloud<2>(1, 4, 1, 1, fluid);
    p.column(Field::density)[0] = 2;
    const auto draw = [&](Particles<2>& q) { q.column(Field::compression_rate)[0] = rate; };
    begin(p, draw);
    double previous_dt = 0;
    for (int step = 0; step < 10; ++step) {
      advance(p, draw, 1, previous_dt);
      ASSERT_GT(p.column(Field::density)[0], 0) << rate;
    }
    // Where a step resolves it the density grows as the exponential of the rate.
    auto q = random_cloud<2>(1, 4, 1, 1, fluid);
    q.column(Field::density)[0] = 2;
    begin(q, draw);
    const double dt = 0.1 / std::abs(rate);
    for (int step = 0; step < 10; ++step) advance(q, draw, dt, previous_dt);
    EXPECT_NEAR(q.column(Field::density)[0] / (2 * std::exp(rate > 0 ? 1 : -1)), 1, 2e-7) << rate;  // 10 x^5/720
  }
}

TEST(Integrator, FreeFlightIsBallisticToTheLastBit) {
  auto p = random_cloud<2>(1, 6, 1, 1, fluid);
  p.set_vector(Field::position, 0, Vec<2>(0.1, -0.7));
  p.set_vector(Field::velocity, 0, Vec<2>(123.4, -0.003));
  p.column(Field::specific_energy)[0] = 77;
  const auto nothing = [](Particles<2>&) {};
  Vec<2> x(0.1, -0.7);
  double previous_dt = 0;
  for (int step = 1; step <= 100; ++step) {
    const double dt = std::ldexp(1.0, -10 - step % 3);
    x += dt * Vec<2>(123.4, -0.003);
    advance(p, nothing, dt, previous_dt);
    EXPECT_EQ(p.vector(Field::position, 0), x);
  }
  EXPECT_EQ(p.vector(Field::velocity, 0), Vec<2>(123.4, -0.003));
  EXPECT_EQ(p.column(Field::specific_energy)[0], 77);
}

}  // namespace
}  // namespace ejecta
