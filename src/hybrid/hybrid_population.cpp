/// The particles of a hybrid go with its zone.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.hpp"
#include "hybrid/hybrid.hpp"
#include "material/matter_at.hpp"

namespace ejecta {

template <int Dim>
void Hybrid<Dim>::remove_outside() {
  Particles<Dim>& p = particles_->particles;
  std::vector<std::uint32_t> order(p.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto outside = std::stable_partition(order.begin(), order.end(), [&](std::uint32_t i) {
    return zone_.covered(cell_of(grid_.box(), p.vector(Field::position, i))) || is_image(p, i);
  });
  if (outside == order.end()) return;
  p.reorder(order);
  p.resize(static_cast<std::size_t>(outside - order.begin()));
}

/// Particles where the zone has come to, and where gas has left the belt around it empty.
template <int Dim>
void Hybrid<Dim>::fill_holes(const std::vector<Part>& before) {
  Particles<Dim>& p = particles_->particles;
  const Box<Dim>& box = grid_.box();
  look();
  const double all = std::pow(settings_.ratio, Dim);  // particles of a cell
  std::vector<Vec<Dim>> sites;
  std::vector<double> size(p.size());
  parallel_for(0, p.size(), [&](std::size_t i) {
    size[i] = std::pow(p.column(Field::mass)[i] / p.column(Field::density)[i], 1.0 / Dim);
  });
  const auto is_free = [&](std::size_t cell, const Vec<Dim>& x) {
    bool found = false;
    by_cell_.for_near(box, cell, 1, [&](std::size_t i) {
      const double squares = shortest_way<Dim>(box, x, p.vector(Field::position, i)).squaredNorm();
      const double apart = room_for_particles * 0.5 * (size[i] + scene_.spacing);
      found = found || squares < apart * apart;
    });
    return !found;
  };
  for (const std::size_t cell : cells_of(false)) {
    const bool fresh = before[cell] == Part::grid;
    if (!fresh && zone_[cell] == Part::active) continue;
    if (!fresh && by_cell_.count(cell) >= static_cast<std::size_t>(all)) continue;
    for_points<Dim>(box.centre(box.cell(cell)), box.spacing, settings_.ratio, [&](const Vec<Dim>& x) {
      if (is_free(cell, x)) sites.push_back(x);
    });
  }
  if (sites.empty()) return;
  const CellLines<Dim> lines(grid_, cells_of(false));
  const double volume = box.cell_volume() / all;
  const std::size_t n = p.size();
  std::int32_t id = n == 0 ? 0 : std::ranges::max(p.label(Label::id));
  p.resize(n + sites.size());
  for (std::size_t k = 0; k < sites.size(); ++k) {
    const std::size_t i = n + k;
    const PointState<Dim> s = lines.at(sites[k]);
    p.set_vector(Field::position, i, sites[k]);
    p.set_vector(Field::velocity, i, s.velocity);
    p.column(Field::density)[i] = s.density;
    p.column(Field::mass)[i] = s.density * volume;
    p.column(Field::specific_energy)[i] = s.specific_energy;
    p.column(Field::smoothing_length)[i] = scene_.numerics.nodes_per_h * scene_.spacing;
    p.label(Label::id)[i] = ++id;
    p.label(Label::body)[i] = static_cast<std::int32_t>(scene_.bodies.size()) - 1;
    p.label(Label::material)[i] = 0;
    if (solids_) p.column(Field::wall)[i] = 0;
  }
}

template <int Dim>
void Hybrid<Dim>::move_zone() {
  const Box<Dim> box = grid_.box();
  grid_.make_room();
  if (grid_.box().size() != box.size()) zone_.follow(box, grid_.box());
  const std::vector<Part> before = zone_.parts();
  zone_.update(grid_, cells_of_solids());
  Particles<Dim>& p = particles_->particles;
  const std::size_t n = p.size();
  remove_outside();
  const std::size_t left = p.size();
  fill_holes(before);
  if (left == n && p.size() == n) return;
  p.set_material_ranges(ranges_of_materials(p.label(Label::material), particles_->materials.size()));
  particles_->lists.invalidate();
}

template void Hybrid<2>::remove_outside();
template void Hybrid<3>::remove_outside();
template void Hybrid<2>::fill_holes(const std::vector<Part>&);
template void Hybrid<3>::fill_holes(const std::vector<Part>&);
template void Hybrid<2>::move_zone();
template void Hybrid<3>::move_zone();

}  // namespace ejecta
