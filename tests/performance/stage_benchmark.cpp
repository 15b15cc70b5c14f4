/// Every stage of a step, one by one, on matter that has just been set up: stages/<body>/<stage>. Where a stage has
/// little to do for matter at rest (votes, cracks, lists), it shows what it costs there.
#include "performance/bodies.hpp"
#include "performance/measure.hpp"

namespace ejecta {
namespace {

constexpr double particles = 50000;

struct StagedBody {
  std::string name, material;
  std::vector<std::string> overrides;
};

const std::vector<StagedBody>& staged_bodies() {
  static const std::vector<StagedBody> list{
      {"gas", "air", {}},
      {"rock", "pumice", {}},
      {"rock_asph", "pumice", {"numerics.scheme=asph"}},
      {"rock_tensor_damage",
       "pumice",
       {"numerics.scheme=asph", "materials.pumice.damage.model=grady_kipp_tensor",
        "materials.pumice.damage.weibull_m=9", "materials.pumice.damage.weibull_k=1e31 1/m^3"}}};
  return list;
}

/// Its share of a copy of memory is of the columns that it says it reads, and those that it says it writes.
void run_stage(benchmark::State& state, const StagedBody& of, std::size_t stage) {
  auto& sim = body<3>(of.material, particles, of.overrides);
  const Stage<3>& measured_stage = sim.stages[stage];
  Measurement measured(state);
  measured.run([&] { measured_stage.run(sim); });
  int columns = 0;
  for (const auto* list : {&measured_stage.reads, &measured_stage.writes})
    for (const Field f : *list) columns += components(info(f).shape, 3);
  const double n = static_cast<double>(sim.particles.size());
  measured.items(n);
  measured.bytes(n * columns * sizeof(double));
}

bool add_stages() {
  for (const StagedBody& of : staged_bodies()) {
    const auto& stages = body<3>(of.material, 500, of.overrides).stages;
    for (std::size_t k = 0; k < stages.size(); ++k)
      benchmark::RegisterBenchmark(("stages/" + of.name + "/" + stages[k].name).c_str(), [&of,
                                                                                          k](benchmark::State& state) {
        run_stage(state, of, k);
      })->Unit(benchmark::kMillisecond);
  }
  return true;
}

const bool added = add_stages();

}  // namespace
}  // namespace ejecta
