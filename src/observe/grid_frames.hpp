#pragma once
/// Pictures of a grid: slices; and of the solids in a hybrid what there is of particles.
#include "hybrid/hybrid.hpp"
#include "observe/channels.hpp"
#include "observe/columns.hpp"
#include "observe/frames.hpp"

namespace ejecta {

template <int Dim>
class GridFrames final : public Frames {
 public:
  GridFrames(const Simulation& sim, const Grid<Dim>& grid, const std::filesystem::path& folder, Outputs& outputs,
             bool catalyst);

  void resume(const Simulation& sim, const Checkpoint& checkpoint) override;

 private:
  void look(Simulation& sim) override;
  std::vector<Channel> make_channels(Simulation& sim) override;
  SampledImage make_slice() override;
  Signs signs(const Simulation& sim, bool fragments_too) const override;

  SampledImage sample(bool with_velocity);

  const Grid<Dim>& grid_;
  const Hybrid<Dim>* hybrid_;  ///< that the grid is part of, or null
  const Sph<Dim>* solids_;     ///< of that hybrid, or null
  SampledImage slice_;
  FragmentTracker tracker_;
  FrameChannels<Dim> channels_;
};

}  // namespace ejecta
