/// Pair passes and pair lists of a porous body of about 50 000 particles with some 70 neighbours, one thread.
#include <benchmark/benchmark.h>

#include "base/parallel.hpp"
#include "particles/spatial_order.hpp"
#include "performance/peak.hpp"
#include "unit/simulation/small_scenes.hpp"

namespace ejecta {
namespace {

std::unique_ptr<Simulation<3>> body(const std::vector<std::string>& more) {
  set_threads(1);
  std::vector<std::string> overrides{"resolution.spacing=1.55 mm"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return start<3>(porous_impact, overrides);
}

/// Mean number of particles within the support 2 h.
double mean_neighbours(const Simulation<3>& sim) {
  const auto& p = sim.particles;
  std::size_t pairs = 0, members = 0;
  for (std::size_t c = 0; c < sim.lists.clusters().size(); c += 50) {
    const Cluster& cluster = sim.lists.clusters()[c];
    for (std::size_t i = cluster.begin; i < cluster.end; ++i, ++members)
      for (const std::uint32_t j : sim.lists.candidates(c))
        pairs += i != j && (p.vector(Field::position, i) - p.vector(Field::position, j)).norm() <
                               2 * p.column(Field::smoothing_length)[i];
  }
  return static_cast<double>(pairs) / static_cast<double>(members);
}

/// Additions and multiplications per lane and candidate, counted in the source of the pair loop (3D, stress).
constexpr double operations = 134, operations_of_correction = 12;

template <class T>
void pair_rates(benchmark::State& state, const std::vector<std::string>& overrides, double operations_per_lane) {
  const auto sim = body(overrides);
  for (auto _ : state) sim->pass->rates(sim->particles, sim->lists, sim->intact);
  const auto n = static_cast<double>(sim->particles.size());
  const auto clusters = static_cast<double>(sim->lists.clusters().size());
  using benchmark::Counter;
  const double lanes = sim->lists.mean_candidates() * clusters * simd::lanes<T>;
  state.counters["particles_per_s"] = Counter(n, Counter::kIsIterationInvariantRate);
  state.counters["neighbours"] = mean_neighbours(*sim);
  state.counters["candidates"] = sim->lists.mean_candidates();
  state.counters["share_of_peak"] =
      Counter(lanes * operations_per_lane / peak_operations<T>(), Counter::kIsIterationInvariantRate);
}

void pair_rates_double(benchmark::State& state) { pair_rates<double>(state, {}, operations); }
void pair_rates_mixed(benchmark::State& state) { pair_rates<float>(state, {"numerics.precision=mixed"}, operations); }
void pair_rates_double_corrected(benchmark::State& state) {
  pair_rates<double>(state, {"numerics.gradient_correction=true"}, operations + operations_of_correction);
}
void pair_rates_mixed_corrected(benchmark::State& state) {
  pair_rates<float>(state, {"numerics.precision=mixed", "numerics.gradient_correction=true"},
                    operations + operations_of_correction);
}

void pair_list_build(benchmark::State& state) {
  const auto sim = body({});
  PairLists<3> lists;
  for (auto _ : state) lists.build(sim->particles, {2, 8, 0, {}});
  state.counters["particles_per_s"] =
      benchmark::Counter(static_cast<double>(sim->particles.size()), benchmark::Counter::kIsIterationInvariantRate);
}
void spatial_sort(benchmark::State& state) {
  const auto sim = body({});
  std::vector<std::uint32_t> order;
  for (auto _ : state) spatial_order(sim->particles, 8, order);
  state.counters["particles_per_s"] =
      benchmark::Counter(static_cast<double>(sim->particles.size()), benchmark::Counter::kIsIterationInvariantRate);
}
/// All stages of a step.
void whole_step(benchmark::State& state) {
  const auto sim = body({});
  for (auto _ : state) step(*sim, no_limit);
  state.counters["particles_per_s"] =
      benchmark::Counter(static_cast<double>(sim->particles.size()), benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK(pair_rates_double)->Unit(benchmark::kMillisecond);
BENCHMARK(pair_rates_mixed)->Unit(benchmark::kMillisecond);
BENCHMARK(pair_rates_double_corrected)->Unit(benchmark::kMillisecond);
BENCHMARK(pair_rates_mixed_corrected)->Unit(benchmark::kMillisecond);
BENCHMARK(pair_list_build)->Unit(benchmark::kMillisecond);
BENCHMARK(spatial_sort)->Unit(benchmark::kMillisecond);
BENCHMARK(whole_step)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ejecta
