#pragma once
/// In situ: at the times of the frames what there is to see is drawn, by pipelines or by Ejecta itself.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/fragments.hpp"
#include "insitu/catalyst_bridge.hpp"
#include "insitu/image_index.hpp"
#include "insitu/pipelines.hpp"
#include "observe/events.hpp"
#include "observe/outputs.hpp"
#include "observe/painter.hpp"
#include "observe/schedule.hpp"
#include "observe/view.hpp"
#include "output/checkpoint.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

/// What the pictures of a run are told of it.
struct PicturePlan {
  View view;
  Window limits = Layout::everywhere();      ///< beyond them there will never be anything
  std::vector<std::string> slice_fields;     ///< panels of a slice
  std::map<std::string, FieldStyle> styles;  ///< field -> how it is shown
};

/// What is common to the pictures of all solvers: when, how often, and by whom they are drawn.
class Frames : public Observer {
 public:
  double next_time() const override;
  /// At the first call every pipeline that is due then is tried: throws ScriptError.
  /// Later a pipeline that fails is counted, and throws SimulationError with insitu.on_error = "abort".
  void observe(Simulation& sim, bool last) override;
  /// After a restart: the next frame is the first one later than the checkpoint.
  virtual void resume(const Simulation& sim, const Checkpoint& checkpoint);
  /// Adds what the frames to come need of those so far. Valid until the next frame.
  virtual void save(CheckpointView&) {}
  /// The end of this step is drawn too.
  void ask() { schedule_.ask(); }
  /// From now on a frame every `interval` of simulated time [s].
  void change_interval(const Simulation& sim, double interval) { schedule_.change(sim.clock.time, interval); }

  /// Fragments as of the last frame; nothing if the scene does not ask for them.
  const std::optional<FragmentTable>& fragments() const { return fragments_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// One line for the log and the monitor page.
  void warn(std::string text);
  int images() const { return images_; }      ///< pictures so far
  int extracts() const { return extracts_; }  ///< other files that pipelines have written
  int drawn() const { return drawn_; }        ///< frames so far
  int left_out() const { return left_out_; }  ///< frames that insitu.max_share did not allow
  /// Calls and failures of the Catalyst scripts; none without Catalyst.
  std::vector<PipelineCount> pipelines() const;
  /// Every pipeline is run at every call, whatever its triggers say, and events are not looked for.
  void ignore_triggers();

 protected:
  /// `told`: what else the pipelines are to know. With `catalyst` they draw, otherwise Ejecta's own painter.
  Frames(const Simulation& sim, std::filesystem::path folder, Outputs& outputs, bool catalyst, const PicturePlan& plan,
         PipelineSettings told);

  /// What has to be found out for a frame, drawn or not.
  virtual void look(Simulation&) {}
  /// Pictures beside those of the pipelines.
  virtual void draw_more(Simulation&) {}
  /// Channels of this solver that some script reads.
  virtual std::vector<Channel> make_channels(Simulation& sim) = 0;
  virtual SampledImage make_slice() = 0;
  /// After a frame.
  virtual void keep(bool /*last*/) {}
  /// Whether this look is one that a run which nobody stops or asks has too.
  bool on_schedule() const { return on_schedule_; }
  bool reads(const char* channel) const { return bridge_->reads(channel); }
  /// From which events are told; those that only fragments tell if `fragments_too`.
  virtual Signs signs(const Simulation& sim, bool fragments_too) const;

  std::filesystem::path folder_;
  Outputs& outputs_;
  View view_;
  Window limits_;
  Layout slice_layout_;
  PixelGrid slice_grid_;
  Painter painter_;
  std::optional<FragmentTable> fragments_;

 private:
  void watch(Simulation& sim, FrameSchedule::Due& frame);
  std::vector<PipelineCall> calls_at(const Moment& now, const FrameSchedule::Due& frame, bool last);
  std::vector<Channel> all_channels(Simulation& sim);
  void draw(Simulation& sim, const FrameSchedule::Due& frame, const std::vector<PipelineCall>& calls);
  void draw_with_catalyst(Simulation& sim, const std::vector<PipelineCall>& calls);
  void fail(const FrameReport::Failure& failure);
  void draw_without_gl(const Simulation& sim, const std::string& reason);

  FrameSchedule schedule_;
  FrameGovernor governor_;
  EventWatch events_;
  OnError on_error_;
  Trigger fragment_looks_;  ///< when events are looked for that only fragments tell
  std::unique_ptr<CatalystBridge> bridge_;
  std::vector<std::optional<Trigger>> triggers_;  ///< of the pipelines that have one in the scene
  std::vector<bool> silent_;                      ///< pipelines that are run no more, or have been reported
  bool tried_ = false, ignores_triggers_ = false, on_schedule_ = true;
  std::int64_t last_step_ = -1;      ///< that was observed
  std::optional<ImageIndex> index_;  ///< of the images drawn without Catalyst
  std::vector<std::string> warnings_;
  int drawn_ = 0, left_out_ = 0, images_ = 0, extracts_ = 0;
};

/// Those of the solver that the simulation has, which must outlive them.
std::unique_ptr<Frames> make_frames(const Simulation& sim, const std::filesystem::path& folder, Outputs& outputs,
                                    bool catalyst);

}  // namespace ejecta
