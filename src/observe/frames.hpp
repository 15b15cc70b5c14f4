#pragma once
/// In situ: at the times of the frames fragments are found, and slices and the live columns drawn.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "insitu/catalyst_bridge.hpp"
#include "insitu/image_index.hpp"
#include "observe/channels.hpp"
#include "observe/columns.hpp"
#include "observe/compaction.hpp"
#include "observe/painter.hpp"
#include "observe/schedule.hpp"
#include "observe/view.hpp"
#include "simulation/fragments.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

/// Wall time booked for in-situ work [s].
double insitu_seconds(const StageTimers& timers);

template <int Dim>
class Frames final : public Observer<Dim> {
 public:
  /// With `catalyst` images are drawn by the pipelines, otherwise by Ejecta's own painter.
  Frames(const Simulation<Dim>& sim, std::filesystem::path folder, bool catalyst);

  double next_time() const override { return schedule_.next(); }
  void observe(Simulation<Dim>& sim, bool last) override;

  /// Fragments as of the last frame; nothing if the scene does not ask for them.
  const std::optional<FragmentTable>& fragments() const { return fragments_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// One line for the log and the monitor page.
  void warn(std::string text);
  int images() const { return images_; }
  int drawn() const { return drawn_; }  ///< frames so far
  /// After a restart: the next frame is the first one later than the checkpoint.
  void resume(Simulation<Dim>& sim);

 private:
  void find_fragments(const Simulation<Dim>& sim);
  void draw_column_density(const Simulation<Dim>& sim);
  std::vector<Channel> make_channels(Simulation<Dim>& sim);
  void draw_with_catalyst(Simulation<Dim>& sim);
  void draw_without_gl(const Simulation<Dim>& sim);

  std::filesystem::path folder_;
  View view_;
  PixelGrid slice_grid_;
  FrameSchedule schedule_;
  FrameGovernor governor_;
  FragmentTracker tracker_;
  std::optional<FragmentTable> fragments_;
  Painter painter_;
  FrameChannels<Dim> channels_;
  std::unique_ptr<CatalystBridge> bridge_;
  std::optional<ImageIndex> index_;  ///< of the images drawn without Catalyst
  CompactionPlot compaction_;
  std::vector<std::string> warnings_;
  int drawn_ = 0, images_ = 0;
};

}  // namespace ejecta
