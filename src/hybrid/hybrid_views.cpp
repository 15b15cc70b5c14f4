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
  const Particles<Dim>& p = particles_->particles;
  const std::size_t cells = grid_.box().size();
  std::vector<std::uint32_t> cell(p.size());
  first_.assign(cells + 1, 0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    cell[i] = static_cast<std::uint32_t>(cell_of(grid_.box(), p.vector(Field::position, i)));
    ++first_[cell[i] + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  in_cells_.resize(p.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < p.size(); ++i) in_cells_[next[cell[i]]++] = static_cast<std::uint32_t>(i);
}

template <int Dim>
std::optional<double> Hybrid<Dim>::pressure_at(const Vec<Dim>& x) const {
  const auto by_grid = grid_.pressure_at(x);
  if (!by_grid) return by_grid;
  const Box<Dim>& box = grid_.box();
  const std::size_t cell = cell_of(box, x);
  if (zone_[cell] != Part::active) return by_grid;
  NearMean<Dim> mean(particles_->particles, x);
  for_cells_near<Dim>(box, box.cell(cell), 1, [&](std::size_t near, int) {
    for (std::uint32_t k = first_[near]; k < first_[near + 1]; ++k) mean.add(in_cells_[k]);
  });
  return mean.pressure(*by_grid);
}

template <int Dim>
std::optional<CellState<Dim>> Hybrid<Dim>::at(const Vec<Dim>& x) const {
  auto state = grid_.at(x);
  if (!state) return state;
  const Box<Dim>& box = grid_.box();
  const std::size_t cell = cell_of(box, x);
  if (zone_[cell] != Part::active) return state;
  const Particles<Dim>& p = particles_->particles;
  double nearest = std::numeric_limits<double>::infinity();
  for_cells_near<Dim>(box, box.cell(cell), 1, [&](std::size_t near, int) {
    for (std::uint32_t k = first_[near]; k < first_[near + 1]; ++k) {
      const std::size_t i = in_cells_[k];
      const double squares = (p.vector(Field::position, i) - x).squaredNorm();
      if (squares >= nearest) continue;
      nearest = squares;
      state = {p.column(Field::density)[i], p.column(Field::pressure)[i], p.column(Field::sound_speed)[i],
               p.column(Field::specific_energy)[i], p.vector(Field::velocity, i)};
    }
  });
  return state;
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
  for (std::size_t i = 0; i < particles_->particles.size(); ++i)
    if (part_of(i) == Part::active)
      blast->peak_density = std::max(blast->peak_density, particles_->particles.column(Field::density)[i]);
  return blast;
}

template <int Dim>
Quantities Hybrid<Dim>::quantities() const {
  Quantities list = grid_.quantities_of_cells();
  list.push_back(
      {"particles", "1", static_cast<std::int64_t>(particles_->elements()), "in the zone and in the belt around it"});
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
template std::optional<BlastFront> Hybrid<2>::blast() const;
template std::optional<BlastFront> Hybrid<3>::blast() const;
template Quantities Hybrid<2>::quantities() const;
template Quantities Hybrid<3>::quantities() const;
template std::string Hybrid<2>::outline() const;
template std::string Hybrid<3>::outline() const;
template std::vector<Channel> Hybrid<2>::channels(const Asked&) const;
template std::vector<Channel> Hybrid<3>::channels(const Asked&) const;

}  // namespace ejecta
