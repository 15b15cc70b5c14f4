#include "particles/ghosts.hpp"

#include <algorithm>
#include <cmath>

namespace ejecta {

namespace {

/// Of each axis: itself, the image at or beyond its lower face, that at or beyond its upper one.
constexpr std::array<std::size_t, 3> first_of_axis{1, 3, 9};
constexpr std::size_t choices = 27;

/// All combinations, in the order of sums over the axes of first_of_axis times 0, 1 or 2.
std::array<Transform, choices> transforms_of(const Boundary& boundary) {
  std::array<Transform, choices> all;
  for (std::size_t k = 1; k < choices; ++k)
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t choice = k / first_of_axis[a] % 3;
      if (choice == 0) continue;
      const BoundaryKind kind = choice == 1 ? boundary.lower[a] : boundary.upper[a];
      Transform& t = all[k];
      if (kind == BoundaryKind::periodic) t.offset[a] = choice == 1 ? boundary.length(a) : -boundary.length(a);
      if (!mirrors(kind)) continue;
      t.sign[a] = -1;
      t.offset[a] = 2 * (choice == 1 ? boundary.min[a] : boundary.max[a]);
      t.behind_wall |= kind == BoundaryKind::reflecting;
    }
  return all;
}

}  // namespace

template <int Dim>
void find_ghosts(const Particles<Dim>& particles, const Guests<Dim>& guests, const Boundary& boundary, double reach,
                 GhostList<Dim>& list) {
  list.ghosts.clear();
  list.guests = guests;
  list.transforms = transforms_of(boundary);
  const bool bounded = boundary.bounded();
  for (std::size_t owner = 0; owner <= guests.size(); ++owner) {
    const Particles<Dim>& sources = owner == 0 ? particles : *guests[owner - 1];
    if (owner == 0 && !bounded) continue;
    for (std::uint32_t i = 0; i < sources.size(); ++i) {
      // Axis by axis every ghost so far (and the particle itself) may get an image: faces, edges, corners.
      std::array<std::uint16_t, choices> made{};
      std::size_t count = 1;
      for (std::size_t a = 0; a < Dim; ++a) {
        const double x = sources.column(Field::position, static_cast<int>(a))[i];
        const bool near_lower = boundary.lower[a] != BoundaryKind::open && x < boundary.min[a] + reach,
                   near_upper = boundary.upper[a] != BoundaryKind::open && x > boundary.max[a] - reach;
        const std::size_t before = count;
        for (std::size_t k = 0; k < before; ++k) {
          if (near_lower) made[count++] = static_cast<std::uint16_t>(made[k] + first_of_axis[a]);
          if (near_upper) made[count++] = static_cast<std::uint16_t>(made[k] + 2 * first_of_axis[a]);
        }
      }
      for (std::size_t k = owner == 0 ? 1 : 0; k < count; ++k)  // own particles see themselves without a ghost
        list.ghosts.push_back({static_cast<std::uint16_t>(owner), made[k], i});
    }
  }
}

namespace {

/// Components that change sign in a mirror across an axis: of a vector its own, of a tensor those that hold it once.
template <int Dim>
std::vector<int> odd_components(Shape shape, int axis) {
  if (shape == Shape::scalar) return {};
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
  for (const FieldInfo& f : field_catalogue()) {
    if (!particles.has(f.field) || f.role == Role::constant) continue;
    if (f.field == Field::position || f.field == Field::start_position) {
      double& x = particles.column(f.field, axis)[i];
      x = 2 * face - x;
      continue;
    }
    // Derived ones too: the gradients strain and turn cracks in the coming stages.
    for (int k : odd_components<Dim>(f.shape, axis)) {
      particles.column(f.field, k)[i] *= -1;
      if (f.role != Role::rate) continue;
      particles.previous(f.field, k)[i] *= -1;
      if (f.field != Field::acceleration) particles.expected(f.field, k)[i] *= -1;
    }
  }
}

}  // namespace

template <int Dim>
void wrap_positions(Particles<Dim>& particles, const Boundary& boundary) {
  for (int a = 0; a < Dim; ++a) {
    const auto k = static_cast<std::size_t>(a);
    const double low = boundary.min[k], high = boundary.max[k];
    const auto x = particles.column(Field::position, a);
    if (mirrors(boundary.lower[k]))
      for (std::size_t i = 0; i < x.size(); ++i)
        if (x[i] < low) mirror(particles, i, a, low);
    if (mirrors(boundary.upper[k]))
      for (std::size_t i = 0; i < x.size(); ++i)
        if (x[i] > high) mirror(particles, i, a, high);
    if (!boundary.periodic(k)) continue;
    const double length = boundary.length(k);
    for (std::size_t i = 0; i < x.size(); ++i) {
      double shift = 0;  // one period, but for a body that begins further off
      if (x[i] < low) shift = length * std::max(1.0, std::ceil((low - x[i]) / length));
      if (x[i] >= low + length) shift = -length * std::max(1.0, std::floor((x[i] - low) / length));
      if (shift == 0) continue;
      x[i] += shift;
      if (particles.has(Field::start_position)) particles.column(Field::start_position, a)[i] += shift;
    }
  }
}

template void find_ghosts<2>(const Particles<2>&, const Guests<2>&, const Boundary&, double, GhostList<2>&);
template void find_ghosts<3>(const Particles<3>&, const Guests<3>&, const Boundary&, double, GhostList<3>&);
template void wrap_positions<2>(Particles<2>&, const Boundary&);
template void wrap_positions<3>(Particles<3>&, const Boundary&);

}  // namespace ejecta
