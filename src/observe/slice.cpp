#include "observe/slice.hpp"

#include "observe/columns.hpp"
#include "schemes/kernels.hpp"

namespace ejecta {

namespace {

template <int Dim>
KernelShape kernel_shape(Kernel kernel) {
  return with_kernel(kernel, [](auto k) {
    using K = decltype(k);
    return KernelShape{K::support, [](double q) { return K::template norm<Dim> * K::value(q); }};
  });
}

}  // namespace

template <int Dim>
std::vector<Field> slice_fields(const Particles<Dim>& p) {
  if (!p.has(Field::damage)) return {Field::density, Field::pressure, Field::velocity};
  if (!p.has(Field::distension)) return {Field::pressure, Field::damage};
  return {Field::pressure, Field::distension, Field::damage};
}

template <int Dim>
SampledImage make_slice(const Particles<Dim>& p, std::span<const Field> fields, Kernel kernel, const PixelGrid& grid,
                        double plane_y) {
  std::vector<FieldView> views;
  for (Field f : fields) views.push_back(field_view(p, f));
  return sample_slice(particle_view(p), views, kernel_shape<Dim>(kernel), grid, plane_y);
}

SampledVolume make_volume(const Particles<3>& p, Kernel kernel, const View& view, double spacing) {
  constexpr double steps_per_spacing = 1.25, most_points = 4e6;
  const Window window = view.window(3);
  const std::array low{window.low[0], view.center[1], window.low[1]};
  const std::array high{window.high[0], view.center[1] + 0.5 * view.width, window.high[1]};
  const Lattice3 lattice = lattice_within(low, high, spacing / steps_per_spacing, most_points);
  return sample_volume(particle_view(p), p.label(Label::body), kernel_shape<3>(kernel), lattice);
}

template <int Dim>
SampledImage make_column_density(const Particles<Dim>& p, Kernel kernel, const PixelGrid& grid) {
  return sample_column_density(particle_view(p), kernel_shape<Dim>(kernel), grid);
}

template std::vector<Field> slice_fields<2>(const Particles<2>&);
template std::vector<Field> slice_fields<3>(const Particles<3>&);
template SampledImage make_slice<2>(const Particles<2>&, std::span<const Field>, Kernel, const PixelGrid&, double);
template SampledImage make_slice<3>(const Particles<3>&, std::span<const Field>, Kernel, const PixelGrid&, double);
template SampledImage make_column_density<2>(const Particles<2>&, Kernel, const PixelGrid&);
template SampledImage make_column_density<3>(const Particles<3>&, Kernel, const PixelGrid&);

}  // namespace ejecta
