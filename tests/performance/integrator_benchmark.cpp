/// Time integration and whole steps: integrator/<predict|correct>/3d/<gas|rock> on more particles than a cache holds,
/// step/<dimension>/<precision>/<gas|rock> with all stages of a run.
#include "performance/bodies.hpp"
#include "performance/measure.hpp"
#include "sph/integrator.hpp"

namespace ejecta {
namespace {

/// Every column of a pair (state, rate): the state is read and written; the rate and the one before it are read.
constexpr int columns_moved(int pair_columns) { return 4 * pair_columns; }
constexpr int gas_pairs = 3 + 1;           // velocity, energy
constexpr int rock_pairs = 3 + 1 + 1 + 5;  // and density, deviatoric stress

Particles<3> columns(bool rock) {
  std::vector<Field> fields{Field::specific_energy, Field::specific_energy_rate};
  if (rock)
    fields.insert(fields.end(),
                  {Field::density, Field::compression_rate, Field::deviatoric_stress, Field::stress_rate});
  Particles<3> p;
  p.allocate(400000, fields);
  return p;
}

template <bool rock>
void prediction(benchmark::State& state) {
  Particles<3> p = columns(rock);
  Measurement measured(state);
  measured.run([&] { predict(p, 1e-9, 1e-9); });
  measured.items(static_cast<double>(p.size()));
  // Of the rates before only the acceleration is needed; positions are read and written.
  const int moved = 3 * (rock ? rock_pairs : gas_pairs) + 3 + 2 * 3;
  measured.bytes(static_cast<double>(p.size()) * moved * sizeof(double));
}

template <bool rock>
void correction(benchmark::State& state) {
  Particles<3> p = columns(rock);
  Measurement measured(state);
  measured.run([&] { correct(p, 1e-9); });
  measured.items(static_cast<double>(p.size()));
  measured.bytes(static_cast<double>(p.size()) * columns_moved(rock ? rock_pairs : gas_pairs) * sizeof(double));
}

template <int Dim>
void whole_step(benchmark::State& state, const std::string& material, const std::string& precision) {
  auto& sim = body<Dim>(material, 50000, {"numerics.precision=" + precision});
  Measurement measured(state);
  measured.run([&] { step(sim, no_limit); });
  measured.items(static_cast<double>(sim.particles.size()));
}

void step_2d_double_gas(benchmark::State& state) { whole_step<2>(state, "air", "double"); }
void step_3d_double_rock(benchmark::State& state) { whole_step<3>(state, "pumice", "double"); }
void step_3d_mixed_rock(benchmark::State& state) { whole_step<3>(state, "pumice", "mixed"); }

BENCHMARK(prediction<false>)->Name("integrator/predict/3d/gas")->Unit(benchmark::kMillisecond);
BENCHMARK(prediction<true>)->Name("integrator/predict/3d/rock")->Unit(benchmark::kMillisecond);
BENCHMARK(correction<false>)->Name("integrator/correct/3d/gas")->Unit(benchmark::kMillisecond);
BENCHMARK(correction<true>)->Name("integrator/correct/3d/rock")->Unit(benchmark::kMillisecond);
BENCHMARK(step_2d_double_gas)->Name("step/2d/double/gas")->Unit(benchmark::kMillisecond);
BENCHMARK(step_3d_double_rock)->Name("step/3d/double/rock")->Unit(benchmark::kMillisecond);
BENCHMARK(step_3d_mixed_rock)->Name("step/3d/mixed/rock")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ejecta
