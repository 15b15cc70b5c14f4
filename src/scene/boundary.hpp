#pragma once
/// Faces of a box around everything.
#include <algorithm>
#include <array>

#include "scene/choices.hpp"

namespace ejecta {

/// reflecting: a wall, which solids press against and leave; symmetry: a plane that matter goes on behind.
enum class BoundaryKind { open, periodic, reflecting, symmetry };

/// Whether what is behind a face of this kind is a mirror image.
constexpr bool mirrors(BoundaryKind kind) { return kind == BoundaryKind::reflecting || kind == BoundaryKind::symmetry; }

/// Each face has its kind; matter goes on for ever beyond those that are open. Periodic are both faces of an axis or
/// none.
struct Boundary {
  std::array<BoundaryKind, 3> lower{}, upper{};               ///< faces across x, y, z
  Triple min{unset, unset, unset}, max{unset, unset, unset};  ///< m; where they are; any number for open ones

  bool periodic(std::size_t axis) const { return lower[axis] == BoundaryKind::periodic; }
  double length(std::size_t axis) const { return max[axis] - min[axis]; }  ///< m; of a periodic axis
  /// Whether a coordinate [m] is not beyond a face.
  bool within(std::size_t axis, double x) const {
    return (lower[axis] == BoundaryKind::open || x >= min[axis]) &&
           (upper[axis] == BoundaryKind::open || x <= max[axis]);
  }
  /// Whether there is a face that says yes.
  template <class Says>
  bool any(Says&& says) const {
    return std::ranges::any_of(lower, says) || std::ranges::any_of(upper, says);
  }
  /// Whether there is any face at all.
  bool bounded() const {
    return any([](BoundaryKind kind) { return kind != BoundaryKind::open; });
  }
};

}  // namespace ejecta
