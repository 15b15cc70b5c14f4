/// Equation of state and distension of random states of pumice, one at a time.
#include <benchmark/benchmark.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <random>

#include "material/distension_solver.hpp"
#include "material/tillotson.hpp"

namespace ejecta {
namespace {

constexpr Tillotson solid{2327, 0.5, 1.5, 26.7e9, 26.7e9, 487e6, 4.72e6, 18.2e6, 5, 5};
const CrushCurve curve = CrushCurve::two_power(3.3243, 4.64, 1.90, 1e6, 6.8e7, 2.13e8, 12, 3);
constexpr double tolerance = 1e-12;

struct State {
  double rho, e, alpha_old;
};
/// Bodies compressed by up to 15 % beyond the distension they had: nearly all are being crushed.
std::vector<State> random_states() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<State> states(4096);
  for (State& s : states) {
    s.alpha_old = 1 + (curve.initial_distension - 1) * uniform(random);
    s.rho = solid.rho0 / s.alpha_old * (1 + 0.15 * uniform(random));
    s.e = 1e5 * uniform(random);
  }
  return states;
}

template <class Solve>
void per_state(benchmark::State& run, Solve&& solve) {
  const std::vector<State> states = random_states();
  for (auto _ : run)
    for (const State& s : states) benchmark::DoNotOptimize(solve(s));
  run.counters["states_per_s"] =
      benchmark::Counter(static_cast<double>(states.size()), benchmark::Counter::kIsIterationInvariantRate);
}

void eos_tillotson(benchmark::State& run) {
  per_state(run, [](const State& s) { return solid.evaluate(s.alpha_old * s.rho, s.e).pressure; });
}
void distension_safe_newton(benchmark::State& run) {
  per_state(run, [](const State& s) {
    return solve_distension(curve, solid, s.rho, s.e, s.alpha_old, DistensionSolver::safe_newton, tolerance).alpha;
  });
}
void distension_bisection(benchmark::State& run) {
  per_state(run, [](const State& s) {
    return solve_distension(curve, solid, s.rho, s.e, s.alpha_old, DistensionSolver::bisection, tolerance).alpha;
  });
}
void distension_toms748(benchmark::State& run) {
  per_state(run, [](const State& s) {
    const auto residual = [&](double alpha) {
      return alpha - std::min(curve.alpha(solid.evaluate(alpha * s.rho, s.e).pressure / alpha), s.alpha_old);
    };
    if (residual(s.alpha_old) <= 0) return s.alpha_old;
    if (residual(1) >= 0) return 1.0;
    std::uintmax_t evaluations = 200;
    const auto close = [](double low, double high) { return high - low <= tolerance; };
    return boost::math::tools::toms748_solve(residual, 1.0, s.alpha_old, close, evaluations).first;
  });
}

BENCHMARK(eos_tillotson);
BENCHMARK(distension_safe_newton);
BENCHMARK(distension_bisection);
BENCHMARK(distension_toms748);

}  // namespace
}  // namespace ejecta
