#pragma once
/// Images of particle fields with the true kernel: slices and column densities. No graphics library is involved; the
/// result is a channel of kind `image`, or is painted by image.hpp.
#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "model/channel.hpp"

namespace ejecta {

/// Shape of the smoothing kernel: W(x) = det(H) value(|H x|), normalised to volume integral 1, zero from `support` on.
/// H is the inverse of the smoothing length, or the tensor of ASPH.
struct KernelShape {
  double support;
  std::function<double(double)> value;
};

/// The particles as columns of equal length, SI. z is empty in plane strain.
struct ParticleView {
  std::array<std::span<const double>, 3> position;
  std::span<const double> mass, density, smoothing_length;
  /// G = H H [1/m^2] in the order of Symmetric (3 or 6 columns). All empty: H is round, 1 / smoothing_length.
  std::array<std::span<const double>, 6> smoothing_metric;

  std::size_t size() const { return mass.size(); }
  int dimension() const { return position[2].empty() ? 2 : 3; }
  /// G of one particle.
  template <int Dim>
  Mat<Dim> metric(std::size_t i) const;
};

/// Square pixels of the picture plane. In 3D its axes are x (horizontal) and z (vertical), in plane strain x and y.
struct PixelGrid {
  int width = 1, height = 1;
  std::array<double, 2> first{0, 0};  ///< centre of the lower left pixel [m]
  double pixel = 1;                   ///< size of a pixel [m]
};
/// The grid of the given pixels about `centre`, `visible_width` [m] across.
PixelGrid centred_grid(int width, int height, std::array<double, 2> centre, double visible_width);

/// Fields on a pixel grid; rows run upwards, NaN where there is no matter.
struct SampledImage {
  using Field = OwnedField;  ///< width * height values a component, x fastest
  PixelGrid grid;
  std::vector<Field> fields;

  const Field& field(std::string_view name) const;
};

/// Slice through y = plane_y (3D) or of the whole domain (plane strain): per pixel centre and field A the Shepard mean
/// sum_j V_j A_j W_j / sum_j V_j W_j, V = m/rho; NaN where the filling sum_j V_j W_j is below `least_filling`.
/// Damage is that of the particle which is nearest by its own kernel, and no mean.
/// The field `filling` [1] comes last. Bit for bit the same for every number of threads.
SampledImage sample_slice(const ParticleView& particles, std::span<const FieldView> fields, const KernelShape& kernel,
                          const PixelGrid& grid, double plane_y = 0, double least_filling = 0.3);

/// Mass per area seen along y, field `column_density` [kg/m^2]: sum_j m_j times the line integral of the kernel (plane
/// strain: the areal density itself, kg/m^3). Particles finer than a pixel are smeared over one so that the pixels
/// add up to the mass; NaN where there is none.
SampledImage sample_column_density(const ParticleView& particles, const KernelShape& kernel, const PixelGrid& grid);

/// The image as channel `name`: x horizontal, second axis vertical, whatever the dimension. Valid while `image` lives.
Channel image_channel(const SampledImage& image, std::string name);

}  // namespace ejecta
