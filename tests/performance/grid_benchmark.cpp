/// Whole steps of a grid: grid_step/<dimension>/<ideal|tillotson> with every tile in motion, larger than a cache.
#include <fmt/format.h>

#include "performance/measure.hpp"
#include "unit/grid/small_grids.hpp"

namespace ejecta {
namespace {

/// A periodic box of waves, n cells along each edge.
std::string waves(int dimension, int n, const std::string& material) {
  const bool gas = material == "air";
  std::string size, low, high, velocity, faces;
  for (int a = 0; a < dimension; ++a) {
    const std::string_view comma = a > 0 ? ", " : "";
    size += fmt::format("{}\"1 m\"", comma);
    low += fmt::format("{}\"-0.5 m\"", comma);
    high += fmt::format("{}\"0.5 m\"", comma);
    velocity += fmt::format("{}\"{}*sin(6.283185307*({} + 0.3*x))\"", comma, gas ? 0.1 : 10, "xyz"[a]);
    faces += fmt::format("{} = \"periodic\"\n", "xyz"[a]);
  }
  std::string scene =
      gas_box(dimension, size, 1.0 / n, 1, fmt::format("[bodies.profile]\nvelocity = [{}]\n[boundary]\n{}min = [{}]\nmax = [{}]\n",
                                                       velocity, faces, low, high));
  if (gas) return scene;
  const auto replace = [&](const std::string& a, const std::string& b) { scene.replace(scene.find(a), a.size(), b); };
  replace("\"air\"", '"' + material + '"');
  replace("density = \"1 kg/m^3\"\npressure = \"1 Pa\"\n", "");
  return scene;
}

template <int Dim>
void grid_step(benchmark::State& state, const std::string& material) {
  const auto grid = make_grid<Dim>(waves(Dim, Dim == 2 ? 500 : 90, material));
  Measurement measured(state);
  measured.run([&] { step(*grid, grid->scene(), 1); });
  measured.items(static_cast<double>(grid->elements()));
  // The conserved quantities of every cell are read once and written once.
  measured.bytes(static_cast<double>(grid->elements()) * 2 * (Dim + 2) * sizeof(double));
}

void grid_2d_ideal(benchmark::State& state) { grid_step<2>(state, "air"); }
void grid_3d_ideal(benchmark::State& state) { grid_step<3>(state, "air"); }
void grid_2d_tillotson(benchmark::State& state) { grid_step<2>(state, "water"); }

BENCHMARK(grid_2d_ideal)->Name("grid_step/2d/ideal")->Unit(benchmark::kMillisecond);
BENCHMARK(grid_3d_ideal)->Name("grid_step/3d/ideal")->Unit(benchmark::kMillisecond);
BENCHMARK(grid_2d_tillotson)->Name("grid_step/2d/tillotson")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ejecta
