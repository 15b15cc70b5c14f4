#include "observe/frames.hpp"

#include <spdlog/spdlog.h>

#include "base/errors.hpp"
#include "insitu/pipelines.hpp"
#include "observe/colour_ranges.hpp"
#include "observe/slice.hpp"
#include "schemes/kernels.hpp"

namespace ejecta {

namespace {

/// All that the pipelines are told of a run.
template <int Dim>
PipelineSettings pipeline_settings(const Sph<Dim>& sph, const std::filesystem::path& folder, const View& view,
                                   const std::map<std::string, ColourRange>& ranges) {
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
  settings.ranges = ranges;
  settings.nodes_per_h = scene.numerics.nodes_per_h;
  settings.radius_per_smoothing_length = 0.6 / settings.nodes_per_h;
  settings.fragment_target = scene.bodies[target_body(scene, sph.outset.bodies)].name;
  settings.kernel_support = kernel_support(scene.numerics.kernel);
  return settings;
}

}  // namespace

double insitu_seconds(const StageTimers& timers) {
  double total = 0;
  for (const StageTimers::Entry& e : timers.entries())
    if (e.name.starts_with("in situ")) total += e.seconds;
  return total;
}

template <int Dim>
Frames<Dim>::Frames(const Sph<Dim>& sph, std::filesystem::path folder, bool catalyst)
    : sph_(sph),
      folder_(std::move(folder)),
      view_(choose_view(sph.scene)),
      ranges_(colour_ranges(sph.scene, sph.materials, sph.outset)),
      schedule_(sph.scene.time_end, sph.scene.insitu.frames),
      governor_(sph.scene.insitu.max_share),
      painter_(sph.scene, folder_ / "images") {
  std::filesystem::create_directories(folder_ / "images");
  if (!catalyst) return;
  const Scene& scene = sph.scene;
  bridge_ = std::make_unique<CatalystBridge>(pipeline_scripts(scene.insitu.pipelines, scene.fragments.enabled),
                                             pipeline_settings(sph, folder_, view_, ranges_));
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
  if (sim.scene.fragments.enabled) sim.timers.time("in situ: fragments", [&] { find_fragments(); });
  if (sim.scene.insitu.enabled) {
    sim.timers.time("in situ: slice", [&] { sample(); });
    sim.timers.time("in situ: images", [&] { bridge_ ? draw_with_catalyst(sim) : draw_without_gl(); });
    if (const auto share = governor_.excess(insitu_seconds(sim.timers), sim.wall_seconds)) {
      schedule_.thin_out();
      warn(
          fmt::format("in-situ work takes {:.0f} % of the wall time (insitu.max_share = {:.0f} %): time between frames "
                      "doubled",
                      100 * *share, 100 * sim.scene.insitu.max_share));
    }
  }
  compaction_.collect(sph_.particles, sph_.materials);
  if (last) compaction_.write(folder_, sph_.materials);
}

void FrameResults::warn(std::string text) {
  spdlog::warn("{}", text);
  warnings_.push_back(std::move(text));
}

template <int Dim>
void Frames<Dim>::find_fragments() {
  fragments_ = tracker_.update(fragment_input(sph_), sph_.scene.fragments);
}

template <int Dim>
void Frames<Dim>::sample() {
  const Particles<Dim>& p = sph_.particles;
  const Scene& scene = sph_.scene;
  const Kernel kernel = scene.numerics.kernel;
  const int panels = static_cast<int>(slice_fields(p).size());
  slice_ = make_slice(p, kernel, panel_grid(view_, scene, panels), view_.center[1]);
  if (scene.insitu.column_density)
    painter_.paint_column_density(make_column_density(p, kernel, panel_grid(view_, scene, 1)), sph_.clock);
}

template <int Dim>
void Frames<Dim>::draw_with_catalyst(const Simulation& sim) {
  std::vector<Channel> all = channels_.update(sph_, slice_, view_.center[1], fragments_);
  for (const auto& package : sim.packages)
    for (Channel& channel : package->channels()) all.push_back(std::move(channel));
  const FrameReport report = bridge_->execute(sim.clock.step, sim.clock.time, all);
  images_ += static_cast<int>(report.images.size());
  for (const std::string& warning : report.warnings) {
    if (sim.scene.insitu.on_error == OnError::abort) throw SimulationError("in situ: " + warning);
    warn("in situ: " + warning);
  }
}

template <int Dim>
void Frames<Dim>::draw_without_gl() {
  if (!index_) index_.emplace(folder_ / "images");
  painter_.paint_slice(slice_, ranges_, sph_.clock);
  images_ += static_cast<int>(index_->add_new_images(sph_.clock.step, sph_.clock.time).size());
}

template class Frames<2>;
template class Frames<3>;

}  // namespace ejecta
