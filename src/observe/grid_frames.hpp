#pragma once
/// Pictures of a grid: slices.
#include "hybrid/hybrid.hpp"
#include "observe/frames.hpp"

namespace ejecta {

template <int Dim>
class GridFrames final : public Frames {
 public:
  GridFrames(const Simulation& sim, const Grid<Dim>& grid, const std::filesystem::path& folder, bool catalyst);

 private:
  std::vector<Channel> make_channels(Simulation& sim) override;
  SampledImage make_slice() override;

  const Grid<Dim>& grid_;
  const Hybrid<Dim>* hybrid_;  ///< that the grid is part of, or null
  SampledImage slice_;
};

}  // namespace ejecta
