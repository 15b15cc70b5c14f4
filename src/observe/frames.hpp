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
  std::vector<std::string> slice_fields;     ///< panels of a slice
  std::map<std::string, FieldStyle> styles;  ///< field -> how it is shown
};

/// What is common to the pictures of all solvers: when, how often, and by whom they are drawn.
class Frames : public Observer {
 public:
  double next_time() const override { return schedule_.next(); }
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
  int images() const { return images_; }
  int drawn() const { return drawn_; }  ///< frames so far
  /// Calls of Catalyst scripts that failed.
  int pipeline_failures() const { return bridge_ ? bridge_->failures() : 0; }

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
  /// Whether there is a frame at this time [s] whoever stops or asks.
  bool on_schedule(double time) const { return schedule_.falls_on(time); }
  bool reads(const char* channel) const { return bridge_->reads(channel); }

  std::filesystem::path folder_;
  Outputs& outputs_;
  View view_;
  PixelGrid slice_grid_;
  Painter painter_;
  std::optional<FragmentTable> fragments_;

 private:
  void draw(Simulation& sim);
  void draw_with_catalyst(Simulation& sim);
  void draw_without_gl(const Simulation& sim);

  FrameSchedule schedule_;
  FrameGovernor governor_;
  std::unique_ptr<CatalystBridge> bridge_;
  std::optional<ImageIndex> index_;  ///< of the images drawn without Catalyst
  std::vector<std::string> warnings_;
  int drawn_ = 0, images_ = 0;
};

/// Those of the solver that the simulation has, which must outlive them.
std::unique_ptr<Frames> make_frames(const Simulation& sim, const std::filesystem::path& folder, Outputs& outputs,
                                    bool catalyst);

}  // namespace ejecta
