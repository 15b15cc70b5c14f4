#pragma once
/// Scenes of a few hundred particles that go through all of the core, and how to look at them by particle id.
#include <memory>
#include <string>
#include <vector>

#include "material/material_reader.hpp"
#include "scene/scene_reader.hpp"
#include "simulation/simulation.hpp"
#include "sph/diagnostics.hpp"
#include "sph/sph.hpp"

namespace ejecta {

/// A nylon ball at 3 km/s into porous, brittle pumice: 3D, about 560 particles.
inline const std::string porous_impact = R"([scene]
name = "porous_impact"
[resolution]
spacing = "7 mm"
[time]
end = "1 ms"
[[bodies]]
name = "target"
material = "pumice"
radius = "35 mm"
[[bodies]]
name = "ball"
material = "nylon"
radius = "10 mm"
center = [0, 0, "47 mm"]
velocity = [0, "200 m/s", "-3 km/s"]
)";

/// Dense and thin gas in a closed 2D tube: 480 particles.
inline const std::string gas_tube = R"([scene]
name = "gas_tube"
dimension = 2
[resolution]
spacing = "25 mm"
[time]
end = "1 s"
[[bodies]]
name = "left"
material = "air"
shape = "rectangle"
center = ["-0.5 m", 0]
size = ["1 m", "0.2 m"]
density = "1 kg/m^3"
pressure = "1 Pa"
[[bodies]]
name = "right"
material = "air"
shape = "rectangle"
center = ["0.5 m", 0]
size = ["1 m", "0.2 m"]
density = "0.25 kg/m^3"
pressure = "0.1 Pa"
spacing_factor = 2
[numerics]
density = "summation"
[boundary]
x = "reflecting"
y = "periodic"
min = ["-1 m", "-0.1 m"]
max = ["1 m", "0.1 m"]
)";

template <int Dim>
std::unique_ptr<Sph<Dim>> start(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const Scene scene = parse_scene(text, "test.toml", overrides);
  return set_up<Dim>(scene, read_materials(scene, EJECTA_SOURCE_DIR "/inputs/materials").list);
}

/// One step of the particles alone.
template <int Dim>
Vote step(Sph<Dim>& sph, double dt_limit) {
  return step(sph, sph.scene, dt_limit);
}

template <int Dim>
void evaluate(Sph<Dim>& sph) {
  sph.evaluate();
}

inline constexpr double no_limit = 1e300;  ///< for step(): no event to clip the step to

template <int Dim>
void advance(Sph<Dim>& sim, int steps) {
  for (int k = 0; k < steps; ++k) step(sim, no_limit);
}

/// A column by particle id, whatever the present order.
template <int Dim>
std::vector<double> by_id(const Particles<Dim>& p, Field f, int component = 0) {
  std::vector<double> values(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    values[static_cast<std::size_t>(p.label(Label::id)[i])] = p.column(f, component)[i];
  return values;
}

/// Place of the particle with this id.
template <int Dim>
std::size_t place_of(const Particles<Dim>& p, std::int32_t id) {
  std::size_t i = 0;
  while (p.label(Label::id)[i] != id) ++i;
  return i;
}

}  // namespace ejecta
