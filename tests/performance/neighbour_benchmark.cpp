/// Finding neighbours: pair_list_build/<dimension>/<particles a cluster> and spatial_order/<dimension>, from the order
/// that particles have after a while (their own order is sorted already, which is the usual case). What bounds them is
/// memory; the bytes are the least that must pass.
#include "particles/spatial_order.hpp"
#include "performance/bodies.hpp"
#include "performance/measure.hpp"

namespace ejecta {
namespace {

constexpr double particles = 50000;

/// Reads position, smoothing length, velocity and mass of every particle; writes the candidates of every cluster.
template <int Dim>
void pair_list_build(benchmark::State& state) {
  auto& sim = body<Dim>("pumice", particles);
  const auto cluster = static_cast<std::size_t>(state.range(0));
  std::vector<std::uint32_t> order;
  spatial_order(sim.particles, cluster, order);
  sim.particles.reorder(order);
  PairLists<Dim> lists;
  Measurement measured(state);
  measured.run([&] { lists.build(sim.particles, {2, cluster, 0, {}}); });
  const auto n = static_cast<double>(sim.particles.size()), clusters = static_cast<double>(lists.clusters().size());
  measured.items(n);
  measured.counter("candidates", lists.mean_candidates());
  measured.bytes(n * (2 * Dim + 2) * sizeof(double) + clusters * lists.mean_candidates() * sizeof(std::uint32_t));
}

/// Every halving reads the positions and the order once; log2(n / 8) halvings.
template <int Dim>
void spatial_sort(benchmark::State& state) {
  auto& sim = body<Dim>("pumice", particles);
  std::vector<std::uint32_t> order;
  Measurement measured(state);
  measured.run([&] { spatial_order(sim.particles, 8, order); });
  const auto n = static_cast<double>(sim.particles.size());
  measured.items(n);
  measured.bytes(std::log2(n / 8) * n * (Dim * sizeof(double) + sizeof(std::uint32_t)));
}

BENCHMARK(pair_list_build<2>)->Name("pair_list_build/2d/cluster")->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond);
BENCHMARK(pair_list_build<3>)->Name("pair_list_build/3d/cluster")->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond);
BENCHMARK(spatial_sort<2>)->Name("spatial_order/2d")->Unit(benchmark::kMillisecond);
BENCHMARK(spatial_sort<3>)->Name("spatial_order/3d")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ejecta
