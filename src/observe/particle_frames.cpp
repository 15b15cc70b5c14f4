#include "observe/particle_frames.hpp"

#include <algorithm>
#include <cmath>

#include "observe/field_styles.hpp"
#include "observe/slice.hpp"
#include "schemes/kernels.hpp"

namespace ejecta {

namespace {

template <int Dim>
PicturePlan plan_of(const Sph<Dim>& sph) {
  PicturePlan plan{choose_view(sph.scene),
                   Layout::everywhere(),
                   {},
                   field_styles(sph.scene, extremes(sph.scene, sph.materials, sph.outset))};
  for (const Field f : slice_fields(sph.particles)) plan.slice_fields.emplace_back(info(f).name);
  return plan;
}

}  // namespace

template <int Dim>
PipelineSettings pipeline_settings(const Sph<Dim>& sph) {
  const Scene& scene = sph.scene;
  PipelineSettings settings;
  settings.channels = {"particles", "slice", "ellipsoids"};
  if (Dim == 3) settings.channels.push_back("volume");
  if (scene.fragments.enabled) settings.channels.push_back("fragments");
  settings.nodes_per_h = scene.numerics.nodes_per_h;
  const double radius = Dim == 2 ? 0.71 : 0.6;  // node spacings: discs of a square lattice leave no gaps
  settings.particle_radius = radius * scene.spacing;
  settings.radius_per_smoothing_length = radius / settings.nodes_per_h;
  settings.fragment_target = scene.bodies[target_body(scene, sph.outset.bodies)].name;
  settings.kernel_support = kernel_support(scene.numerics.kernel);
  for (const Body& body : scene.bodies) {
    const auto material = std::ranges::find(sph.materials, body.material, &Material::name);
    settings.bodies.push_back({body.name, material != sph.materials.end() && material->damage.has_value()});
  }
  return settings;
}

template <int Dim>
ParticleFrames<Dim>::ParticleFrames(const Simulation& sim, const Sph<Dim>& sph, const std::filesystem::path& folder,
                                    Outputs& outputs, bool catalyst)
    : Frames(sim, folder, outputs, catalyst, plan_of(sph), pipeline_settings(sph)), sph_(sph) {}

template <int Dim>
void ParticleFrames<Dim>::resume(const Simulation& sim, const Checkpoint& checkpoint) {
  Frames::resume(sim, checkpoint);
  compaction_.load(checkpoint);
  if (!sim.scene.fragments.enabled) return;
  const auto numbers_of_before = [&] {
    if (checkpoint.scalars.contains("fragments.last_number"))  // not in checkpoints of earlier versions
      tracker_.restore(checkpoint.label("fragments.id"), checkpoint.label("fragments.number"),
                       static_cast<std::int32_t>(checkpoint.scalar("fragments.last_number")));
  };
  numbers_of_before();
  remember_numbers();
  fragments_ = tracker_.update(fragment_input(sph_), sph_.scene.fragments);
  numbers_of_before();  // the next frame compares with the last one, not with this look between them
}

template <int Dim>
void ParticleFrames<Dim>::save(CheckpointView& view) {
  compaction_.save(view);
  if (!sph_.scene.fragments.enabled) return;
  view.scalars["fragments.last_number"] = numbers_.last;
  view.labels.push_back({"fragments.id", "1", numbers_.id});
  view.labels.push_back({"fragments.number", "1", numbers_.number});
}

template <int Dim>
void ParticleFrames<Dim>::remember_numbers() {
  numbers_ = {{}, {}, tracker_.last_number()};
  for (const auto& [id, number] : tracker_.number_of_id()) {
    numbers_.id.push_back(id);
    numbers_.number.push_back(number);
  }
}

template <int Dim>
void ParticleFrames<Dim>::look(Simulation& sim) {
  if (!sim.scene.fragments.enabled) return;
  sim.timers.time("in situ: fragment search", [&] {
    fragments_ = tracker_.update(fragment_input(sph_), sph_.scene.fragments);
    if (on_schedule()) remember_numbers();
  });
}

template <int Dim>
void ParticleFrames<Dim>::draw_more(Simulation& sim) {
  if (!sim.scene.insitu.column_density) return;
  sim.timers.time("in situ: column density", [&] {
    const InSitu& insitu = sph_.scene.insitu;
    const Layout layout(insitu.image_width, insitu.image_height, 1, view_.window(Dim), limits_);
    painter_.paint_column_density(make_column_density(sph_.particles, sph_.scene.numerics.kernel, layout.grid()),
                                  layout, sph_.clock);
  });
}

template <int Dim>
std::vector<Channel> ParticleFrames<Dim>::make_channels(Simulation& sim) {
  const Particles<Dim>& p = sph_.particles;
  const Numerics& numerics = sph_.scene.numerics;
  const double plane_y = view_.center[1];
  std::vector<Channel> made;
  const auto make = [&](const char* name, auto&& channel) {
    if (reads(name)) sim.timers.time(std::string("in situ: ") + name, [&] { made.push_back(channel()); });
  };
  make("particles", [&] { return channels_.particles(p, fragments_); });
  make("slice", [&] { return channels_.slice(p, numerics.kernel, slice_grid_, plane_y); });
  make("ellipsoids", [&] { return channels_.ellipsoids(p, plane_y, numerics.nodes_per_h); });
  if constexpr (Dim == 3)
    make("volume", [&] { return channels_.volume(p, numerics.kernel, view_, sph_.scene.spacing); });
  if (fragments_)
    make("fragments", [&] { return channels_.fragments(*fragments_, target_body(sph_.scene, sph_.outset.bodies)); });
  return made;
}

/// Largest change of a body's momentum since the start, over its mass times a speed [m/s].
template <int Dim>
double momentum_change(const Sph<Dim>& sph, double speed) {
  const Particles<Dim>& p = sph.particles;
  const auto mass = p.column(Field::mass);
  const auto body = p.label(Label::body);
  std::vector<Vec<Dim>> momentum(sph.outset.bodies.size(), Vec<Dim>::Zero());
  for (std::size_t i = 0; i < p.size(); ++i)
    momentum[static_cast<std::size_t>(body[i])] += mass[i] * p.vector(Field::velocity, i);
  double most = 0;
  for (std::size_t b = 0; b < momentum.size(); ++b) {
    const BodyAtOutset& start = sph.outset.bodies[b];
    if (sph.scene.bodies[b].driven || !(start.mass > 0)) continue;
    const Vec<Dim> before = start.mass * start.velocity.template head<Dim>();
    most = std::max(most, (momentum[b] - before).norm() / (start.mass * speed));
  }
  return most;
}

template <int Dim>
Signs ParticleFrames<Dim>::signs(const Simulation& sim, bool fragments_too) const {
  Signs signs = Frames::signs(sim, fragments_too);
  const Outset& start = sph_.outset;  // where nothing moves at first, the speed that its pressure will give it
  signs.momentum_change = momentum_change(sph_, std::max(start.speed, std::sqrt(start.pressure / start.density)));
  signs.pressure = highest_pressure(sph_);
  signs.noteworthy_pressure = 0.1 * sph_.outset.pressure;
  if (fragments_ && fragments_too) {
    const std::size_t target = target_body(sph_.scene, sph_.outset.bodies);
    signs.fragments = static_cast<double>(fragments_->fragments.size());
    signs.largest_fragment = fragments_->largest_mass(target) / sph_.outset.bodies[target].mass;
  }
  return signs;
}

template <int Dim>
SampledImage ParticleFrames<Dim>::make_slice() {
  return ejecta::make_slice(sph_.particles, slice_fields(sph_.particles), sph_.scene.numerics.kernel, slice_grid_,
                            view_.center[1]);
}

template <int Dim>
void ParticleFrames<Dim>::keep(bool last) {
  compaction_.collect(sph_.particles, sph_.materials, !on_schedule());
  if (last) outputs_.write("figures", Outputs::Loss::until_next, [&] { compaction_.write(folder_, sph_.materials); });
}

template PipelineSettings pipeline_settings<2>(const Sph<2>&);
template PipelineSettings pipeline_settings<3>(const Sph<3>&);
template class ParticleFrames<2>;
template class ParticleFrames<3>;

}  // namespace ejecta
