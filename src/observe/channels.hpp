#pragma once
/// What the pipelines see of a simulation: its live columns, what is derived from them once a frame, slice and
/// fragments.
#include <array>
#include <list>
#include <optional>
#include <vector>

#include "analysis/fragments.hpp"
#include "model/channel.hpp"
#include "observe/view.hpp"
#include "render/ellipsoids.hpp"
#include "render/sampling.hpp"
#include "render/volume.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// The slice in the plane y = plane_y [m] (in 2D that of the scene) as the channel of that name. Valid while `image`
/// lives.
Channel slice_channel(const SampledImage& image, int dimension, double plane_y);

/// Makes the channels of a frame, each on its own. They point into what they are made of and into this object, which
/// keeps the derived columns until the same channel is made again.
template <int Dim>
class FrameChannels {
 public:
  /// All columns but rates, what follows from the tensors, and the fragment numbers where there is a table of them.
  Channel particles(const Particles<Dim>& p, const std::optional<FragmentTable>& fragments);
  /// The slice fields, density and velocity in the plane y = plane_y [m].
  Channel slice(const Particles<Dim>& p, Kernel kernel, const PixelGrid& grid, double plane_y);
  /// The smoothing ellipsoids of the layer about the plane y = plane_y [m].
  Channel ellipsoids(const Particles<Dim>& p, double plane_y, double nodes_per_h);
  /// How full space is behind the plane through the middle of the view.
  Channel volume(const Particles<Dim>& p, Kernel kernel, const View& view, double spacing) requires(Dim == 3);
  /// A point a fragment; `target` is the body that target_mass is of.
  Channel fragments(const FragmentTable& table, std::size_t target);

 private:
  FieldView shown(const Particles<Dim>& p, Field field);

  std::vector<double> zeros_;
  std::list<std::vector<double>> last_diagonals_;  ///< zz of the deviators
  std::vector<OwnedField> tensor_fields_;
  SampledImage slice_;
  Ellipsoids ellipsoids_;
  SampledVolume volume_;
  std::array<std::vector<double>, 11> fragment_columns_;
  std::vector<std::int32_t> fragment_numbers_;
};

}  // namespace ejecta
