#include "app/resources.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "material/material_reader.hpp"
#include "schemes/kernels.hpp"
#include "sph/shapes.hpp"
#include "sph/stages.hpp"

namespace ejecta {

namespace {

/// Pair lists, records and sums over the surroundings of a particle, measured with a solid in 3D at about 70 neighbours.
constexpr double bytes_of_lists = 800;
/// Of one core, measured with the same solid (the shipped pumice scene, AVX-512 at 2.1 GHz).
constexpr double particle_steps_per_s = 0.22e6;

template <int Dim>
double bytes_of_columns(const Scene& scene, const std::vector<Material>& materials) {
  double doubles = 2, labels = 4;  // scratch for sorting, and the share of damaged stress
  for (Field f : fields_of(choose_stages<Dim>(scene, materials)))
    doubles += components(info(f).shape, Dim) * (f == Field::acceleration ? 2 : info(f).role == Role::rate ? 3 : 1);
  return doubles * sizeof(double) + labels * sizeof(std::int32_t);
}

double free_memory() {
  std::ifstream meminfo("/proc/meminfo");
  std::string key, unit;
  for (double kilobytes; meminfo >> key >> kilobytes >> unit;)
    if (key == "MemAvailable:") return 1024 * kilobytes;
  return std::numeric_limits<double>::infinity();
}

/// Speed of sound at rest [m/s].
double resting_sound_speed(const Material& material, const Body& body) {
  return std::visit(
      [&](const auto& eos) {
        const double rho = is_set(body.density) ? body.density : eos.reference_density();
        const double e = initial_energy(body, material, rho);
        const double c = sound_speed(eos.evaluate(rho, e), rho, eos.sound_speed_floor());
        const double shear = material.solid() ? 4 * material.elastic->shear_modulus / (3 * rho) : 0;
        return std::sqrt(c * c + shear);
      },
      material.eos);
}

}  // namespace

bool is_writable(const std::filesystem::path& folder) { return access(folder.c_str(), W_OK | X_OK) == 0; }

Estimate estimate(const Scene& scene, const std::vector<Material>& materials) {
  Estimate e;
  double least_step = std::numeric_limits<double>::infinity();
  const Numerics& n = scene.numerics;
  for (const Body& body : scene.bodies) {
    const double spacing = scene.spacing * body.spacing_factor;
    e.particles += volume(body, scene.dimension) / std::pow(spacing, scene.dimension);
    const auto material =
        std::find_if(materials.begin(), materials.end(), [&](const Material& m) { return m.name == body.material; });
    const double sound = resting_sound_speed(*material, body);
    least_step = std::min(least_step, n.courant * n.nodes_per_h * spacing / (sound * (1 + 0.6 * n.viscosity_alpha)));
  }
  e.bytes_per_particle = bytes_of_lists + (scene.dimension == 2 ? bytes_of_columns<2>(scene, materials)
                                                                : bytes_of_columns<3>(scene, materials));
  e.steps = scene.time_end / least_step;
  if (scene.max_steps) e.steps = std::min(e.steps, static_cast<double>(*scene.max_steps));
  const int threads = scene.threads.value_or(available_cores());
  e.seconds = e.particles * e.steps / (particle_steps_per_s * threads);
  return e;
}

void check_memory(const Scene& scene, const std::vector<Material>& materials) {
  const Estimate e = estimate(scene, materials);
  const double needed = e.particles * e.bytes_per_particle, free = free_memory();
  if (needed < free && e.particles < 2e9) return;
  throw InputError(
      fmt::format("{}: resolution.spacing: expected a scene that fits in the {:.1f} GB of free memory, got "
                  "{:.3g} particles that need {:.3g} GB",
                  scene.file, free / 1e9, e.particles, needed / 1e9));
}

std::string timer_table(std::span<const StageTimers::Entry> times) {
  double total = 0;
  for (const auto& e : times) total += e.seconds;
  std::string text = fmt::format("{:<22}{:>12}{:>9}{:>10}\n", "stage", "seconds", "share", "calls");
  for (const auto& e : times)
    text += fmt::format("{:<22}{:>12.3f}{:>8.1f}%{:>10}\n", e.name, e.seconds, 100 * e.seconds / total, e.calls);
  return text;
}

}  // namespace ejecta
