/// What a grid shows of itself.
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "grid/grid.hpp"
#include "model/find_blast.hpp"
#include "scene/shape_geometry.hpp"

namespace ejecta {

template <int Dim>
std::optional<CellState<Dim>> Grid<Dim>::at(const Vec<Dim>& x) const {
  std::array<int, Dim> cell{};
  bool beyond = false;
  for (std::size_t a = 0; a < Dim; ++a) {
    cell[a] = static_cast<int>(std::floor((x[static_cast<int>(a)] - box_.corner[static_cast<int>(a)]) / box_.spacing));
    if ((cell[a] < 0 && !box_.grows_lower[a]) || (cell[a] >= box_.cells[a] && !box_.grows_upper[a]))
      return std::nullopt;
    beyond = beyond || cell[a] < 0 || cell[a] >= box_.cells[a];
  }
  return beyond ? ambient() : state(box_.index(cell));
}

template <int Dim>
CellState<Dim> Grid<Dim>::ambient() const {
  Conserved<Dim> gas;
  for (std::size_t c = 0; c < gas.size(); ++c) gas[c] = {ambient_[c]};
  return cell_state<Dim>(material_.eos, gas, 0);
}

template <int Dim>
std::optional<BlastFront> Grid<Dim>::blast() const {
  if (!scene_.charge || !scene_.gas) return std::nullopt;
  const Vec<Dim> centre = first_components<Dim>(scene_.charge->center);
  double farthest2 = 0;
  for (int a = 0; a < Dim; ++a) {
    const double low = centre[a] - box_.corner[a], high = box_.cells[static_cast<std::size_t>(a)] * box_.spacing - low;
    farthest2 += std::max(low, high) * std::max(low, high);
  }
  auto blast = find_blast<Dim>(centre, box_.spacing, std::sqrt(farthest2), ambient().pressure,
                               [&](const Vec<Dim>& x) { return pressure_at(x); });
  if (blast) blast->peak_density = *std::ranges::max_element(now_[0]);
  return blast;
}

template <int Dim>
std::optional<double> Grid<Dim>::pressure_at(const Vec<Dim>& x) const {
  std::array<int, Dim> cell{};
  Vec<Dim> share;
  for (std::size_t a = 0; a < Dim; ++a) {
    const auto i = static_cast<int>(a);
    const double place = (x[i] - box_.corner[i]) / box_.spacing;
    if (place < 0 || place > box_.cells[a]) return std::nullopt;
    const double middle = std::clamp(place - 0.5, 0.0, box_.cells[a] - 1.0);
    cell[a] = std::min(static_cast<int>(middle), std::max(0, box_.cells[a] - 2));
    share[i] = middle - cell[a];
  }
  double sum = 0;
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    std::array<int, Dim> at = cell;
    double weight = 1;
    for (std::size_t a = 0; a < Dim; ++a) {
      const bool upper = (corner >> a) & 1;
      weight *= upper ? share[static_cast<int>(a)] : 1 - share[static_cast<int>(a)];
      if (upper && at[a] + 1 < box_.cells[a]) ++at[a];
    }
    if (weight > 0) sum += weight * state(box_.index(at)).pressure;
  }
  return sum;
}

template <int Dim>
Quantities Grid<Dim>::quantities_of_cells() const {
  std::vector<double> highest(reduction_blocks, -std::numeric_limits<double>::infinity());
  parallel_blocks(reduction_blocks, 1, [&](std::size_t b, std::size_t) {
    for (std::size_t i = b * box_.size() / reduction_blocks; i < (b + 1) * box_.size() / reduction_blocks; ++i)
      highest[b] = std::max(highest[b], state(i).pressure);
  });
  const auto [least, most] = std::ranges::minmax(now_[0]);
  Quantities list{{"max pressure", "Pa", std::ranges::max(highest), "highest of a cell", true},
                  {"min density", "kg/m^3", least, "lowest of a cell"},
                  {"max density", "kg/m^3", most, "highest of a cell"},
                  {"cells", "1", static_cast<std::int64_t>(box_.size()), "of the grid"}};
  return list;
}

template <int Dim>
Quantities Grid<Dim>::quantities() const {
  Quantities list = quantities_of_cells();
  if (scene_.charge && scene_.gas) std::ranges::move(quantities_of(blast()), std::back_inserter(list));
  return list;
}

template <int Dim>
std::vector<Channel> Grid<Dim>::channels(const Asked& asked) const {
  if (!asked("grid")) return {};
  Channel channel;
  channel.name = "grid";
  channel.kind = ChannelKind::image;
  channel.count = box_.size();
  for (std::size_t a = 0; a < Dim; ++a) {
    channel.extent[a] = box_.cells[a];
    channel.origin[a] = box_.corner[static_cast<int>(a)] + 0.5 * box_.spacing;
    channel.spacing[a] = box_.spacing;
  }
  shown_ = {{"pressure", "Pa", {}}, {"velocity", "m/s", {}}, {"specific_energy", "J/kg", {}}, {"mach", "1", {}}};
  for (OwnedField& field : shown_)
    field.components.assign(field.name == "velocity" ? Dim : 1, std::vector<double>(box_.size()));
  parallel_for(0, box_.size(), [&](std::size_t i) {
    const CellState<Dim> s = state(i);
    shown_[0].components[0][i] = s.pressure;
    for (int a = 0; a < Dim; ++a) shown_[1].components[static_cast<std::size_t>(a)][i] = s.velocity[a];
    shown_[2].components[0][i] = s.specific_energy;
    shown_[3].components[0][i] = s.velocity.norm() / s.sound_speed;
  });
  channel.fields.push_back({"density", "kg/m^3", {now_[0]}});
  for (const OwnedField& field : shown_) channel.fields.push_back(field.view());
  return {channel};
}

template std::optional<CellState<2>> Grid<2>::at(const Vec<2>&) const;
template std::optional<CellState<3>> Grid<3>::at(const Vec<3>&) const;
template CellState<2> Grid<2>::ambient() const;
template CellState<3> Grid<3>::ambient() const;
template std::optional<double> Grid<2>::pressure_at(const Vec<2>&) const;
template std::optional<double> Grid<3>::pressure_at(const Vec<3>&) const;
template std::optional<BlastFront> Grid<2>::blast() const;
template std::optional<BlastFront> Grid<3>::blast() const;
template Quantities Grid<2>::quantities_of_cells() const;
template Quantities Grid<3>::quantities_of_cells() const;
template Quantities Grid<2>::quantities() const;
template Quantities Grid<3>::quantities() const;
template std::vector<Channel> Grid<2>::channels(const Asked&) const;
template std::vector<Channel> Grid<3>::channels(const Asked&) const;

}  // namespace ejecta
