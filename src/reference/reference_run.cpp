#include "reference/reference_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "model/shock_front.hpp"

namespace ejecta {

namespace {

constexpr int records = 200;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

RadialProfile profile_of(const RadialFlow& flow) {
  const auto copy = [](std::span<const double> values) { return std::vector<double>(values.begin(), values.end()); };
  return {flow.time(),           copy(flow.position()), copy(flow.density()),
          copy(flow.velocity()), copy(flow.pressure()), copy(flow.specific_energy())};
}

ShockRecord shock_of(const RadialFlow& flow, double ambient) {
  const auto front = find_shock_front(flow.position(), flow.pressure(), ambient);
  const auto densest = std::ranges::max_element(flow.density()) - flow.density().begin();
  const auto i = static_cast<std::size_t>(densest);
  return {flow.time(), front ? front->radius : none, front ? front->peak_pressure : none, flow.density()[i],
          flow.position()[i]};
}

bool same(const GasState& a, const GasState& b) {
  return a.density == b.density && a.velocity == b.velocity && a.pressure == b.pressure;
}

}  // namespace

std::size_t ReferenceRun::shock_at(double time) const {
  return static_cast<std::size_t>(std::ranges::find(shocks, time, &ShockRecord::time) - shocks.begin());
}

double ReferenceRun::shock_speed(std::size_t record) const {
  // The radius is wrong by some hundredths of a cell, which must not be divided by next to nothing.
  constexpr double apart = 1.1;
  const auto before = [&](std::size_t k) {
    for (std::size_t i = k; i-- > 0;)
      if (shocks[i].time * apart <= shocks[k].time) return i;
    return k;
  };
  const auto after = [&](std::size_t k) {
    for (std::size_t i = k + 1; i < shocks.size(); ++i)
      if (shocks[i].time >= shocks[k].time * apart) return i;
    return k;
  };
  std::size_t a = before(record), b = record, c = after(record);
  if (c == b) b = a, a = before(b);
  if (a == b) a = b, b = after(a), c = after(b);
  if (a == b || b == c) return none;
  const auto x = [&](std::size_t k) { return std::log(shocks[k].time); };
  const auto y = [&](std::size_t k) { return std::log(shocks[k].radius); };
  const double first = (y(b) - y(a)) / (x(b) - x(a)), second = (y(c) - y(b)) / (x(c) - x(b));
  const double curvature = (second - first) / (x(c) - x(a));
  return shocks[record].radius / shocks[record].time * (first + curvature * (2 * x(record) - x(a) - x(b)));
}

ReferenceRun run_reference(const RadialProblem& problem, double spacing, std::span<const double> times) {
  const auto begin = std::chrono::steady_clock::now();
  ReferenceRun run;
  run.spacing = spacing;
  RadialFlow flow = start_flow(problem, spacing);
  std::vector<double> stops(times.begin(), times.end());
  if (problem.blast)
    for (int k = 1; k < records; ++k) stops.push_back(times.back() * k / records);
  std::ranges::sort(stops);
  // Times that differ by round-off are one: the one that was asked for.
  const auto asked = [&](double t) { return std::ranges::find(times, t) != times.end(); };
  for (std::size_t k = 0; k < stops.size(); ++k) {
    const auto near = [&](std::size_t other) {
      return std::abs(stops[other] - stops[k]) <= 1e-9 * stops[k] && asked(stops[other]);
    };
    if (!asked(stops[k]) && ((k > 0 && near(k - 1)) || (k + 1 < stops.size() && near(k + 1)))) continue;
    if (stops[k] == flow.time()) continue;
    flow.advance_to(stops[k]);
    if (problem.blast) run.shocks.push_back(shock_of(flow, problem.blast->ambient_pressure));
    if (asked(stops[k])) run.profiles.push_back(profile_of(flow));
  }
  run.errors = flow.errors();
  run.steps = flow.steps();
  run.cell_steps = flow.cell_steps();
  run.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return run;
}

double density_behind_shock(double gamma, double density, double pressure, double speed) {
  const double square = speed * speed * density / (gamma * pressure), mach2 = square < 1 ? 1 : square;
  return density * (gamma + 1) * mach2 / ((gamma - 1) * mach2 + 2);
}

std::optional<RiemannProblem> riemann_problem(const RadialProblem& problem) {
  const IdealGas* gas = std::get_if<IdealGas>(&problem.eos);
  if (!gas || problem.geometry != Geometry::planar || problem.lower == RadialEdge::periodic || problem.bodies != 2 ||
      !problem.uniform_bodies || problem.blast)
    return std::nullopt;
  const double inset = 1e-9 * (problem.end - problem.start);
  double low = problem.start + inset, high = problem.end - inset;
  const LinePoint l = problem.at(low), r = problem.at(high);
  if (l.body == r.body) return std::nullopt;
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
    (problem.at(middle).body == l.body ? low : high) = middle;
  const auto state = [&](const LinePoint& p) {
    return GasState{p.density, p.velocity, gas->evaluate(p.density, p.specific_energy).pressure};
  };
  // Bodies reach a trifle beyond their faces.
  const double trifle = 1e-11 * (problem.end - problem.start);
  return RiemannProblem{trifle * std::round(low / trifle), state(l), state(r),
                        ExactRiemann(state(l), state(r), gas->gamma)};
}

std::optional<MeanDifference> difference(const RadialProfile& profile, double spacing, const RiemannProblem& problem) {
  const auto exact = [&](double x) { return problem.exact.at((x - problem.interface) / profile.time); };
  if (!same(exact(profile.position.front()), problem.left) || !same(exact(profile.position.back()), problem.right))
    return std::nullopt;
  constexpr int samples = 16;
  MeanDifference mean{};
  for (std::size_t i = 0; i < profile.position.size(); ++i) {
    GasState cell{};
    for (int k = 0; k < samples; ++k) {
      const GasState s = exact(profile.position[i] + ((k + 0.5) / samples - 0.5) * spacing);
      cell.density += s.density / samples;
      cell.velocity += s.velocity / samples;
      cell.pressure += s.pressure / samples;
    }
    mean.density += std::abs(profile.density[i] - cell.density);
    mean.velocity += std::abs(profile.velocity[i] - cell.velocity);
    mean.pressure += std::abs(profile.pressure[i] - cell.pressure);
  }
  const double cells = static_cast<double>(profile.position.size());
  return MeanDifference{mean.density / cells, mean.velocity / cells, mean.pressure / cells};
}

MeanDifference difference(const RadialProfile& coarse, const RadialProfile& fine) {
  const std::size_t cells = std::min(coarse.position.size(), fine.position.size() / 2);
  const auto mean = [&](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < cells; ++i) sum += std::abs(a[i] - 0.5 * (b[2 * i] + b[2 * i + 1]));
    return sum / static_cast<double>(cells);
  };
  return {mean(coarse.density, fine.density), mean(coarse.velocity, fine.velocity),
          mean(coarse.pressure, fine.pressure)};
}

}  // namespace ejecta
