#pragma once
/// Pictures of particles: slices, all that their columns show, fragments, and how pores are crushed.
#include "observe/channels.hpp"
#include "observe/columns.hpp"
#include "observe/compaction.hpp"
#include "observe/frames.hpp"
#include "sph/sph.hpp"

namespace ejecta {

/// What scripts that draw particles ask for beyond what all are told.
template <int Dim>
PipelineSettings pipeline_settings(const Sph<Dim>& sph);

template <int Dim>
class ParticleFrames final : public Frames {
 public:
  ParticleFrames(const Simulation& sim, const Sph<Dim>& sph, const std::filesystem::path& folder, Outputs& outputs,
                 bool catalyst);
  void resume(const Simulation& sim, const Checkpoint& checkpoint) override;
  void save(CheckpointView& view) override;

 private:
  void remember_numbers();
  void look(Simulation& sim) override;
  void draw_more(Simulation& sim) override;
  std::vector<Channel> make_channels(Simulation& sim) override;
  SampledImage make_slice() override;
  void keep(bool last) override;
  Signs signs(const Simulation& sim, bool fragments_too) const override;

  const Sph<Dim>& sph_;
  FragmentTracker tracker_;
  FrameChannels<Dim> channels_;
  CompactionPlot compaction_;
  /// Of tracker_ at the last frame on schedule: what the frames after a restart compare with.
  struct Numbers {
    std::vector<std::int32_t> id, number;
    std::int32_t last = 0;
  } numbers_;
};

}  // namespace ejecta
