#pragma once
/// Images of particles beyond periodic and reflecting faces. Images exist only as partners in the pair lists: they
/// have no columns, and their records are made from those of their sources at every pass.
#include <array>
#include <cstdint>
#include <vector>

#include "particles/particles.hpp"
#include "scene/choices.hpp"

namespace ejecta {

/// An image of particle `source`: shifted by `shift` box lengths, or mirrored at a face, axis by axis.
struct Image {
  std::uint32_t source;
  std::array<std::int8_t, 3> shift{0, 0, 0};   ///< periodic: -1, 0, 1 box lengths
  std::array<std::int8_t, 3> mirror{0, 0, 0};  ///< reflecting: -1 lower face, 1 upper face, 0 none
};

/// Mirrors a symmetric tensor (order: base/types.hpp) across an axis: the off-diagonals that hold it once flip.
template <int Dim, class T>
void mirror_symmetric(T* tensor, int axis) {
  if constexpr (Dim == 2) {
    tensor[2] = -tensor[2];
  } else {
    for (int pair = 0; pair < 3; ++pair)  // xy, xz, yz: each axis takes part in two of them
      if (pair != 2 - axis) tensor[3 + pair] = -tensor[3 + pair];
  }
}

/// Whether the images behind a face are mirror images.
inline bool mirrors(BoundaryKind kind) { return kind == BoundaryKind::reflecting || kind == BoundaryKind::symmetry; }

/// Position of the image of x along one axis.
double image_position(const Boundary& boundary, const Image& image, int axis, double x);

/// All images of particles nearer than `reach` [m] to a face. A periodic box must be wider than twice the reach.
template <int Dim>
void make_images(const Particles<Dim>& particles, const Boundary& boundary, double reach, std::vector<Image>& images);

/// Puts particles that left a periodic face back in at the other side, and those that crossed a mirroring face back as
/// their own mirror images, with where they started: two particles and their images may pass through each other where matter is cold and
/// violent.
template <int Dim>
void wrap_positions(Particles<Dim>& particles, const Boundary& boundary);

/// True if any axis is not open.
inline bool bounded(const Boundary& b) {
  for (BoundaryKind k : b.kind)
    if (k != BoundaryKind::open) return true;
  return false;
}

}  // namespace ejecta
