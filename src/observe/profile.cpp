#include "observe/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "observe/solvers.hpp"
#include "output/atomic_file.hpp"

namespace ejecta {

namespace {

constexpr double slender = 5;
constexpr std::size_t most_slabs = 300;

/// Means over slabs of equal thickness.
class Slabs {
 public:
  Slabs(double low, double high, double thinnest)
      : low_(low),
        width_(std::max(thinnest, (high - low) / static_cast<double>(most_slabs))),
        sums_(static_cast<std::size_t>((high - low) / width_) + 1) {}

  void add(double x, double weight, const std::array<double, 3>& values) {
    Sums& slab = sums_[std::min(static_cast<std::size_t>((x - low_) / width_), sums_.size() - 1)];
    slab.weight += weight;
    slab.moment += weight * x;
    for (std::size_t k = 0; k < values.size(); ++k) slab.values[k] += weight * values[k];
  }

  /// Slabs with nothing in them are left out.
  MonitorProfile means(char axis) const {
    MonitorProfile profile{std::string(1, axis), {}, {}};
    profile.fields = {{"density", "kg/m^3", {}}, {std::string("velocity ") + axis, "m/s", {}}, {"pressure", "Pa", {}}};
    for (const auto& [weight, moment, values] : sums_) {
      if (!(weight > 0)) continue;
      profile.place.push_back(moment / weight);
      for (std::size_t k = 0; k < values.size(); ++k) profile.fields[k].values.push_back(values[k] / weight);
    }
    return profile;
  }

 private:
  struct Sums {
    double weight = 0, moment = 0;  ///< moment: weight times place
    std::array<double, 3> values{};
  };
  double low_, width_;
  std::vector<Sums> sums_;
};

template <int Dim>
MonitorProfile profile_of_row(const Grid<Dim>& grid, const Scene& scene) {
  const Box<Dim>& box = grid.box();
  Slabs slabs(box.corner[0], box.corner[0] + box.cells[0] * box.spacing, box.spacing);
  for (const std::size_t i : row_of_cells(grid, scene)) {
    const CellState<Dim> s = grid.state(i);
    slabs.add(box.centre(box.cell(i))[0], 1, {s.density, s.velocity[0], s.pressure});
  }
  return slabs.means('x');
}

template <int Dim>
MonitorProfile profile_of_strip(const Sph<Dim>& sph) {
  const Particles<Dim>& p = sph.particles;
  std::array<double, Dim> low, length;
  for (int a = 0; a < Dim; ++a) {
    const auto [least, most] = std::ranges::minmax(p.column(Field::position, a));
    low[static_cast<std::size_t>(a)] = least;
    length[static_cast<std::size_t>(a)] = most - least;
  }
  const auto longest = static_cast<int>(std::ranges::max_element(length) - length.begin());
  auto others = length;
  others[static_cast<std::size_t>(longest)] = 0;
  const double all = length[static_cast<std::size_t>(longest)], first = low[static_cast<std::size_t>(longest)];
  if (!(all > slender * std::ranges::max(others))) return {};
  const auto x = p.column(Field::position, longest), v = p.column(Field::velocity, longest);
  const auto mass = p.column(Field::mass), density = p.column(Field::density), pressure = p.column(Field::pressure);
  Slabs slabs(first, first + all, sph.scene.spacing);
  for (std::size_t i = 0; i < p.size(); ++i) slabs.add(x[i], mass[i], {density[i], v[i], pressure[i]});
  return slabs.means("xyz"[longest]);
}

}  // namespace

template <int Dim>
std::vector<std::size_t> row_of_cells(const Grid<Dim>& grid, const Scene& scene) {
  const Box<Dim>& box = grid.box();
  std::array<int, Dim> cell{};
  for (std::size_t a = 1; a < Dim; ++a) {
    const double charge =
        scene.charge ? (scene.charge->center[a] - box.corner[static_cast<int>(a)]) / box.spacing : 0.5 * box.cells[a];
    cell[a] = std::clamp(static_cast<int>(std::floor(charge)), 0, box.cells[a] - 1);
  }
  std::vector<std::size_t> row;
  for (cell[0] = 0; cell[0] < box.cells[0]; ++cell[0]) row.push_back(box.index(cell));
  return row;
}

template std::vector<std::size_t> row_of_cells(const Grid<2>&, const Scene&);
template std::vector<std::size_t> row_of_cells(const Grid<3>&, const Scene&);

void write_profile(const std::filesystem::path& file, const MonitorProfile& profile) {
  std::string text = profile.axis + " [m]";
  for (const MonitorProfile::Field& field : profile.fields) text += fmt::format(",{} [{}]", field.name, field.unit);
  for (std::size_t k = 0; k < profile.place.size(); ++k) {
    text += fmt::format("\n{}", profile.place[k]);
    for (const MonitorProfile::Field& field : profile.fields) text += fmt::format(",{}", field.values[k]);
  }
  write_atomically(file, text + '\n');
}

MonitorProfile profile_of(const Simulation& sim) {
  MonitorProfile profile;
  with_particles(sim, [&](const auto& sph) { profile = profile_of_strip(sph); });
  with_grid(sim, [&](const auto& grid) { profile = profile_of_row(grid, sim.scene); });
  return profile;
}

}  // namespace ejecta
