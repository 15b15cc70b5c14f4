/// Work and precision of zero finders for the distension of crushing pumice: a table (CSV) on standard output, a line
/// per curve, method and tolerance. All methods see the same random states and take turns at each block of them; the
/// time of a root is the median over the blocks. Errors are against bisection down to neighbouring numbers.
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "material/distension_solver.hpp"
#include "material/material_reader.hpp"

namespace {

using namespace ejecta;

struct State {
  double rho, e, alpha_old, root;
};

DistensionResult toms748(const CrushCurve& curve, const Tillotson& eos, const State& s, double tolerance) {
  distension::Problem<Tillotson> problem{curve, eos, s.rho, s.e, s.alpha_old, tolerance};
  const distension::Trial high = problem.evaluate(s.alpha_old);
  if (problem.accepts(high)) return problem.result(high);
  const distension::Trial low = problem.evaluate(1);
  if (low.residual >= 0) return problem.result(low);
  std::uintmax_t steps = 200;
  const auto [a, b] = boost::math::tools::toms748_solve(
      [&](double alpha) { return problem.evaluate(alpha).residual; }, 1.0, s.alpha_old, low.residual, high.residual,
      [&](double from, double to) { return to - from <= tolerance; }, steps);
  return problem.result(problem.evaluate(0.5 * (a + b)));  // callers need the solid at the root
}

template <DistensionSolver method>
DistensionResult shipped(const CrushCurve& curve, const Tillotson& eos, const State& s, double tolerance) {
  return solve_distension(curve, eos, s.rho, s.e, s.alpha_old, {method, tolerance});
}

struct Method {
  const char* name;
  DistensionResult (*solve)(const CrushCurve&, const Tillotson&, const State&, double);
};
constexpr Method methods[]{{"safe Newton", shipped<DistensionSolver::safe_newton>},
                           {"TOMS 748", toms748},
                           {"bisection", shipped<DistensionSolver::bisection>},
                           {"Newton", shipped<DistensionSolver::newton>}};

/// Bodies from slightly expanded to far beyond full compaction, cold to hot, that a step has taken over the crush
/// curve: only for these is there a root to find.
std::vector<State> crushing_states(const CrushCurve& curve, const Tillotson& eos, std::size_t count) {
  std::mt19937_64 random(12345);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<State> states;
  while (states.size() < count) {
    const double e = std::pow(10, 2 + 4.5 * uniform(random));
    const double alpha_old = 1 + (curve.initial_distension - 1) * uniform(random);
    const double rho = eos.rho0 * (0.97 + (alpha_old - 0.87) * uniform(random)) / alpha_old;
    distension::Problem<Tillotson> problem{curve, eos, rho, e, alpha_old, 0};
    if (problem.evaluate(alpha_old).residual < 1e-9) continue;
    const double exact = std::numeric_limits<double>::epsilon() / 4;  // less than the distance of neighbours
    problem.tolerance = exact;
    const bool solid = problem.evaluate(1).residual >= 0;
    states.push_back({rho, e, alpha_old, solid ? 1.0 : distension::bisect(problem, 1.0, alpha_old).alpha});
  }
  return states;
}

struct Work {
  std::vector<double> errors, nanoseconds;  ///< of the converged states; of a root, in each block
  double evaluations = 0;
  std::size_t failures = 0;
};

double middle(std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

void measure(const char* name, const CrushCurve& curve, const Tillotson& eos, std::size_t count) {
  using Clock = std::chrono::steady_clock;
  constexpr int finest = 15;  // tolerances 1e-1 to 1e-15
  constexpr std::size_t blocks = 25;
  const std::vector<State> states = crushing_states(curve, eos, count);
  std::vector<DistensionResult> results(count);
  Work work[finest][std::size(methods)];
  for (std::size_t block = 0; block < blocks; ++block)
    for (int digits = 1; digits <= finest; ++digits)
      for (std::size_t m = 0; m < std::size(methods); ++m) {
        const std::size_t begin = block * count / blocks, end = (block + 1) * count / blocks;
        const double tolerance = std::pow(10, -digits);
        const auto start = Clock::now();
        for (std::size_t i = begin; i < end; ++i) results[i] = methods[m].solve(curve, eos, states[i], tolerance);
        const std::chrono::duration<double, std::nano> time = Clock::now() - start;
        Work& w = work[digits - 1][m];
        w.nanoseconds.push_back(time.count() / static_cast<double>(end - begin));
        for (std::size_t i = begin; i < end; ++i) {
          w.evaluations += results[i].evaluations / static_cast<double>(count);
          w.failures += !results[i].converged;
          if (results[i].converged) w.errors.push_back(std::abs(results[i].alpha - states[i].root));
        }
      }
  for (int digits = 1; digits <= finest; ++digits)
    for (std::size_t m = 0; m < std::size(methods); ++m) {
      Work& w = work[digits - 1][m];
      const double largest = w.errors.empty() ? std::nan("") : *std::ranges::max_element(w.errors);
      std::printf("%s,%s,1e-%d,%zu,%zu,%.6g,%.6g,%.3f,%.2f\n", name, methods[m].name, digits, count, w.failures,
                  largest, middle(w.errors), w.evaluations, middle(w.nanoseconds));
    }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2) {
    std::fprintf(stderr, "usage: solver_work [number of states]\n");
    return 2;
  }
  const std::size_t count = argc == 2 ? std::strtoul(argv[1], nullptr, 10) : 100000;
  const Material pumice = read_material("pumice", {EJECTA_SOURCE_DIR "/inputs/materials"});
  const CrushCurve two_power = pumice.porosity->curve;
  const auto quadratic =
      CrushCurve::quadratic(two_power.initial_distension, two_power.elastic_pressure, two_power.solid_pressure);
  std::puts(
      "curve,method,tolerance,states,failures,largest error [1],median error [1],evaluations a root [1],"
      "time a root [ns]");
  measure("two powers", two_power, std::get<Tillotson>(pumice.eos), count);
  measure("quadratic", quadratic, std::get<Tillotson>(pumice.eos), count);
}
