#include "particles/boundary_images.hpp"

namespace ejecta {

double image_position(const Boundary& boundary, const Image& image, int axis, double x) {
  if (image.mirror[axis] < 0) return 2 * boundary.min[axis] - x;
  if (image.mirror[axis] > 0) return 2 * boundary.max[axis] - x;
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

template <int Dim>
void wrap_positions(Particles<Dim>& particles, const Boundary& boundary) {
  for (int a = 0; a < Dim; ++a) {
    if (boundary.kind[a] != BoundaryKind::periodic) continue;
    const double low = boundary.min[a], length = boundary.max[a] - low;
    for (double& x : particles.column(Field::position, a)) {
      if (x < low) x += length;
      if (x >= low + length) x -= length;
    }
  }
}

template void make_images<2>(const Particles<2>&, const Boundary&, double, std::vector<Image>&);
template void wrap_positions<2>(Particles<2>&, const Boundary&);
template void make_images<3>(const Particles<3>&, const Boundary&, double, std::vector<Image>&);
template void wrap_positions<3>(Particles<3>&, const Boundary&);

}  // namespace ejecta
