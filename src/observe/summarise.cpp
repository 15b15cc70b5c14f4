#include "observe/summarise.hpp"

#include "base/parallel.hpp"
#include "observe/checkpoints.hpp"
#include "observe/memory.hpp"
#include "observe/peak_of_matter.hpp"
#include "observe/solvers.hpp"
#include "observe/tables.hpp"
#include "scene/names.hpp"
#include "sph/diagnostics.hpp"

namespace ejecta {

namespace {

/// Bytes of all files in a folder; 0 if there is none.
std::int64_t folder_bytes(const std::filesystem::path& folder) {
  std::int64_t bytes = 0;
  std::error_code gone;
  for (std::filesystem::recursive_directory_iterator entry(folder, gone), end; !gone && entry != end;
       entry.increment(gone))
    if (entry->is_regular_file(gone)) bytes += static_cast<std::int64_t>(entry->file_size(gone));
  return bytes;
}

template <int Dim>
std::vector<BodySummary> summarise_bodies(const Sph<Dim>& sph, const Frames& frames, const FragmentContext& context) {
  std::vector<BodySummary> bodies(context.bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    bodies[b].name = context.bodies[b];
    bodies[b].mass = context.body_mass[b];
  }
  if (frames.fragments()) {
    const std::vector<BodyFragments> outcome = fragments_by_body(*frames.fragments(), context);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      bodies[b].fragments = outcome[b].fragments;
      bodies[b].largest_fragment_mass_fraction = outcome[b].largest_mass_fraction;
      bodies[b].dust_mass_fraction = outcome[b].dust_mass_fraction;
    }
  }
  if (sph.scene.output.peaks)
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const double beside = 1.5 * sph.scene.spacing * sph.scene.bodies[b].spacing_factor;
      const auto body = static_cast<std::int32_t>(b);
      bodies[b].pressure_peak_max = peak_of_matter(sph.particles, body, beside);
      bodies[b].pressure_peak_median = median_peak_pressure(sph.particles, body);
    }
  return bodies;
}

template <int Dim>
void add_particles(Summary& s, const Simulation& sim, const Sph<Dim>& sph, const Frames& frames,
                   const FragmentContext& context) {
  const double n = static_cast<double>(sph.particles.size()), steps = static_cast<double>(sim.clock.step);
  s.particles = static_cast<std::int64_t>(sph.particles.size());
  if (sim.wall_seconds > 0) s.particle_steps_per_s = n * steps / sim.wall_seconds;
  s.neighbours_mean = mean_neighbours(sph);
  if (s.particle_steps_per_s) s.pair_interactions_per_s = *s.particle_steps_per_s * *s.neighbours_mean;
  s.bytes_per_particle = static_cast<double>(sph.bytes()) / n;
  if (sim.scene.numerics.tensors()) {
    s.shape_votes = sph.shape_report.votes;
    s.shape_few_neighbours = sph.shape_report.few_neighbours;
    s.shape_limited_change = sph.shape_report.limited_change;
    s.shape_largest_aspect = sph.shape_report.largest_aspect;
  }
  s.bodies = summarise_bodies(sph, frames, context);
  if (frames.fragments()) {
    s.fragment_target = s.bodies[context.target].name;
    s.fragments = static_cast<std::int64_t>(frames.fragments()->fragments.size());
    s.largest_fragment_mass_fraction = s.bodies[context.target].largest_fragment_mass_fraction;
  }
}

}  // namespace

Summary summarise(const Simulation& sim, const Frames& frames, const FragmentContext& context,
                  const std::filesystem::path& folder, int exit_code) {
  Summary s;
  const ConservationErrors errors = conservation_errors(initial(sim), conserved(sim), external(sim));
  s.scene = sim.scene.name;
  s.dimension = sim.scene.dimension;
  s.scheme = name_of(sim.scene.numerics.scheme);
  s.precision = name_of(sim.scene.numerics.precision);
  s.threads = max_threads();
  s.steps = sim.clock.step;
  s.element_steps = element_steps(sim);
  s.time_s = sim.clock.time;
  s.wall_s = sim.wall_seconds + sim.insitu_seconds;
  with_particles(sim, [&](const auto& sph) { add_particles(s, sim, sph, frames, context); });
  with_grid(sim, [&](const auto& grid) {
    s.cells = static_cast<std::int64_t>(grid.elements());
    if (sim.wall_seconds > 0) s.cell_steps_per_s = grid.element_steps() / sim.wall_seconds;
  });
  s.peak_rss_mb = memory_peak() / (1024 * 1024);
  s.mass_error_rel = errors.mass;
  if (kept(sim).momentum) s.momentum_error_rel = errors.momentum;
  if (kept(sim).angular_momentum) s.angular_momentum_error_rel = errors.angular_momentum;
  s.energy_error_rel = errors.energy;
  s.images = frames.images();
  s.extracts = frames.extracts();
  s.frames = frames.drawn();
  s.frames_left_out = frames.left_out();
  for (const PipelineCount& p : frames.pipelines()) s.pipelines.push_back({p.name, p.frames, p.failures});
  s.insitu_share = s.wall_s > 0 ? sim.insitu_seconds / s.wall_s : 0;
  s.insitu_bytes_written = folder_bytes(folder / "images");
  s.full_dump_bytes_avoided = static_cast<std::int64_t>(dump_bytes(sim) * frames.drawn());
  s.quantities = quantities(sim, frames, context);
  s.exit = exit_code;
  return s;
}

}  // namespace ejecta
