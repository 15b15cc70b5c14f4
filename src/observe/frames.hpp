#pragma once
/// In situ: at the times of the frames fragments are found, and slices and the live columns drawn.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/fragments.hpp"
#include "insitu/catalyst_bridge.hpp"
#include "insitu/image_index.hpp"
#include "observe/channels.hpp"
#include "observe/columns.hpp"
#include "observe/compaction.hpp"
#include "observe/painter.hpp"
#include "observe/schedule.hpp"
#include "observe/view.hpp"
#include "simulation/simulation.hpp"
#include "sph/sph.hpp"

namespace ejecta {

/// What frames leave for others to show.
class FrameResults : public Observer {
 public:
  /// Fragments as of the last frame; nothing if the scene does not ask for them.
  const std::optional<FragmentTable>& fragments() const { return fragments_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// One line for the log and the monitor page.
  void warn(std::string text);
  int images() const { return images_; }
  int drawn() const { return drawn_; }  ///< frames so far
  virtual int pipeline_failures() const = 0;  ///< calls of Catalyst scripts that failed

 protected:
  std::optional<FragmentTable> fragments_;
  std::vector<std::string> warnings_;
  int drawn_ = 0, images_ = 0;
};

template <int Dim>
class Frames final : public FrameResults {
 public:
  /// Pictures of `sph`, which outlives this. With `catalyst` images are drawn by the pipelines, otherwise by Ejecta's own
  /// painter.
  Frames(const Simulation& sim, const Sph<Dim>& sph, std::filesystem::path folder, bool catalyst);

  double next_time() const override { return schedule_.next(); }
  void observe(Simulation& sim, bool last) override;
  int pipeline_failures() const override { return bridge_ ? bridge_->failures() : 0; }
  /// After a restart: the next frame is the first one later than the checkpoint.
  void resume();

 private:
  void draw(Simulation& sim);
  void find_fragments();
  void draw_column_density();
  std::vector<Channel> make_channels(Simulation& sim);
  void draw_with_catalyst(Simulation& sim);
  void draw_without_gl();

  const Sph<Dim>& sph_;
  std::filesystem::path folder_;
  View view_;
  PixelGrid slice_grid_;
  FrameSchedule schedule_;
  FrameGovernor governor_;
  FragmentTracker tracker_;
  Painter painter_;
  FrameChannels<Dim> channels_;
  std::unique_ptr<CatalystBridge> bridge_;
  std::optional<ImageIndex> index_;  ///< of the images drawn without Catalyst
  CompactionPlot compaction_;
};

}  // namespace ejecta
