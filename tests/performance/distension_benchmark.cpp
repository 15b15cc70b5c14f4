/// The zero finders of P-alpha porosity: distension/<crush curve>/<solver>/<tolerance>, one state at a time as in a
/// run. Beside the rate stand the error against a bisection to round-off, the evaluations of the equation of state, and
/// the share of the states that were given up (only plain Newton gives up).
#include <boost/math/tools/toms748_solve.hpp>
#include <random>

#include "material/distension_solver.hpp"
#include "material/tillotson.hpp"
#include "performance/bodies.hpp"
#include "performance/flops.hpp"
#include "performance/measure.hpp"
#include "scene/names.hpp"

namespace ejecta {
namespace {

constexpr Tillotson solid{2327, 0.5, 1.5, 26.7e9, 26.7e9, 487e6, 4.72e6, 18.2e6, 5, 5};
const CrushCurve two_power = CrushCurve::two_power(3.3243, 4.64, 1.90, 1e6, 6.8e7, 2.13e8, 12, 3);
const CrushCurve quadratic = CrushCurve::quadratic(3.3243, 1e6, 2.13e8);

struct State {
  double rho, e, alpha_old;
};
/// Bodies compressed by up to 15 % beyond the distension they had: nearly all are being crushed.
std::vector<State> random_states(const CrushCurve& curve) {
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

template <DistensionSolver method>
DistensionResult own(const CrushCurve& curve, const State& s, double tolerance) {
  return solve_distension(curve, solid, s.rho, s.e, s.alpha_old, {method, tolerance});
}

/// Alefeld, Potra & Shi (1995), ACM Trans. Math. Softw. 21, 327, on the same residual and bracket.
DistensionResult toms748(const CrushCurve& curve, const State& s, double tolerance) {
  distension::Problem<Tillotson> problem{curve, solid, s.rho, s.e, s.alpha_old, tolerance};
  const distension::Trial high = problem.evaluate(s.alpha_old);
  if (s.alpha_old <= 1 || high.residual <= 0) return problem.result(high);
  const distension::Trial low = problem.evaluate(1);
  if (low.residual >= 0) return problem.result(low);
  std::uintmax_t left = 200;
  const auto [a, b] = boost::math::tools::toms748_solve([&](double alpha) { return problem.evaluate(alpha).residual; },
                                                        1.0, s.alpha_old, low.residual, high.residual,
                                                        [&](double a, double b) { return b - a <= tolerance; }, left);
  return problem.result(problem.evaluate(0.5 * (a + b)));
}

template <class Solver>
void distension_rate(benchmark::State& run, const CrushCurve& curve, double tolerance, Solver&& solve) {
  const std::vector<State> states = random_states(curve);
  double error = 0, evaluations = 0, failures = 0;
  for (const State& s : states) {
    const DistensionResult r = solve(curve, s, tolerance);
    const double exact = own<DistensionSolver::bisection>(curve, s, 0).alpha;
    evaluations += r.evaluations;
    failures += !r.converged;
    if (r.converged) error = std::max(error, std::abs(r.alpha - exact));
  }
  Measurement measured(run);
  measured.run([&] {
    for (const State& s : states) benchmark::DoNotOptimize(solve(curve, s, tolerance));
  });
  const auto n = static_cast<double>(states.size());
  measured.items(n);
  measured.flops<double>(evaluations * flops::distension_residual);
  measured.counter("evaluations", evaluations / n);
  measured.counter("worst_error", error);
  measured.counter("given_up", failures / n);
}

void add_cases() {
  for (const bool two : {false, true})
    for (const double tolerance : {1e-4, 1e-7, 1e-10, 1e-12}) {
      const CrushCurve& curve = two ? two_power : quadratic;
      const auto add = [&](std::string_view name, auto solve) {
        benchmark::RegisterBenchmark(
            fmt::format("distension/{}/{}/{:.0e}", two ? "two_power" : "quadratic", name, tolerance).c_str(),
            [=, &curve](benchmark::State& run) { distension_rate(run, curve, tolerance, solve); });
      };
      using enum DistensionSolver;
      add(name_of(safe_newton), [](auto&&... a) { return own<safe_newton>(a...); });
      add(name_of(newton), [](auto&&... a) { return own<newton>(a...); });
      add(name_of(bisection), [](auto&&... a) { return own<bisection>(a...); });
      add("toms748", [](auto&&... a) { return toms748(a...); });
    }
}

const bool added = (add_cases(), true);

}  // namespace
}  // namespace ejecta
