#include "particles/boundary_images.hpp"

namespace ejecta {

double image_position(const Boundary& boundary, const Image& image, int axis, double x) {
  if (image.mirror[axis] < 0) return 2 * boundary.min[axis] - x;
  if (image.mirror[axis] > 0) return 2 * boundary.max[axis] - x;
  if (image.shift[axis] == 0) return x;  // an open axis need not have bounds
  return x + image.shift[axis] * (boundary.max[axis] - boundary.min[axis]);
}

template <int Dim>
void make_images(const Particles<Dim>& particles, const Boundary& boundary, double reach, std::vector<Image>& images) {
  images.clear();
  if (!bounded(boundary)) return;
  for (std::uint32_t i = 0; i < particles.size(); ++i) {
    // Axis by axis every image so far (and the particle itself) may get an image of its own: faces, edges, corners.
    std::array<Image, 27> made;
    made[0] = Image{i};
    std::size_t count = 1;
    for (int a = 0; a < Dim; ++a) {
      if (boundary.kind[a] == BoundaryKind::open) continue;
      const double x = particles.column(Field::position, a)[i];
      const bool near_min = x<boundary.min[a] + reach, near_max = x> boundary.max[a] - reach;
      const bool periodic = boundary.kind[a] == BoundaryKind::periodic;
      const std::size_t before = count;
      for (std::size_t k = 0; k < before; ++k) {
        if (near_min) {
          Image image = made[k];
          (periodic ? image.shift[a] : image.mirror[a]) = periodic ? 1 : -1;
          made[count++] = image;
        }
        if (near_max) {
          Image image = made[k];
          (periodic ? image.shift[a] : image.mirror[a]) = periodic ? -1 : 1;
          made[count++] = image;
        }
      }
    }
    images.insert(images.end(), made.begin() + 1, made.begin() + static_cast<std::ptrdiff_t>(count));
  }
}

namespace {

/// Components that change sign in a mirror across an axis: of a vector its own, of a tensor those that hold it once.
template <int Dim>
std::vector<int> odd_components(Shape shape, int axis) {
  if (shape == Shape::vector) return {axis};
  std::vector<int> odd;
  if (shape == Shape::tensor) {
    for (int other = 0; other < Dim; ++other)
      if (other != axis) odd.insert(odd.end(), {axis * Dim + other, other * Dim + axis});
    return odd;
  }
  if (Dim == 2) return {2};
  const int xy = shape == Shape::deviator ? 2 : 3;  // then xz and yz: base/types.hpp
  for (int pair = 0; pair < 3; ++pair)
    if (pair != 2 - axis) odd.push_back(xy + pair);
  return odd;
}

/// Puts particle i in the place and state of its mirror image at a face. That is the same state of the same system, so
/// energy and the momentum along the wall do not notice.
template <int Dim>
void mirror(Particles<Dim>& particles, std::size_t i, int axis, double face) {
  for (Field f : {Field::position, Field::start_position}) {
    if (!particles.has(f)) continue;
    double& x = particles.column(f, axis)[i];
    x = 2 * face - x;
  }
  // The gradients strain and turn cracks in the coming stages.
  for (Field f :
       {Field::velocity, Field::acceleration, Field::deviatoric_stress, Field::stress_rate, Field::damage_tensor,
        Field::strain_history, Field::smoothing_metric, Field::velocity_gradient, Field::coupled_gradient}) {
    if (!particles.has(f)) continue;
    for (int k : odd_components<Dim>(info(f).shape, axis)) {
      particles.column(f, k)[i] *= -1;
      if (info(f).role != Role::rate) continue;
      particles.previous(f, k)[i] *= -1;
      if (f != Field::acceleration) particles.expected(f, k)[i] *= -1;
    }
  }
}

}  // namespace

template <int Dim>
void wrap_positions(Particles<Dim>& particles, const Boundary& boundary) {
  for (int a = 0; a < Dim; ++a) {
    if (mirrors(boundary.kind[a])) {
      const auto x = particles.column(Field::position, a);
      for (std::size_t i = 0; i < x.size(); ++i) {
        if (x[i] < boundary.min[a]) mirror(particles, i, a, boundary.min[a]);
        if (x[i] > boundary.max[a]) mirror(particles, i, a, boundary.max[a]);
      }
    }
    if (boundary.kind[a] != BoundaryKind::periodic) continue;
    const double low = boundary.min[a], length = boundary.max[a] - low;
    const auto x = particles.column(Field::position, a);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double shift = x[i] < low ? length : x[i] >= low + length ? -length : 0;
      if (shift == 0) continue;
      x[i] += shift;
      if (particles.has(Field::start_position)) particles.column(Field::start_position, a)[i] += shift;
    }
  }
}

template void make_images<2>(const Particles<2>&, const Boundary&, double, std::vector<Image>&);
template void wrap_positions<2>(Particles<2>&, const Boundary&);
template void make_images<3>(const Particles<3>&, const Boundary&, double, std::vector<Image>&);
template void wrap_positions<3>(Particles<3>&, const Boundary&);

}  // namespace ejecta
