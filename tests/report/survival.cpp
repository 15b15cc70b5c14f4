/// Impacts of every shipped material into every other, many small runs side by side, each on one thread: a table (CSV)
/// on standard output, a line per run as it ends. Exit code 1 if any of them was not survived.
#include <atomic>
#include <cstdio>
#include <mutex>
#include <thread>

#include "base/parallel.hpp"
#include "scene/scene_reader.hpp"
#include "survival_judge.hpp"
#include "survival_runs.hpp"

namespace {

using namespace ejecta;
using namespace ejecta::survival;

template <int Dim>
Verdict attempt(const Run& run, const std::vector<Material>& materials, const std::vector<std::string>& settings) {
  const bool gas = material_named(materials, run.ball).gas() || material_named(materials, run.target).gas();
  try {
    const Scene scene = parse_scene(scene_of(run, materials), "survival.toml", settings);
    const auto sim = set_up<Dim>(scene, read_materials(scene, EJECTA_SOURCE_DIR "/inputs/materials").list);
    return judge(*sim, 1e3 * run.speed, gas);
  } catch (const SimulationError& error) {
    return {.kind = "first evaluation", .message = error.what()};
  } catch (const InputError& error) {
    return {.kind = "refused", .message = error.what()};
  }
}

std::string row(const Run& run, Verdict v) {
  std::ranges::replace(v.message, '"', '\'');
  return fmt::format("{},{},{},{},{},{},{},{},{:.4f},{:.3g},{:.3g},{},{:.3f},{:.4g},{:.4g},{:.4g},\"{}\"\n",
                     run.variant, run.ball, run.target, run.speed, v.kind, v.particles, v.steps, v.short_steps,
                     v.reached, v.energy_error, v.least_energy, v.negative, v.fastest, v.thinnest, v.densest,
                     v.densest_spray, v.message);
}

/// Returns how many failed. `settings` as for --set.
std::size_t survive(const std::vector<Run>& runs, const std::vector<Material>& materials,
                    const std::vector<std::string>& settings) {
  std::puts(
      "variant,ball,target,speed [km/s],outcome,particles,steps,short steps,time reached [1],energy error [1],least "
      "energy [v^2/2],negative energies,fastest [v],thinnest [m/spacing^d],densest [m/spacing^d],densest spray "
      "[m/spacing^d],message");
  std::atomic<std::size_t> next = 0, failures = 0;
  std::mutex output;
  auto work = [&] {
    set_threads(1);
    for (std::size_t k = next++; k < runs.size(); k = next++) {
      const Run& run = runs[k];
      const Verdict verdict =
          run.dimension() == 2 ? attempt<2>(run, materials, settings) : attempt<3>(run, materials, settings);
      const std::lock_guard lock(output);
      std::fputs(row(run, verdict).c_str(), stdout);
      std::fflush(stdout);
      if (verdict.kind == "survived") continue;
      ++failures;
      std::fprintf(stderr, "%s: %s %s\n", run.name().c_str(), verdict.kind.c_str(), verdict.message.c_str());
    }
  };
  std::vector<std::thread> threads;
  for (int t = 0; t < available_cores(); ++t) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  std::fprintf(stderr, "%zu runs, %zu failed\n", runs.size(), failures.load());
  return failures;
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::string> words(argv + 1, argv + argc), settings;
  for (; words.size() > 2 && words[0] == "--set"; words.erase(words.begin(), words.begin() + 2))
    settings.push_back(words[1]);
  // What detonates flies faster than anything that hits it.
  std::vector<Material> materials = shipped_materials();
  std::erase_if(materials, [](const Material& m) { return m.explosive().has_value(); });
  const std::string what = words.empty() ? "" : words[0];
  if (what == "--scene" && words.size() == 2) {
    std::fputs(scene_of(parse_run(words[1], materials), materials).c_str(), stdout);
    return 0;
  }
  std::vector<Run> runs;
  if (what == "--quick" && words.size() == 1) runs = spread(materials);
  if (what == "--2d" && words.size() == 1) runs = every_pair(materials);
  if (what == "--variants" && words.size() == 1) runs = every_variant(materials);
  if (what == "--run")
    for (std::size_t k = 1; k < words.size(); ++k) runs.push_back(parse_run(words[k], materials));
  if (runs.empty()) {
    std::fputs(
        "usage: survival [--set key=value]... --quick | --2d | --variants | --run \"iron into ice 10 3d\"...\n"
        "       survival --scene \"iron into ice 10 3d\"\n",
        stderr);
    return 2;
  }
  return survive(runs, materials, settings) == 0 ? 0 : 1;
} catch (const InputError& error) {
  std::fprintf(stderr, "survival: %s\n", error.what());
  return 2;
}
