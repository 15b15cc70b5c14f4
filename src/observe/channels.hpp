#pragma once
/// What the pipelines see of a simulation: its live columns, what is derived from them once a frame, slice and
/// fragments.
#include <array>
#include <optional>
#include <vector>

#include "render/ellipsoids.hpp"
#include "render/sampling.hpp"
#include "analysis/fragments.hpp"
#include "sph/sph.hpp"

namespace ejecta {

/// The channels of one frame. They point into the simulation, the slice, the fragments and this object, which keeps the
/// derived columns.
template <int Dim>
class FrameChannels {
 public:
  /// particles, slice, ellipsoids and, where there is a table of them, fragments. `plane_y` [m]: of slice and
  /// ellipsoids.
  std::vector<Channel> update(const Sph<Dim>& sim, const SampledImage& slice, double plane_y,
                              const std::optional<FragmentTable>& fragments);

 private:
  Channel particle_channel(const Particles<Dim>& p, const std::optional<FragmentTable>& fragments);
  Channel fragment_channel(const FragmentTable& table, std::size_t target);

  std::vector<double> zeros_;
  std::vector<OwnedField> tensor_fields_;
  Ellipsoids ellipsoids_;
  std::array<std::vector<double>, 11> fragment_columns_;
  std::vector<std::int32_t> fragment_numbers_;
};

}  // namespace ejecta
