#include "observe/channels.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "observe/columns.hpp"
#include "observe/slice.hpp"

namespace ejecta {

/// A field as VTK reads it: vectors of three components, symmetric tensors as XX, YY, ZZ, XY, YZ, XZ, others row by
/// row. Our own order of a symmetric tensor is XX, YY, ZZ, XY, XZ, YZ, and in the plane there is no z.
template <int Dim>
FieldView FrameChannels<Dim>::shown(const Particles<Dim>& p, Field field) {
  FieldView view = field_view(p, field);
  auto& c = view.components;
  const std::span<const double> zero = zeros_;
  switch (info(field).shape) {
    case Shape::scalar:
      break;
    case Shape::vector:
      if (Dim == 2) c = {c[0], c[1], zero};
      break;
    case Shape::tensor:
      if (Dim == 2) c = {c[0], c[1], zero, c[2], c[3], zero, zero, zero, zero};
      break;
    case Shape::symmetric:
      if constexpr (Dim == 2)
        c = {c[0], c[1], zero, c[2], zero, zero};
      else
        c = {c[0], c[1], c[2], c[3], c[5], c[4]};
      break;
    case Shape::deviator: {
      const std::span<const double> xx = c[0], yy = c[1];
      std::vector<double>& zz = last_diagonals_.emplace_back(p.size());
      parallel_blocks(p.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) zz[i] = -(xx[i] + yy[i]);
      });
      if constexpr (Dim == 2)
        c = {xx, yy, zz, c[2], zero, zero};
      else
        c = {xx, yy, zz, c[2], c[4], c[3]};
      break;
    }
  }
  return view;
}

template <int Dim>
Channel FrameChannels<Dim>::particles(const Particles<Dim>& p, const std::optional<FragmentTable>& fragments) {
  Channel particles;
  particles.name = "particles";
  particles.count = p.size();
  for (int a = 0; a < Dim; ++a) particles.position[static_cast<std::size_t>(a)] = p.column(Field::position, a);
  last_diagonals_.clear();
  if (Dim == 2) {
    zeros_.assign(p.size(), 0.0);
    particles.position[2] = zeros_;
  }
  for (Field f : p.fields())
    if (f != Field::position && info(f).role != Role::rate) particles.fields.push_back(shown(p, f));
  tensor_fields_ = tensor_fields(p);
  for (const OwnedField& field : tensor_fields_) particles.fields.push_back(field.view());
  particles.indices = {
      {"id", p.label(Label::id)}, {"body", p.label(Label::body)}, {"material", p.label(Label::material)}};
  if (fragments) particles.indices.push_back({"fragment_number", fragments->number});
  return particles;
}

template <int Dim>
Channel FrameChannels<Dim>::fragments(const FragmentTable& table, std::size_t target) {
  enum { x, y, z, mass, vx, vy, vz, size, mean_damage, mean_distension, target_mass };
  for (auto& column : fragment_columns_) column.clear();
  fragment_numbers_.clear();
  for (const Fragment& f : table.fragments) {
    for (int a = 0; a < 3; ++a) {
      fragment_columns_[static_cast<std::size_t>(x + a)].push_back(f.centre[a]);
      fragment_columns_[static_cast<std::size_t>(vx + a)].push_back(f.velocity[a]);
    }
    fragment_columns_[mass].push_back(f.carried.mass);
    fragment_columns_[size].push_back(f.semi_axes[0]);
    fragment_columns_[mean_damage].push_back(f.mean_damage);
    fragment_columns_[target_mass].push_back(f.mass_of(target));
    fragment_columns_[mean_distension].push_back(f.mean_distension);
    fragment_numbers_.push_back(f.number);
  }
  const auto& c = fragment_columns_;
  Channel channel;
  channel.name = "fragments";
  channel.count = fragment_numbers_.size();
  channel.position = {c[x], c[y], c[z]};
  channel.fields = {{"mass", Dim == 3 ? "kg" : "kg/m", {c[mass]}},
                    {"target_mass", Dim == 3 ? "kg" : "kg/m", {c[target_mass]}},
                    {"velocity", "m/s", {c[vx], c[vy], c[vz]}},
                    {"longest_semi_axis", "m", {c[size]}},
                    {"damage", "1", {c[mean_damage]}},
                    {"distension", "1", {c[mean_distension]}}};
  channel.indices = {{"number", fragment_numbers_}};
  return channel;
}

Channel slice_channel(const SampledImage& image, int dimension, double plane_y) {
  Channel channel = image_channel(image, "slice");
  if (dimension == 3) {  // the picture plane is x-z in space
    channel.extent = {channel.extent[0], 1, channel.extent[1]};
    channel.origin = {channel.origin[0], plane_y, channel.origin[1]};
    channel.spacing = {channel.spacing[0], 1, channel.spacing[1]};
  }
  return channel;
}

template <int Dim>
Channel FrameChannels<Dim>::slice(const Particles<Dim>& p, Kernel kernel, const PixelGrid& grid, double plane_y) {
  std::vector<Field> fields = slice_fields(p);
  for (const Field more : {Field::density, Field::velocity})
    if (std::ranges::find(fields, more) == fields.end()) fields.push_back(more);
  slice_ = make_slice(p, fields, kernel, grid, plane_y);
  return slice_channel(slice_, Dim, plane_y);
}

template <int Dim>
Channel FrameChannels<Dim>::ellipsoids(const Particles<Dim>& p, double plane_y, double nodes_per_h) {
  ellipsoids_ = find_ellipsoids(p, plane_y, nodes_per_h);
  return ellipsoids_.channel("ellipsoids");
}

template <int Dim>
Channel FrameChannels<Dim>::volume(const Particles<Dim>& p, Kernel kernel, const View& view,
                                   double spacing) requires(Dim == 3) {
  volume_ = make_volume(p, kernel, view, spacing);
  return volume_.channel("volume");
}

template class FrameChannels<2>;
template class FrameChannels<3>;

}  // namespace ejecta
