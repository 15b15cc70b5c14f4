#include "observe/frames.hpp"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>

#include "base/errors.hpp"
#include "observe/grid_frames.hpp"
#include "observe/particle_frames.hpp"
#include "observe/solvers.hpp"
#include "output/atomic_file.hpp"

namespace ejecta {

namespace {

/// What the pipelines are told of every run.
PipelineSettings settings_of(const Simulation& sim, const std::filesystem::path& folder, const PicturePlan& plan,
                             PipelineSettings settings) {
  const Scene& scene = sim.scene;
  settings.run_folder = std::filesystem::absolute(folder).string();
  settings.scene_title = heading(scene);
  settings.dimension = scene.dimension;
  settings.image_width = scene.insitu.image_width;
  settings.image_height = scene.insitu.image_height;
  settings.view_center = plan.view.center;
  settings.view_size = plan.view.size;
  settings.time_end = scene.time_end;
  settings.styles = plan.styles;
  settings.slice_fields = plan.slice_fields;
  for (const auto& package : sim.packages)
    for (const std::string& name : package->channel_names()) settings.more_channels.push_back(name);
  return settings;
}

/// Renderers say little, and in words of their own, where an image cannot be written. So it is tried before. Throws
/// OutputError.
void check_room(const std::filesystem::path& images) {
  constexpr std::size_t small_image = 1 << 18;  // bytes
  const std::filesystem::path probe = images / ".room";
  write_atomically(probe, std::string(small_image, ' '));
  std::filesystem::remove(probe);
}

/// While it lives, what libraries print to the terminal's stderr goes to a file, or nowhere if that cannot be opened.
class StderrTo {
 public:
  explicit StderrTo(const std::filesystem::path& file) : terminal_(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0)) {
    int target = open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    if (target < 0) target = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(target, STDERR_FILENO);
    close(target);
  }
  ~StderrTo() {
    dup2(terminal_, STDERR_FILENO);
    close(terminal_);
  }
  StderrTo(const StderrTo&) = delete;
  StderrTo& operator=(const StderrTo&) = delete;

 private:
  int terminal_;
};

}  // namespace

Frames::Frames(const Simulation& sim, std::filesystem::path folder, Outputs& outputs, bool catalyst,
               const PicturePlan& plan, PipelineSettings told)
    : folder_(std::move(folder)),
      outputs_(outputs),
      view_(plan.view),
      slice_grid_(panel_grid(view_, sim.scene, static_cast<int>(plan.slice_fields.size()))),
      painter_(sim.scene, plan.styles, folder_ / "images"),
      schedule_(sim.scene.time_end, sim.scene.insitu.frames, sim.scene.output.times),
      governor_(sim.scene.insitu.max_share) {
  ensure_folder(folder_ / "images");
  if (catalyst)
    bridge_ = std::make_unique<CatalystBridge>(pipeline_scripts(sim.scene),
                                               settings_of(sim, folder_, plan, std::move(told)));
}

void Frames::resume(const Simulation& sim, const Checkpoint&) { schedule_.resume(sim.clock.time); }

void Frames::observe(Simulation& sim, bool last) {
  if (!schedule_.take(sim.clock.step, sim.clock.time, last)) return;
  ++drawn_;
  const auto start = std::chrono::steady_clock::now();
  look(sim);
  if (sim.scene.insitu.enabled) outputs_.write("images", Outputs::Loss::for_good, [&] { draw(sim); });
  sim.insitu_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto share = governor_.excess(sim.insitu_seconds, sim.wall_seconds);
  if (share && sim.scene.insitu.enabled) {
    schedule_.thin_out();
    warn(
        fmt::format("in-situ work takes {:.0f} % of the wall time (insitu.max_share = {:.0f} %): time between frames "
                    "doubled",
                    100 * *share, 100 * sim.scene.insitu.max_share));
  }
  keep(last);
}

void Frames::draw(Simulation& sim) {
  check_room(folder_ / "images");
  draw_more(sim);
  if (bridge_)
    draw_with_catalyst(sim);
  else
    sim.timers.time("in situ: images", [&] { draw_without_gl(sim); });
}

void Frames::warn(std::string text) {
  spdlog::warn("{}", text);
  warnings_.push_back(std::move(text));
}

void Frames::draw_with_catalyst(Simulation& sim) {
  std::vector<Channel> channels = make_channels(sim);
  for (const auto& package : sim.packages)
    for (Channel& channel : package->channels([&](const char* name) { return bridge_->reads(name); }))
      channels.push_back(std::move(channel));
  FrameReport report;
  sim.timers.time("in situ: images", [&] {
    const StderrTo log(folder_ / "insitu.log");
    report = bridge_->execute(sim.clock.step, sim.clock.time, channels);
  });
  images_ += static_cast<int>(report.images.size());
  for (const std::string& warning : report.warnings) {
    if (sim.scene.insitu.on_error == OnError::abort) throw SimulationError("in situ: " + warning);
    warn("in situ: " + warning);
  }
}

void Frames::draw_without_gl(const Simulation& sim) {
  if (!index_) index_.emplace(folder_ / "images");
  painter_.paint_slice(make_slice(), sim.clock);
  images_ += static_cast<int>(index_->add_new_images(sim.clock.step, sim.clock.time).size());
}

std::unique_ptr<Frames> make_frames(const Simulation& sim, const std::filesystem::path& folder, Outputs& outputs,
                                    bool catalyst) {
  std::unique_ptr<Frames> frames;
  with_grid(sim, [&]<int Dim>(const Grid<Dim>& grid) {  // where there are particles besides, it holds all matter
    frames = std::make_unique<GridFrames<Dim>>(sim, grid, folder, outputs, catalyst);
  });
  if (frames) return frames;
  with_particles(sim, [&]<int Dim>(const Sph<Dim>& sph) {
    frames = std::make_unique<ParticleFrames<Dim>>(sim, sph, folder, outputs, catalyst);
  });
  return frames;
}

}  // namespace ejecta
