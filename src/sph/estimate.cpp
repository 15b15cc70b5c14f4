/// What particles will cost.
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "material/material_reader.hpp"
#include "sph/particle_package.hpp"
#include "sph/shapes.hpp"
#include "sph/stages.hpp"

namespace ejecta {

namespace {

/// Pair lists, records and sums over the surroundings of a particle, measured with a solid in 3D at about 70
/// neighbours.
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

Estimate estimate_particles(const Scene& scene, const std::vector<Material>& materials) {
  Estimate e{.element = "particle"};
  double least_step = std::numeric_limits<double>::infinity();
  const Numerics& n = scene.numerics;
  for (const Body& body : scene.bodies) {
    const double spacing = scene.spacing * body.spacing_factor;
    e.elements += volume(body, scene.dimension) / std::pow(spacing, scene.dimension);
    const auto material =
        std::find_if(materials.begin(), materials.end(), [&](const Material& m) { return m.name == body.material; });
    const double sound = resting_sound_speed(*material, body);
    least_step = std::min(least_step, n.courant * n.nodes_per_h * spacing / (sound * (1 + 0.6 * n.damping_alpha())));
  }
  e.bytes_each = bytes_of_lists +
                 (scene.dimension == 2 ? bytes_of_columns<2>(scene, materials) : bytes_of_columns<3>(scene, materials));
  e.steps = scene.time_end / least_step;
  if (scene.max_steps) e.steps = std::min(e.steps, static_cast<double>(*scene.max_steps));
  const int threads = max_threads();
  e.seconds = e.elements * e.steps / (particle_steps_per_s * threads);
  return e;
}

}  // namespace ejecta
