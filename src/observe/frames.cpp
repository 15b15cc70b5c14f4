#include "observe/frames.hpp"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/errors.hpp"
#include "observe/grid_frames.hpp"
#include "observe/particle_frames.hpp"
#include "observe/solvers.hpp"
#include "output/atomic_file.hpp"
#include "scene/units.hpp"

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
  settings.view_width = plan.view.width;
  settings.view_height = plan.view.height;
  settings.time_end = scene.time_end;
  settings.styles = plan.styles;
  settings.slice_fields = plan.slice_fields;
  for (const auto& package : sim.packages)
    for (const std::string& name : package->channel_names()) settings.channels.push_back(name);
  return settings;
}

bool is_picture(const std::filesystem::path& file) { return file.extension() == ".png" || file.extension() == ".jpg"; }

/// Searches of fragments between two frames, for the events that only they tell.
constexpr int looks_per_frame = 10;
/// Frames after an event come so much denser than the others.
constexpr int burst_density = 10;
const std::string note = "insitu event: ";
/// A slice is sampled no more finely than this: there is nothing to see between.
constexpr double samples_per_spacing = 3;
/// Wall time of the steps to come [s], if they are like those so far and of the length of the last one.
double seconds_ahead(const Simulation& sim) {
  const Clock& clock = sim.clock;
  if (clock.step == 0) return 0;
  double steps = (sim.scene.time_end - clock.time) / clock.dt;
  if (const auto& most = sim.scene.max_steps) steps = std::min(steps, static_cast<double>(*most - clock.step));
  return std::max(0.0, steps) * sim.wall_seconds / static_cast<double>(clock.step);
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
      limits_(plan.limits),
      slice_layout_(sim.scene.insitu.image_width, sim.scene.insitu.image_height,
                    static_cast<int>(plan.slice_fields.size()), view_.window(sim.scene.dimension), limits_),
      slice_grid_(slice_layout_.grid(sim.scene.spacing / samples_per_spacing)),
      painter_(sim.scene, plan.styles, slice_layout_, folder_ / "images"),
      schedule_(sim.scene),
      governor_(sim.scene.insitu.max_share),
      events_(sim.scene.insitu.events),
      on_error_(sim.scene.insitu.on_error),
      fragment_looks_(Every{.time = schedule_.interval() / looks_per_frame}, "") {
  ensure_folder(folder_ / "images");
  if (!catalyst) return;
  const std::vector<Pipeline> pipelines = pipelines_of(sim.scene);
  bridge_ = std::make_unique<CatalystBridge>(pipelines, settings_of(sim, folder_, plan, std::move(told)));
  silent_.resize(pipelines.size());
  for (const Pipeline& pipeline : pipelines) {
    std::optional<Trigger>& trigger = triggers_.emplace_back();
    if (!pipeline.every.empty()) trigger.emplace(parse_every(pipeline.every), "every " + pipeline.every);
  }
}

double Frames::next_time() const {
  double least = schedule_.next();
  for (const std::optional<Trigger>& trigger : triggers_)
    if (trigger) least = std::min(least, trigger->next());
  return least;
}

void Frames::resume(const Simulation& sim, const Checkpoint&) {
  const Moment now{sim.clock.step, sim.clock.time, sim.wall_seconds + sim.insitu_seconds};
  schedule_.resume(now);
  fragment_looks_.resume(now);
  for (std::optional<Trigger>& trigger : triggers_)
    if (trigger) trigger->resume(now);
  std::map<std::string, double> memory;
  for (const auto& [name, value] : sim.notes)
    if (name.starts_with(note)) memory[name.substr(note.size())] = value;
  events_.remember(memory);
}

void Frames::observe(Simulation& sim, bool last) {
  const Moment now{sim.clock.step, sim.clock.time, sim.wall_seconds + sim.insitu_seconds};
  FrameSchedule::Due frame = schedule_.take(now, last);
  const bool enabled = sim.scene.insitu.enabled, first = !tried_;
  const bool seen = now.step == last_step_ && !last;  // a run that is paused is looked at again and again
  last_step_ = now.step;
  if (seen && frame.reason.empty()) return;
  if (enabled && !seen && !ignores_triggers_ && events_.wants_any()) watch(sim, frame);
  const std::vector<PipelineCall> calls = enabled ? calls_at(now, frame, last) : std::vector<PipelineCall>{};
  if (!first && frame.reason.empty() && calls.empty()) return;
  const auto affordable = [&] {
    return governor_.affords(sim.insitu_seconds, sim.wall_seconds) ||
           (frame.on_credit && governor_.lends(sim.insitu_seconds, sim.wall_seconds + seconds_ahead(sim)));
  };
  if (enabled && !first && !frame.always && !affordable()) {
    if (left_out_++ == 0)
      warn(fmt::format("frames are left out that would take more than {:.0f} % of the wall time (insitu.max_share)",
                       100 * sim.scene.insitu.max_share));
    return;
  }
  const auto start = std::chrono::steady_clock::now();
  const double before = sim.insitu_seconds;
  on_schedule_ = frame.scheduled;
  if (!frame.reason.empty()) {
    ++drawn_;
    look(sim);
  }
  if (enabled) outputs_.write("images", Outputs::Loss::for_good, [&] { draw(sim, frame, calls); });
  tried_ = true;
  sim.insitu_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  governor_.drawn(before, sim.insitu_seconds, sim.wall_seconds);
  if (!frame.reason.empty()) keep(last);
}

Signs Frames::signs(const Simulation& sim, bool) const {
  Signs signs;
  if (std::isfinite(sim.vote.dt)) signs.time_step = sim.vote.dt;  // else no step has been taken
  return signs;
}

/// Makes a frame of an event, and asks for those that follow it.
void Frames::watch(Simulation& sim, FrameSchedule::Due& frame) {
  const bool told_by_fragments = events_.wants(Event::first_fragment) || events_.wants(Event::largest_fragment_changed);
  const bool fragments_too = told_by_fragments && fragment_looks_.take({sim.clock.step, sim.clock.time,
                                                                        sim.wall_seconds + sim.insitu_seconds});
  const auto start = std::chrono::steady_clock::now();
  on_schedule_ = true;
  if (fragments_too) look(sim);
  const std::vector<std::string_view> words = events_.look(signs(sim, fragments_too));
  for (const auto& [name, value] : events_.memory()) sim.notes[note + name] = value;
  sim.insitu_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (words.empty()) return;
  const std::string event = fmt::format("{}", fmt::join(words, " and "));
  frame = {event, true, true};
  std::vector<double> burst;
  for (int k = 1; k <= sim.scene.insitu.burst; ++k)
    burst.push_back(sim.clock.time + k * schedule_.interval() / burst_density);
  schedule_.add(burst, "after " + event);
  spdlog::info("{} at t = {}", event, format_quantity(sim.clock.time, "s"));
}

std::vector<PipelineCall> Frames::calls_at(const Moment& now, const FrameSchedule::Due& frame, bool last) {
  std::vector<PipelineCall> calls;
  for (std::size_t k = 0; k < triggers_.size(); ++k) {
    std::string reason;
    if (triggers_[k]) {
      if (triggers_[k]->take(now)) reason = triggers_[k]->reason();
      if (last && reason.empty()) reason = end_of_run;
    } else {
      if (bridge_->follows_frames(k)) reason = frame.reason;
      if (bridge_->wants(k, now.step, now.time) && reason.empty()) reason = "trigger of the script";
    }
    if (ignores_triggers_ && reason.empty()) reason = end_of_run;
    const bool disabled = silent_[k] && on_error_ == OnError::disable;
    if (!reason.empty() && !disabled) calls.push_back({k, reason});
  }
  return calls;
}

void Frames::ignore_triggers() {
  ignores_triggers_ = true;
  if (bridge_) bridge_->ignore_triggers();
}

std::vector<PipelineCount> Frames::pipelines() const {
  return bridge_ ? bridge_->counts() : std::vector<PipelineCount>{};
}

void Frames::draw(Simulation& sim, const FrameSchedule::Due& frame, const std::vector<PipelineCall>& calls) {
  check_room(folder_ / "images");
  if (!frame.reason.empty()) draw_more(sim);
  if (bridge_)
    draw_with_catalyst(sim, calls);
  else if (!frame.reason.empty())
    sim.timers.time("in situ: images", [&] { draw_without_gl(sim, frame.reason); });
}

void Frames::warn(std::string text) {
  spdlog::warn("{}", text);
  warnings_.push_back(std::move(text));
}

std::vector<Channel> Frames::all_channels(Simulation& sim) {
  std::vector<Channel> channels = make_channels(sim);
  for (const auto& package : sim.packages)
    for (Channel& channel : package->channels([&](const char* name) { return bridge_->reads(name); }))
      channels.push_back(std::move(channel));
  return channels;
}

void Frames::draw_with_catalyst(Simulation& sim, const std::vector<PipelineCall>& calls) {
  if (!tried_)
    if (std::vector<std::string> problems = bridge_->unknown_channels(); !problems.empty())
      throw ScriptError(std::move(problems));
  const std::vector<Channel> channels = all_channels(sim);
  FrameReport report;
  sim.timers.time("in situ: images", [&] {
    const StderrTo log(folder_ / "insitu.log");
    report = bridge_->execute(sim.clock.step, sim.clock.time, channels, calls);
  });
  if (!tried_) {
    std::vector<std::string> problems = bridge_->unknown_fields(sim.clock.step, sim.clock.time, channels);
    if (problems.empty())
      for (const FrameReport::Failure& failure : report.failures) problems.push_back(failure.text);
    if (!problems.empty()) throw ScriptError(std::move(problems));
  }
  for (const std::string& file : report.files) ++(is_picture(file) ? images_ : extracts_);
  for (const FrameReport::Failure& failure : report.failures) fail(failure);
}

void Frames::fail(const FrameReport::Failure& failure) {
  if (on_error_ == OnError::abort) throw SimulationError("in situ: " + failure.text);
  if (silent_[failure.pipeline]) return;
  silent_[failure.pipeline] = true;
  warn("in situ: " + failure.text + (on_error_ == OnError::disable ? "; it is not run any more" : ""));
}

void Frames::draw_without_gl(const Simulation& sim, const std::string& reason) {
  if (!index_) index_.emplace(folder_ / "images");
  painter_.paint_slice(make_slice(), sim.clock);
  images_ += static_cast<int>(index_->add_new_files(sim.clock.step, sim.clock.time, reason).size());
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
