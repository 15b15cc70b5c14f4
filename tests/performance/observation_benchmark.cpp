/// What is made of the particles during a run: fragments and slice images. About 50 000 particles, one thread.
#include <benchmark/benchmark.h>

#include "base/parallel.hpp"
#include "render/sampling.hpp"
#include "schemes/kernels.hpp"
#include "simulation/fragments.hpp"
#include "unit/simulation/small_scenes.hpp"

namespace ejecta {
namespace {

std::unique_ptr<Simulation<3>> body() {
  set_threads(1);
  return start<3>(porous_impact, {"resolution.spacing=1.55 mm"});
}
std::array<std::span<const double>, 3> vectors(const Particles<3>& p, Field f) {
  return {p.column(f, 0), p.column(f, 1), p.column(f, 2)};
}

void fragment_search(benchmark::State& state) {
  const auto sim = body();
  const auto& p = sim->particles;
  const FragmentInput input{vectors(p, Field::position), vectors(p, Field::velocity), p.column(Field::mass),
                            p.column(Field::density),    p.column(Field::damage),     p.column(Field::distension),
                            p.label(Label::id),          p.label(Label::body),        p.label(Label::material)};
  for (auto _ : state) benchmark::DoNotOptimize(find_groups(input, sim->scene.fragments));
  state.counters["particles_per_s"] =
      benchmark::Counter(static_cast<double>(p.size()), benchmark::Counter::kIsIterationInvariantRate);
}

void slice_image(benchmark::State& state) {
  const auto sim = body();
  const auto& p = sim->particles;
  const ParticleView view{vectors(p, Field::position), p.column(Field::mass), p.column(Field::density),
                          p.column(Field::smoothing_length)};
  const std::vector<FieldView> fields{{"pressure", "Pa", {p.column(Field::pressure)}},
                                      {"distension", "1", {p.column(Field::distension)}}};
  const KernelShape kernel{WendlandC2::support, [](double q) { return WendlandC2::norm<3> * WendlandC2::value(q); }};
  const PixelGrid grid = centred_grid(480, 360, {0, 0}, 0.12);
  for (auto _ : state) benchmark::DoNotOptimize(sample_slice(view, fields, kernel, grid));
  state.counters["pixels_per_s"] = benchmark::Counter(480 * 360, benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK(fragment_search)->Unit(benchmark::kMillisecond);
BENCHMARK(slice_image)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ejecta
