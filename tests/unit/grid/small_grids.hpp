#pragma once
/// Scenes on grids, and how to run them.
#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

#include "grid/grid.hpp"
#include "grid/grid_package.hpp"
#include "material/material_reader.hpp"
#include "scene/scene_reader.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

inline SceneSection grid_section() { return grid_package().section; }

template <int Dim>
std::unique_ptr<Grid<Dim>> make_grid(const std::string& toml, const std::vector<std::string>& overrides = {}) {
  const Scene scene = parse_scene(toml, "grid.toml", overrides, {{grid_section()}, {}});
  const Materials materials = read_materials(scene, EJECTA_SOURCE_DIR "/inputs/materials");
  return std::make_unique<Grid<Dim>>(scene, materials.list);
}

/// Steps to the end of the scene; returns their number.
inline int run_to_end(Package& grid, const Scene& scene) {
  int steps = 0;
  for (; grid.clock.time < scene.time_end * (1 - 1e-12); ++steps) step(grid, scene, scene.time_end - grid.clock.time);
  return steps;
}

/// Gas in a box of `size` [m] about the origin with the faces and profile that are given.
inline std::string gas_box(int dimension, const std::string& size, double spacing, double end, const std::string& more) {
  return fmt::format(R"([scene]
name = "box"
dimension = {}
[resolution]
spacing = "{} m"
[time]
end = "{} s"
[numerics]
scheme = "fvm"
[[bodies]]
name = "gas"
material = "air"
shape = "{}"
size = [{}]
density = "1 kg/m^3"
pressure = "1 Pa"
{}
)",
                     dimension, spacing, end, dimension == 2 ? "rectangle" : "box", size, more);
}

}  // namespace ejecta
