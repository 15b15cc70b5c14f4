#pragma once
/// Particles that are seen though they are not here: behind mirrors, one period away, or handed in from elsewhere.
/// They exist only as partners in the pair lists: they have no columns of their own, and their records are made from
/// those of their sources at every pass.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "particles/particles.hpp"
#include "scene/boundary.hpp"

namespace ejecta {

/// From a source to its ghost: along each axis x' = sign x + offset.
struct Transform {
  std::array<std::int8_t, 3> sign{1, 1, 1};  ///< -1: seen in a mirror
  std::array<double, 3> offset{0, 0, 0};     ///< m
  bool behind_wall = false;                  ///< seen in a wall, which solids press against

  bool moves(int axis) const { return mirrors(axis) || offset[static_cast<std::size_t>(axis)] != 0; }
  bool mirrors(int axis) const { return sign[static_cast<std::size_t>(axis)] < 0; }
  double position(int axis, double x) const {
    const auto a = static_cast<std::size_t>(axis);
    return sign[a] < 0 ? offset[a] - x : x + offset[a];
  }
};

struct Ghost {
  std::uint16_t owner;      ///< of the source: 0 the particles that see it, k the k-th of their guests
  std::uint16_t transform;  ///< place in GhostList::transforms; 0: none
  std::uint32_t source;     ///< particle of the owner
};

/// Particles from elsewhere: received, or fed by another solver. They carry at least the columns that the passes read,
/// and bodies and materials of the same numbers. Whoever hands them in keeps them alive, moves them, and has chosen
/// those that may come within reach.
template <int Dim>
using Guests = std::vector<const Particles<Dim>*>;

template <int Dim>
struct GhostList {
  std::array<Transform, 27> transforms;  ///< on each axis none, at or beyond the lower face, or the upper one
  std::vector<Ghost> ghosts;
  Guests<Dim> guests;

  const Transform& transform(const Ghost& ghost) const { return transforms[ghost.transform]; }
  const Particles<Dim>& owner(const Ghost& ghost, const Particles<Dim>& own) const {
    return ghost.owner == 0 ? own : *guests[ghost.owner - 1u];
  }
  std::size_t size() const { return ghosts.size(); }
  std::size_t bytes() const { return ghosts.capacity() * sizeof(Ghost); }
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

/// All guests, and the images of particles and guests nearer than `reach` [m] to a face that is not open. A periodic
/// box must be wider than the reach.
template <int Dim>
void find_ghosts(const Particles<Dim>& particles, const Guests<Dim>& guests, const Boundary& boundary, double reach,
                 GhostList<Dim>& list);

/// Puts particles that left a periodic face back in at the other side, and those that crossed a mirroring face back as
/// their own mirror images, with where they started: two particles and their images may pass through each other where
/// matter is cold and violent.
template <int Dim>
void wrap_positions(Particles<Dim>& particles, const Boundary& boundary);

}  // namespace ejecta
