/// What a hybrid shows of itself.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hybrid/hybrid.hpp"
#include "model/find_blast.hpp"
#include "scene/shape_geometry.hpp"
#include "scene/units.hpp"
#include "sph/near_mean.hpp"

namespace ejecta {

template <int Dim>
void Hybrid<Dim>::look() const {
  by_cell_.sort(particles_->particles, grid_.box());
  if (solids_) solid_of_id_ = solids_->by_id();
}

template <int Dim>
std::optional<double> Hybrid<Dim>::pressure_at(const Vec<Dim>& x) const {
  const auto by_grid = grid_.pressure_at(x);
  if (!by_grid) return by_grid;
  const Box<Dim>& box = grid_.box();
  const std::size_t cell = cell_of(box, x);
  if (zone_[cell] != Part::active) return by_grid;
  NearMean<Dim> mean(particles_->particles, x);
  by_cell_.for_near(box, cell, 1, [&](std::size_t i) { mean.add(i); });
  return mean.pressure(*by_grid);
}

template <int Dim>
std::optional<std::size_t> Hybrid<Dim>::nearest(const Vec<Dim>& x) const {
  const Box<Dim>& box = grid_.box();
  if (!grid_.at(x) || zone_[cell_of(box, x)] != Part::active) return std::nullopt;
  const Particles<Dim>& p = particles_->particles;
  double least = std::numeric_limits<double>::infinity();
  std::optional<std::size_t> found;
  by_cell_.for_near(box, cell_of(box, x), 1, [&](std::size_t i) {
    const double squares = (p.vector(Field::position, i) - x).squaredNorm();
    if (squares >= least) return;
    least = squares;
    found = i;
  });
  return found;
}

template <int Dim>
std::optional<CellState<Dim>> Hybrid<Dim>::at(const Vec<Dim>& x) const {
  const auto i = nearest(x);
  if (!i) return grid_.at(x);
  const Particles<Dim>& p = particles_->particles;
  if (is_image(p, *i)) return std::nullopt;
  return CellState<Dim>{p.column(Field::density)[*i], p.column(Field::pressure)[*i], p.column(Field::sound_speed)[*i],
                        p.column(Field::specific_energy)[*i], p.vector(Field::velocity, *i)};
}

template <int Dim>
std::optional<std::size_t> Hybrid<Dim>::solid_at(const Vec<Dim>& x) const {
  if (!solids_) return std::nullopt;
  const auto i = nearest(x);
  if (!i || !is_image(particles_->particles, *i)) return std::nullopt;
  return solid_of_id_[static_cast<std::size_t>(particles_->particles.label(Label::id)[*i])];
}

template <int Dim>
std::optional<BlastFront> Hybrid<Dim>::blast() const {
  if (!scene_.charge || !scene_.gas) return std::nullopt;
  look();
  const Box<Dim>& box = grid_.box();
  double farthest = 0;
  for (const int n : box.cells) farthest += n * n * box.spacing * box.spacing;
  auto blast = find_blast<Dim>(first_components<Dim>(scene_.charge->center), scene_.spacing, std::sqrt(farthest),
                               grid_.ambient().pressure, [&](const Vec<Dim>& x) { return pressure_at(x); });
  if (!blast) return blast;
  blast->peak_density = *std::ranges::max_element(grid_.cells()[0]);
  const Particles<Dim>& p = particles_->particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (part_at(p.vector(Field::position, i)) == Part::active && !is_image(p, i))
      blast->peak_density = std::max(blast->peak_density, p.column(Field::density)[i]);
  return blast;
}

template <int Dim>
Quantities Hybrid<Dim>::quantities() const {
  Quantities list = grid_.quantities_of_cells();
  list.push_back(
      {"particles", "1", static_cast<std::int64_t>(particles_->elements()), "in the zone and in the belt around it"});
  if (solids_)
    for (Quantity q : solids_->particles().quantities()) {
      q.name = "solids: " + q.name;
      list.push_back(std::move(q));
    }
  list.push_back(
      {"zone", "1", static_cast<std::int64_t>(zone_.count(Part::active)), "cells that follow their particles"});
  if (scene_.charge && scene_.gas) std::ranges::move(quantities_of(blast()), std::back_inserter(list));
  return list;
}

template <int Dim>
std::string Hybrid<Dim>::outline() const {
  std::string text = grid_.outline();
  text += fmt::format("hybrid\n  particles          {} of {} at the start, {} to a cell\n", particles_->elements(),
                      format_quantity(scene_.spacing, "m"), std::pow(settings_.ratio, Dim));
  if (solids_) text += "solids\n" + solids_->particles().outline();
  return text;
}

template <int Dim>
std::vector<Channel> Hybrid<Dim>::channels(const Asked& asked) const {
  std::vector<Channel> list = grid_.channels(asked);
  for (Channel& channel : list) {
    shown_zone_.assign(zone_.parts().size(), 0);
    for (std::size_t i = 0; i < shown_zone_.size(); ++i) shown_zone_[i] = static_cast<double>(zone_[i]);
    channel.fields.push_back({"zone", "1", {shown_zone_}});
  }
  return list;
}

template void Hybrid<2>::look() const;
template void Hybrid<3>::look() const;
template std::optional<double> Hybrid<2>::pressure_at(const Vec<2>&) const;
template std::optional<double> Hybrid<3>::pressure_at(const Vec<3>&) const;
template std::optional<CellState<2>> Hybrid<2>::at(const Vec<2>&) const;
template std::optional<CellState<3>> Hybrid<3>::at(const Vec<3>&) const;
template std::optional<std::size_t> Hybrid<2>::nearest(const Vec<2>&) const;
template std::optional<std::size_t> Hybrid<3>::nearest(const Vec<3>&) const;
template std::optional<std::size_t> Hybrid<2>::solid_at(const Vec<2>&) const;
template std::optional<std::size_t> Hybrid<3>::solid_at(const Vec<3>&) const;
template std::optional<BlastFront> Hybrid<2>::blast() const;
template std::optional<BlastFront> Hybrid<3>::blast() const;
template Quantities Hybrid<2>::quantities() const;
template Quantities Hybrid<3>::quantities() const;
template std::string Hybrid<2>::outline() const;
template std::string Hybrid<3>::outline() const;
template std::vector<Channel> Hybrid<2>::channels(const Asked&) const;
template std::vector<Channel> Hybrid<3>::channels(const Asked&) const;

}  // namespace ejecta
