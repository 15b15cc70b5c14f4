#pragma once
/// In situ: fragments, slices and the live columns go to Catalyst at the times of the frames.
#include <filesystem>
#include <memory>
#include <optional>

#include "app/channels.hpp"
#include "insitu/catalyst_bridge.hpp"
#include "insitu/image_index.hpp"
#include "render/image.hpp"
#include "render/sampling.hpp"
#include "analysis/fragments.hpp"
#include "sph/sph.hpp"

namespace ejecta {

/// Centre and width [m] of what the images show.
struct View {
  Triple center;
  double size;
};
/// What the scene says, or a frame about the body that moves least.
View choose_view(const Scene& scene);

/// Shown when the scene gives no range for a field: from what the run sets out with, the same for all frames.
std::map<std::string, ColourRange> default_ranges(const Scene& scene, const std::vector<Material>& materials,
                                                  const Outset& outset);

/// Wall time booked for in-situ work [s].
double insitu_seconds(const StageTimers& timers);

template <int Dim>
class Frames final : public Observer<Dim> {
 public:
  /// With `catalyst` images are drawn by the pipelines, otherwise by Ejecta's own painter.
  Frames(const Sph<Dim>& sim, std::filesystem::path folder, bool catalyst);

  double next_time() const override;
  void observe(Sph<Dim>& sim, bool last) override;

  /// Fragments as of the last frame; nothing if the scene does not ask for them.
  const std::optional<FragmentTable>& fragments() const { return fragments_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// One line for the log and the monitor page.
  void warn(std::string text);
  int images() const { return images_; }
  int drawn() const { return drawn_; }  ///< frames so far
  /// After a restart: the next frame is the first one later than the checkpoint.
  void resume(Sph<Dim>& sim);

 private:
  void find_fragments(Sph<Dim>& sim);
  void sample(const Sph<Dim>& sim);
  void draw_with_catalyst(Sph<Dim>& sim);
  void draw_without_gl(const Sph<Dim>& sim);
  void paint(const Sph<Dim>& sim, std::string_view name, const PixelGrid& grid, std::span<const Panel> panels);
  void govern(const Sph<Dim>& sim);
  void collect_compaction(const Sph<Dim>& sim);
  void write_compaction_tables(const Sph<Dim>& sim) const;

  std::filesystem::path folder_;
  View view_;
  std::map<std::string, ColourRange> ranges_;
  PixelGrid grid_, column_grid_;
  double column_density_max_ = 0;  ///< end of the colour bar [kg/m^2]
  std::unique_ptr<CatalystBridge> bridge_;
  FragmentTracker tracker_;
  std::optional<FragmentTable> fragments_;
  SampledImage slice_;
  FrameChannels<Dim> channels_;
  std::vector<double> compaction_pressure_, compaction_distension_;
  std::vector<std::int32_t> compaction_loading_;
  std::vector<std::string> warnings_;
  std::optional<ImageIndex> index_;  ///< of the images drawn without Catalyst
  std::int64_t last_drawn_ = -1;
  double next_ = 0;                              ///< time of the next frame, drawn or passed over [s]
  double insitu_before_ = 0, steps_before_ = 0;  ///< wall time of either when the governor began to judge [s]
  int frame_ = 0, drawn_ = 0, images_ = 0;
  int stride_ = 1, passed_over_ = 0;  ///< the governor draws every stride-th frame only
};

}  // namespace ejecta
