#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

/// A run of one package.
template <int Dim>
Simulation alone(std::unique_ptr<Sph<Dim>> sph) {
  Simulation sim;
  sim.scene = sph->scene;
  sim.packages.push_back(std::move(sph));
  return sim;
}

/// Wants to be called at fixed times.
struct Metronome : Observer {
  double next;
  std::vector<double> times;
  int last_calls = 0;
  explicit Metronome(double first) : next(first) {}
  double next_time() const override { return next; }
  void observe(Simulation& sim, bool last) override {
    times.push_back(sim.clock.time);
    last_calls += last;
    if (sim.clock.time >= next * (1 - 1e-12)) next += 0.01;
  }
};

TEST(TimeLoop, RunMeetsTheTimesOfItsObserversAndTheEnd) {
  Simulation sim = alone(start<2>(gas_tube, {"time.end=0.05 s"}));
  Metronome metronome(0.01);
  EXPECT_TRUE(run(sim, {&metronome}, [] { return false; }));
  EXPECT_NEAR(sim.clock.time, 0.05, 1e-13);
  EXPECT_EQ(metronome.last_calls, 1);
  EXPECT_EQ(metronome.times.front(), 0);
  for (const double due : {0.01, 0.02, 0.03, 0.04, 0.05})
    EXPECT_TRUE(std::any_of(metronome.times.begin(), metronome.times.end(), [&](double t) {
      return std::abs(t - due) < 1e-13;
    })) << due;
}

TEST(TimeLoop, RunStopsWhenAskedOrAtTheStepLimit) {
  Simulation sim = alone(start<2>(gas_tube, {"time.max_steps=7"}));
  Metronome metronome(10);
  EXPECT_FALSE(run(sim, {&metronome}, [] { return true; }));
  EXPECT_EQ(sim.clock.step, 0);
  EXPECT_EQ(metronome.last_calls, 1);
  run(sim, {&metronome}, [] { return false; });
  EXPECT_EQ(sim.clock.step, 7);
}

}  // namespace
}  // namespace ejecta
