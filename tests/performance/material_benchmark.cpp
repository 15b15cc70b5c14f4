/// The stages of a run that are physics of one particle: stage/<name>/<dimension>/<state>. States are random, and put
/// back before every pass with the clock stopped. Most move more bytes than they compute; the bytes counted are the
/// columns read plus those written.
#include <random>

#include "material/distension_solver.hpp"
#include "performance/bodies.hpp"
#include "performance/flops.hpp"
#include "performance/measure.hpp"

namespace ejecta {
namespace {

constexpr double particles = 150000;
const std::vector<std::string> without_pores{"materials.pumice.porosity.model=none"};

void fill(Sph<3>& sim, Field f, double low, double high) {
  std::mt19937_64 random(static_cast<unsigned>(f) + 1);
  std::uniform_real_distribution<double> uniform(low, high);
  for (int k = 0; k < components(info(f).shape, 3); ++k)
    for (double& value : sim.particles.column(f, k)) value = uniform(random);
}

/// Runs one stage again and again, each time from the values that the body holds now.
Measurement measure_stage(benchmark::State& state, Sph<3>& sim, const std::string& name) {
  const auto stage = std::find_if(sim.stages.begin(), sim.stages.end(), [&](const auto& s) { return s.name == name; });
  const Particles<3> saved = sim.particles;
  Measurement measured(state);
  measured.run([&] { stage->run(sim); },
               [&] {
                 for (const Field f : stage->writes)
                   for (int k = 0; k < components(info(f).shape, 3); ++k)
                     std::ranges::copy(saved.column(f, k), sim.particles.column(f, k).begin());
               });
  measured.items(static_cast<double>(sim.particles.size()));
  return measured;
}
double bytes_of_columns(const Sph<3>& sim, int columns) {
  return static_cast<double>(sim.particles.size()) * columns * sizeof(double);
}
/// Share of the particles for which it is true.
template <class Predicate>
double share_of(const Sph<3>& sim, Predicate&& predicate) {
  double count = 0;
  for (std::size_t i = 0; i < sim.particles.size(); ++i) count += predicate(i);
  return count / static_cast<double>(sim.particles.size());
}

/// Density and energy in, pressure and sound speed out.
void dense(benchmark::State& state, Sph<3>& sim, std::array<double, 2> densities, std::array<double, 2> energies) {
  fill(sim, Field::density, densities[0], densities[1]);
  fill(sim, Field::specific_energy, energies[0], energies[1]);
  measure_stage(state, sim, "equation of state").bytes(bytes_of_columns(sim, 4));
}
void ideal_gas(benchmark::State& state) { dense(state, body<3>("air", particles), {1, 10}, {1e4, 1e6}); }
void tillotson_condensed(benchmark::State& state) {
  dense(state, body<3>("pumice", particles, without_pores), {2327, 3000}, {0, 1e6});
}
/// Compressed and expanded; cold, partly vaporised and vapour.
void tillotson_everywhere(benchmark::State& state) {
  dense(state, body<3>("pumice", particles, without_pores), {500, 3500}, {0, 25e6});
}

/// `compression`: by how much particles are denser than their distension makes them at rest, at most.
void porous(benchmark::State& state, double compression, double most_energy) {
  auto& sim = body<3>("pumice", particles);
  const auto rho = sim.particles.column(Field::density), energy = sim.particles.column(Field::specific_energy),
             alpha = sim.particles.column(Field::distension);
  fill(sim, Field::distension, 1, sim.materials[0].porosity->initial_distension());
  fill(sim, Field::density, 1, 1 + compression);
  fill(sim, Field::specific_energy, 0, most_energy);
  const auto& eos = std::get<Tillotson>(sim.materials[0].eos);
  double evaluations = 0;
  for (std::size_t i = 0; i < rho.size(); ++i) {
    rho[i] *= eos.rho0 / alpha[i];
    evaluations += solve_distension(sim.materials[0].porosity->curve, eos, rho[i], energy[i], alpha[i],
                                    {sim.scene.numerics.distension_solver, sim.scene.numerics.distension_tolerance})
                       .evaluations;
  }
  auto measured = measure_stage(state, sim, "equation of state");
  measured.counter("evaluations", evaluations / static_cast<double>(rho.size()));
  measured.flops<double>(evaluations * flops::distension_residual);
}
void porous_crushing(benchmark::State& state) { porous(state, 0.15, 1e5); }
/// Too little pressure to crush anything: most particles of a run, most of the time.
void porous_at_rest(benchmark::State& state) { porous(state, 0, 100); }

/// Reads 5 deviators, pressure, energy, damage, distension; writes 5 deviators.
void strength(benchmark::State& state) {
  auto& sim = body<3>("pumice", particles);
  fill(sim, Field::deviatoric_stress, -30e6, 30e6);
  fill(sim, Field::pressure, -1e6, 1e8);
  fill(sim, Field::specific_energy, 0, 1e5);
  fill(sim, Field::distension, 1, 3.3);
  fill(sim, Field::plastic_strain, 0, 0);
  auto measured = measure_stage(state, sim, "strength");
  measured.bytes(bytes_of_columns(sim, 9 + 5));
  measured.counter("yielding",
                   share_of(sim, [&](auto i) { return sim.particles.column(Field::plastic_strain)[i] > 0; }));
}

/// Reads 5 deviators, the weakest flaw, pressure, crack, strain, damage, distension, and where cracks grow sound speed,
/// mass and density; writes pressure, crack, strain, damage and the intact share.
void damage(benchmark::State& state) {
  auto& sim = body<3>("pumice", particles);
  fill(sim, Field::deviatoric_stress, -3e6, 3e6);
  fill(sim, Field::pressure, -1e7, 1e7);
  fill(sim, Field::distension, 1, 3.3);
  fill(sim, Field::crack_length, 0, 0.5);
  fill(sim, Field::local_strain, 0, 0);
  fill(sim, Field::damage, 0, 0);
  auto measured = measure_stage(state, sim, "damage");
  measured.bytes(bytes_of_columns(sim, 14 + 5));
  measured.counter("growing", share_of(sim, [&](auto i) {
                     return sim.particles.column(Field::local_strain)[i] >= sim.particles.column(Field::flaw_strain)[i];
                   }));
}

BENCHMARK(ideal_gas)->Name("stage/equation_of_state/3d/ideal_gas")->Unit(benchmark::kMillisecond);
BENCHMARK(tillotson_condensed)->Name("stage/equation_of_state/3d/tillotson_condensed")->Unit(benchmark::kMillisecond);
BENCHMARK(tillotson_everywhere)->Name("stage/equation_of_state/3d/tillotson_everywhere")->Unit(benchmark::kMillisecond);
BENCHMARK(porous_at_rest)->Name("stage/equation_of_state/3d/porous_at_rest")->Unit(benchmark::kMillisecond);
BENCHMARK(porous_crushing)->Name("stage/equation_of_state/3d/porous_crushing")->Unit(benchmark::kMillisecond);
BENCHMARK(strength)->Name("stage/strength/3d")->Unit(benchmark::kMillisecond);
BENCHMARK(damage)->Name("stage/damage/3d")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ejecta
