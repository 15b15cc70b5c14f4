#include "observe/frames.hpp"

#include <spdlog/spdlog.h>

#include <chrono>

#include "base/errors.hpp"
#include "insitu/pipelines.hpp"
#include "observe/field_styles.hpp"
#include "observe/slice.hpp"
#include "schemes/kernels.hpp"

namespace ejecta {

namespace {

/// All that the pipelines are told of a run.
template <int Dim>
PipelineSettings pipeline_settings(const Sph<Dim>& sph, const std::filesystem::path& folder, const View& view,
                                   std::map<std::string, FieldStyle> styles) {
  const Scene& scene = sph.scene;
  PipelineSettings settings;
  settings.run_folder = std::filesystem::absolute(folder).string();
  settings.scene_title = heading(scene);
  settings.dimension = Dim;
  settings.image_width = scene.insitu.image_width;
  settings.image_height = scene.insitu.image_height;
  settings.view_center = view.center;
  settings.view_size = view.size;
  settings.time_end = scene.time_end;
  settings.particle_radius = 0.6 * scene.spacing;
  settings.styles = std::move(styles);
  for (const Field f : slice_fields(sph.particles)) settings.slice_fields.emplace_back(info(f).name);
  settings.nodes_per_h = scene.numerics.nodes_per_h;
  settings.radius_per_smoothing_length = 0.6 / settings.nodes_per_h;
  settings.fragment_target = scene.bodies[target_body(scene, sph.outset.bodies)].name;
  settings.kernel_support = kernel_support(scene.numerics.kernel);
  return settings;
}

}  // namespace

template <int Dim>
Frames<Dim>::Frames(const Simulation& sim, const Sph<Dim>& sph, std::filesystem::path folder, bool catalyst)
    : sph_(sph),
      folder_(std::move(folder)),
      view_(choose_view(sph.scene)),
      slice_grid_(panel_grid(view_, sph.scene, static_cast<int>(slice_fields(sph.particles).size()))),
      schedule_(sph.scene.time_end, sph.scene.insitu.frames),
      governor_(sph.scene.insitu.max_share),
      painter_(sph.scene, field_styles(sph.scene, sph.materials, sph.outset), folder_ / "images") {
  std::filesystem::create_directories(folder_ / "images");
  if (!catalyst) return;
  const Scene& scene = sph.scene;
  PipelineSettings settings =
      pipeline_settings(sph, folder_, view_, field_styles(scene, sph.materials, sph.outset));
  for (const auto& package : sim.packages)
    for (const std::string& name : package->channel_names()) settings.more_channels.push_back(name);
  bridge_ = std::make_unique<CatalystBridge>(pipeline_scripts(scene.insitu.pipelines, scene.fragments.enabled),
                                             std::move(settings));
}

template <int Dim>
void Frames<Dim>::resume() {
  schedule_.resume(sph_.clock.time);
  if (sph_.scene.fragments.enabled) find_fragments();
}

template <int Dim>
void Frames<Dim>::observe(Simulation& sim, bool last) {
  if (!schedule_.take(sim.clock.step, sim.clock.time, last)) return;
  ++drawn_;
  const auto start = std::chrono::steady_clock::now();
  if (sim.scene.fragments.enabled) sim.timers.time("in situ: fragment search", [&] { find_fragments(); });
  if (sim.scene.insitu.enabled) draw(sim);
  sim.insitu_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto share = governor_.excess(sim.insitu_seconds, sim.wall_seconds);
  if (share && sim.scene.insitu.enabled) {
    schedule_.thin_out();
    warn(
        fmt::format("in-situ work takes {:.0f} % of the wall time (insitu.max_share = {:.0f} %): time between frames "
                    "doubled",
                    100 * *share, 100 * sim.scene.insitu.max_share));
  }
  compaction_.collect(sph_.particles, sph_.materials);
  if (last) compaction_.write(folder_, sph_.materials);
}

void FrameResults::warn(std::string text) {
  spdlog::warn("{}", text);
  warnings_.push_back(std::move(text));
}

template <int Dim>
void Frames<Dim>::draw(Simulation& sim) {
  if (sim.scene.insitu.column_density) sim.timers.time("in situ: column density", [&] { draw_column_density(); });
  if (bridge_)
    draw_with_catalyst(sim);
  else
    sim.timers.time("in situ: images", [&] { draw_without_gl(); });
}

template <int Dim>
void Frames<Dim>::find_fragments() {
  fragments_ = tracker_.update(fragment_input(sph_), sph_.scene.fragments);
}

template <int Dim>
void Frames<Dim>::draw_column_density() {
  const PixelGrid grid = panel_grid(view_, sph_.scene, 1);
  painter_.paint_column_density(make_column_density(sph_.particles, sph_.scene.numerics.kernel, grid), sph_.clock);
}

/// Those that some script reads.
template <int Dim>
std::vector<Channel> Frames<Dim>::make_channels(Simulation& sim) {
  const Particles<Dim>& p = sph_.particles;
  const Numerics& numerics = sph_.scene.numerics;
  const double plane_y = view_.center[1];
  std::vector<Channel> made;
  const auto make = [&](const char* name, auto&& channel) {
    if (bridge_->reads(name)) sim.timers.time(std::string("in situ: ") + name, [&] { made.push_back(channel()); });
  };
  make("particles", [&] { return channels_.particles(p, fragments_); });
  make("slice", [&] { return channels_.slice(p, numerics.kernel, slice_grid_, plane_y); });
  make("ellipsoids", [&] { return channels_.ellipsoids(p, plane_y, numerics.nodes_per_h); });
  if (fragments_)
    make("fragments", [&] { return channels_.fragments(*fragments_, target_body(sph_.scene, sph_.outset.bodies)); });
  for (const auto& package : sim.packages)
    for (Channel& channel : package->channels([&](const char* name) { return bridge_->reads(name); }))
      made.push_back(std::move(channel));
  return made;
}

template <int Dim>
void Frames<Dim>::draw_with_catalyst(Simulation& sim) {
  const std::vector<Channel> channels = make_channels(sim);
  FrameReport report;
  sim.timers.time("in situ: images", [&] { report = bridge_->execute(sim.clock.step, sim.clock.time, channels); });
  images_ += static_cast<int>(report.images.size());
  for (const std::string& warning : report.warnings) {
    if (sim.scene.insitu.on_error == OnError::abort) throw SimulationError("in situ: " + warning);
    warn("in situ: " + warning);
  }
}

template <int Dim>
void Frames<Dim>::draw_without_gl() {
  if (!index_) index_.emplace(folder_ / "images");
  const SampledImage slice = make_slice(sph_.particles, sph_.scene.numerics.kernel, slice_grid_, view_.center[1]);
  painter_.paint_slice(slice, sph_.clock);
  images_ += static_cast<int>(index_->add_new_images(sph_.clock.step, sph_.clock.time).size());
}

template class Frames<2>;
template class Frames<3>;

}  // namespace ejecta
