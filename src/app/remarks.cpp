#include "app/remarks.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "app/job.hpp"
#include "base/parallel.hpp"
#include "observe/measured.hpp"
#include "observe/solvers.hpp"
#include "reference/charge_start.hpp"
#include "scene/names.hpp"
#include "scene/shape_geometry.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

constexpr std::array axes{"x", "y", "z"};

void on_times(const Scene& scene, std::vector<Remark>& list) {
  const auto look = [&](const char* key, const std::vector<double>& times) {
    const auto late = [&](double t) { return t > scene.time_end * (1 + 1e-12); };
    const auto count = std::ranges::count_if(times, late);
    if (count == 0) return;
    const double first = *std::ranges::min_element(times, {}, [&](double t) { return late(t) ? t : INFINITY; });
    list.push_back(
        {fmt::format("{}: {} of {} are after the end of the run, {}, and never come: {}{}", key, count, times.size(),
                     format_quantity(scene.time_end, "s"), format_quantity(first, "s"), count > 1 ? ", ..." : ""),
         true});
  };
  look("insitu.times", scene.insitu.times.list);
  look("output.times", scene.output.times);
}

void on_threads(const Scene& scene, std::vector<Remark>& list) {
  const int cores = available_cores();
  if (scene.threads.value_or(0) > cores)
    list.push_back(
        {fmt::format(
             "run.threads: {} asked for, {} taken: that is how many cores there are here, and more threads than "
             "cores wait for each other",
             *scene.threads, cores),
         true});
}

/// How much of a body is beyond a face.
struct Beyond {
  double share = 0;  ///< of its volume
  std::string face;  ///< the first it is beyond
};

/// What a body has beyond faces: walls, planes of symmetry, and of a fluid on a grid open faces. Half of it may be
/// beyond a plane of symmetry, which is a wall too for fluids: the other half is its image.
template <int Dim>
Beyond beyond_faces(const Scene& scene, const Body& body, bool solid) {
  constexpr int points = Dim == 2 ? 256 : 64;  // along an edge of the box around it
  constexpr double round_off = 1e-9;
  const Vec<Dim> centre = first_components<Dim>(body.center);
  return with_shape<Dim>(body, [&](const auto& shape) {
    const Vec<Dim> half = shape.half_extent();
    Vec<Dim> low = centre - half, high = centre + half;  // what is kept of the box around it
    Beyond beyond;
    const auto cut = [&](std::size_t a, bool upper) {
      const double face = upper ? scene.boundary.max[a] : scene.boundary.min[a];
      const BoundaryKind kind = upper ? scene.boundary.upper[a] : scene.boundary.lower[a];
      if (!is_set(face) || kind == BoundaryKind::periodic) return;
      if (kind == BoundaryKind::open && (solid || !scene.numerics.on_grid())) return;
      const int k = static_cast<int>(a);
      const double width = 2 * half[k];
      const bool continues = mirrors(kind) && (kind == BoundaryKind::symmetry || !solid);
      if (continues && std::abs(face - centre[k]) < round_off * width) return;
      double& edge = upper ? high[k] : low[k];
      if (upper ? edge <= face + round_off * width : edge >= face - round_off * width) return;
      edge = face;
      if (beyond.face.empty())
        beyond.face = fmt::format("{} face at {} = {}", name_of(kind), axes[a], format_quantity(face, "m"));
    };
    for (std::size_t a = 0; a < Dim; ++a) cut(a, false), cut(a, true);
    if (beyond.face.empty()) return beyond;
    std::size_t all = 0, kept = 0;
    for (int n = 0; n < (Dim == 2 ? points * points : points * points * points); ++n) {
      Vec<Dim> d;
      for (int a = 0, rest = n; a < Dim; ++a, rest /= points) d[a] = (2 * (rest % points + 0.5) / points - 1) * half[a];
      if (!shape.contains(d)) continue;
      const Vec<Dim> x = centre + d;
      ++all;
      kept += (x.array() >= low.array()).all() && (x.array() <= high.array()).all();
    }
    beyond.share = 1 - static_cast<double>(kept) / static_cast<double>(all);
    return beyond;
  });
}

Beyond beyond_faces(const Scene& scene, const Body& body, bool solid) {
  return scene.dimension == 2 ? beyond_faces<2>(scene, body, solid) : beyond_faces<3>(scene, body, solid);
}

void on_cut_bodies(const Job& job, std::vector<Remark>& list) {
  const Scene& scene = job.scene;
  for (const Body& body : scene.bodies) {
    if (body.implied) continue;  // the gas is the box, and a charge of a grid must be within it
    const bool solid = job.materials.list[job.materials.index(body.material)].solid();
    const Beyond beyond = beyond_faces(scene, body, solid);
    if (beyond.share > 0)
      list.push_back({fmt::format("{}: {:.2g} % of it is beyond the {} and is left out", body.name, 100 * beyond.share,
                                  beyond.face),
                      solid});
  }
}

/// Cells or particles across the radius of a charge, or of the shock where its blast has been solved in one dimension
/// so far. Measured with inputs/blast_1kt.toml (docs/results.md): with 4 cells the shock at 6 radii is 0.5 % off, with
/// 2 there is none yet; a shock that begins with 14 particles is 0.5 % off there, a charge of 8 is 15 %.
constexpr double resolved_cells = 4, resolved_particles = 12;

/// How far the wave has come [m]: within the debris pressures are higher than at the shock, so that no look at the
/// cells tells.
double reach(const RadialState& start) {
  std::size_t i = start.velocity.size();
  while (i > 0 && start.velocity[i - 1] == 0) --i;
  return static_cast<double>(i) * start.spacing;
}

void on_charge(const Job& job, const Simulation& sim, std::vector<Remark>& list) {
  const Scene& scene = sim.scene;
  if (!scene.charge || sim.clock.step > 0) return;
  double spacing = scene.spacing, resolved = resolved_particles;
  std::string_view element = "particle";
  with_grid(sim, [&](const auto& grid) {
    spacing = grid.box().spacing;
    resolved = resolved_cells;
    element = "cell";
  });
  const bool later = sim.clock.time > 0;
  double radius = scene.charge->radius;
  if (later) radius = reach(*charge_start(scene, job.materials.list));
  if (radius >= resolved * spacing * (1 - 1e-9)) return;
  list.push_back(
      {fmt::format("{} has a radius of {}, {:.2g} {}s of {}: with fewer than {} the shock is late and too strong "
                   "at first, then too weak (docs/results.md has the numbers){}",
                   later ? "the shock that the run begins with" : "the charge", format_quantity(radius, "m"),
                   radius / spacing, element, format_quantity(spacing, "m"), resolved,
                   is_set(scene.charge->start) ? "; without charge.start the run begins when it has come farther" : ""),
       true});
}

}  // namespace

std::vector<Remark> remarks_on(const Job& job, const Simulation& sim) {
  std::vector<Remark> list;
  on_times(job.scene, list);
  on_threads(job.scene, list);
  on_cut_bodies(job, list);
  on_charge(job, sim, list);
  for (const auto& package : sim.packages) std::ranges::move(package->remarks_at_start(), std::back_inserter(list));
  return list;
}

void say_misfits(const Scene& scene, const std::filesystem::path& folder) {
  for (const Probe& probe : scene.probes) {
    const std::filesystem::path computed = folder / fmt::format("probe_{}.csv", probe.name);
    const std::filesystem::path measured = folder / fmt::format("probe_{}_measured.csv", probe.name);
    if (!std::filesystem::exists(computed) || !std::filesystem::exists(measured)) continue;
    for (const Misfit& m : compare_traces(computed, measured, probe.measured_delay))
      spdlog::info("probe {}: {} is {} (rms; mean {}) off the {} points that were measured", probe.name, m.column.name,
                   format_quantity(m.rms, m.column.unit), format_quantity(m.mean, m.column.unit), m.points);
  }
}

}  // namespace ejecta
