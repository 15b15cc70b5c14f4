#include "grid/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "grid/copy_cells.hpp"
#include "grid/grid_fill.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

constexpr int most_halvings = 12, most_repairs = 6;
/// Where states jump at the start waves are faster than anything there is: the first step is short, and steps grow.
constexpr double first_share = 0.05, growth = 1.3;

}  // namespace

template <int Dim>
Grid<Dim>::Grid(const Scene& scene, const std::vector<Material>& materials, const std::optional<RadialState>& start)
    : scene_(scene),
      material_(grid_material(scene, materials)),
      settings_(grid_settings(scene)),
      box_(box_of<Dim>(scene, start ? start->radius() : 0)),
      now_(fill_cells<Dim>(scene, materials, box_, start ? &*start : nullptr)),
      ambient_(ambient_of<Dim>(scene, materials)) {
  for (int k = 0; k < max_threads(); ++k) sweeps_.push_back(make_tile_sweep<Dim>(material_.eos, settings_));
  if (start) clock.time = start->time;
  cut_tiles();
  initial = conserved();
  for (std::size_t i = 0; i < box_.size(); ++i) {
    const CellState<Dim> s = state(i);
    const double speed = s.velocity.norm();
    outset_.density = std::max(outset_.density, s.density);
    const double impedance = material_.gas() ? s.density * speed : s.density * std::max(speed, s.sound_speed);
    outset_.pressure = std::max({outset_.pressure, s.pressure, impedance * speed});
    outset_.speed = std::max(outset_.speed, speed);
    outset_.mach = std::max(outset_.mach, speed / s.sound_speed);
  }
}

/// Tiles anew, with what they hold.
template <int Dim>
void Grid<Dim>::cut_tiles() {
  next_ = now_;
  tiles_.clear();
  constexpr auto shape = tile_shape<Dim>();
  for (std::size_t a = 0; a < Dim; ++a) tile_counts_[a] = (box_.cells[a] + shape[a] - 1) / shape[a];
  std::size_t all = 1;
  for (const int n : tile_counts_) all *= static_cast<std::size_t>(n);
  tiles_.resize(all);
  parallel_blocks(all, 1, [&](std::size_t t, std::size_t) {
    TileState& state = tiles_[t];
    std::size_t rest = t;
    for (std::size_t a = 0; a < Dim; ++a) {
      const auto n = static_cast<std::size_t>(tile_counts_[a]);
      state.tile.begin[a] = static_cast<int>(rest % n) * shape[a];
      state.tile.count[a] = std::min(shape[a], box_.cells[a] - state.tile.begin[a]);
      rest /= n;
    }
    look(t);
    state.behind = false;
  });
}

/// What a tile is like, if not by a step.
template <int Dim>
void Grid<Dim>::look(std::size_t t) {
  TileState& state = tiles_[t];
  const TileResult<Dim> found = sweeps_[static_cast<std::size_t>(thread_index())]->look(box_, state.tile, now_);
  if (!found.bad.empty())
    throw SimulationError(fmt::format("{}: density or energy is not positive", describe(found.bad[0])));
  state.uniform = found.uniform;
  state.fastest = found.fastest;
  state.where = found.where;
}

template <int Dim>
void Grid<Dim>::put(const std::vector<std::size_t>& cells, const std::vector<std::array<double, Dim + 2>>& values) {
  std::vector<char> touched(tiles_.size(), 0);
  constexpr auto shape = tile_shape<Dim>();
  for (std::size_t k = 0; k < cells.size(); ++k) {
    for (std::size_t c = 0; c < values[k].size(); ++c) now_[c][cells[k]] = values[k][c];
    const std::array<int, Dim> cell = box_.cell(cells[k]);
    std::size_t t = 0;
    for (std::size_t a = Dim; a-- > 0;)
      t = t * static_cast<std::size_t>(tile_counts_[a]) + static_cast<std::size_t>(cell[a] / shape[a]);
    touched[t] = 1;
  }
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    if (!touched[t]) continue;
    look(t);
    tiles_[t].behind = true;
  }
}

template <int Dim>
Vote Grid<Dim>::vote() {
  Vote vote{.reason = "crossing of a cell"};
  double fastest = 0;
  for (const TileState& t : tiles_)
    if (t.fastest > fastest) {
      fastest = t.fastest;
      vote.culprit = t.where;
    }
  vote.dt = settings_.courant_in(Dim) * box_.spacing / fastest;
  const double most = free_step_ > 0 ? growth * free_step_ : first_share * vote.dt;
  if (most < vote.dt) {
    vote.dt = most;
    vote.reason = "growth of the step";
  }
  return vote;
}

template <int Dim>
std::array<double, Dim + 2> Grid<Dim>::cell(std::size_t i) const {
  std::array<double, Dim + 2> u;
  for (std::size_t c = 0; c < u.size(); ++c) u[c] = now_[c][i];
  return u;
}

template <int Dim>
bool Grid<Dim>::is_quiet(std::size_t t) const {
  const TileState& tile = tiles_[t];
  if (!tile.uniform) return false;
  const auto state = cell(box_.index(tile.tile.begin));
  std::array<int, Dim> place{};
  for (std::size_t a = 0, rest = t; a < Dim; ++a) {
    const auto n = static_cast<std::size_t>(tile_counts_[a]);
    place[a] = static_cast<int>(rest % n);
    rest /= n;
    const bool at_lower = place[a] == 0, at_upper = place[a] + 1 == tile_counts_[a];
    // Gas that moves towards its mirror image does not stay as it is.
    if (state[1 + a] != 0 && ((at_lower && mirrors(box_.lower[a])) || (at_upper && mirrors(box_.upper[a]))))
      return false;
  }
  constexpr int neighbours = Dim == 2 ? 9 : 27;
  for (int n = 0; n < neighbours; ++n) {
    std::size_t other = 0;
    bool there = true;
    for (int a = Dim - 1; a >= 0; --a) {
      const auto i = static_cast<std::size_t>(a);
      const int offset = (a == 0 ? n : a == 1 ? n / 3 : n / 9) % 3 - 1, count = tile_counts_[i];
      int p = place[i] + offset;
      if (p < 0 || p >= count) {
        there = there && box_.lower[i] == BoundaryKind::periodic;
        p = (p + count) % count;
      }
      other = other * static_cast<std::size_t>(count) + static_cast<std::size_t>(p);
    }
    if (there && (!tiles_[other].uniform || cell(box_.index(tiles_[other].tile.begin)) != state)) return false;
  }
  return true;
}

template <int Dim>
void Grid<Dim>::sweep_tiles(const std::vector<std::size_t>& tiles, double dt, std::span<const std::uint8_t> flagged,
                            std::vector<std::size_t>& bad) {
  std::vector<std::vector<std::size_t>> found(tiles.size());
  parallel_blocks(tiles.size(), 1, [&](std::size_t k, std::size_t) {
    TileState& state = tiles_[tiles[k]];
    TileResult<Dim> result =
        sweeps_[static_cast<std::size_t>(thread_index())]->sweep(box_, state.tile, dt, now_, next_, flagged);
    found[k] = std::move(result.bad);
    state.uniform = result.uniform;
    state.fastest = result.fastest;
    state.where = result.where;
    state.outflow = result.outflow;
  });
  for (const auto& list : found) bad.insert(bad.end(), list.begin(), list.end());
}

/// Tiles whose cells share a face with one of these cells, or hold it.
template <int Dim>
std::vector<std::size_t> Grid<Dim>::around(const std::vector<std::size_t>& cells) const {
  std::vector<std::size_t> tiles;
  constexpr auto shape = tile_shape<Dim>();
  const auto add = [&](const std::array<int, Dim>& cell) {
    std::size_t t = 0;
    for (int a = Dim - 1; a >= 0; --a) {
      const auto i = static_cast<std::size_t>(a);
      t = t * static_cast<std::size_t>(tile_counts_[i]) + static_cast<std::size_t>(cell[i] / shape[i]);
    }
    tiles.push_back(t);
  };
  for (const std::size_t i : cells) {
    const std::array<int, Dim> middle = box_.cell(i);
    add(middle);
    for (std::size_t a = 0; a < Dim; ++a)
      for (const int side : {-1, 1}) {
        std::array<int, Dim> cell = middle;
        cell[a] = source_along(box_, a, middle[a] + side).cell;
        add(cell);
      }
  }
  std::ranges::sort(tiles);
  tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
  return tiles;
}

/// False if no step of this length keeps density and energy positive. Cells that would lose them pass fluxes of first
/// order, limited after the fact [Clain, Diot & Loubere 2011]: what both sides of a face are told stays the same.
template <int Dim>
bool Grid<Dim>::try_step(double dt) {
  std::vector<std::size_t> active, bad;
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    if (!skips_quiet_ || !is_quiet(t)) {
      active.push_back(t);
      continue;
    }
    TileState& state = tiles_[t];
    if (state.behind) copy_cells<Dim>(box_, now_, state.tile.begin, state.tile.count, box_, next_, {});
    state.behind = false;
    state.outflow = uniform_outflow(state, dt);
  }
  // A step that is given up must leave no trace in what decides about the next one.
  std::vector<TileState> before;
  for (const std::size_t t : active) before.push_back(tiles_[t]);
  sweep_tiles(active, dt, {}, bad);
  if (!bad.empty()) {
    std::vector<std::uint8_t> flagged(box_.size(), 0);
    std::vector<std::size_t> repaired;
    for (int k = 0; k < most_repairs && !bad.empty(); ++k) {
      for (const std::size_t i : bad)
        if (!flagged[i]) {
          flagged[i] = 1;
          repaired.push_back(i);
        }
      bad.clear();
      sweep_tiles(around(repaired), dt, flagged, bad);
    }
    if (!bad.empty()) {
      for (std::size_t k = 0; k < active.size(); ++k) tiles_[active[k]] = before[k];
      return false;
    }
    first_order_ += static_cast<double>(repaired.size());
  }
  for (const std::size_t t : active) {
    tiles_[t].behind = true;
    double cells = 1;
    for (const int n : tiles_[t].tile.count) cells *= n;
    cell_steps_ += cells;
  }
  return true;
}

template <int Dim>
std::array<double, Dim + 2> Grid<Dim>::uniform_outflow(const TileState& state, double dt) const {
  const Tile<Dim>& tile = state.tile;
  std::array<double, Dim + 2> out{};
  for (std::size_t a = 0; a < Dim; ++a) {
    if (box_.lower[a] == BoundaryKind::periodic) continue;
    const int sides = (tile.begin[a] + tile.count[a] == box_.cells[a] ? 1 : 0) - (tile.begin[a] == 0 ? 1 : 0);
    if (sides == 0) continue;
    double faces = sides * dt * box_.face_area();
    for (std::size_t b = 0; b < Dim; ++b)
      if (b != a) faces *= tile.count[b];
    const CellState<Dim> s = this->state(box_.index(tile.begin));
    const double u = s.velocity[static_cast<int>(a)];
    out[0] += faces * s.density * u;
    for (int b = 0; b < Dim; ++b) out[static_cast<std::size_t>(1 + b)] += faces * s.density * u * s.velocity[b];
    out[1 + a] += faces * s.pressure;
    out[Dim + 1] += faces * u * (s.density * (s.specific_energy + 0.5 * s.velocity.squaredNorm()) + s.pressure);
  }
  return out;
}

template <int Dim>
void Grid<Dim>::step(double dt, int halvings) {
  if (try_step(dt)) {
    std::swap(now_, next_);
    for (const TileState& t : tiles_) {
      external.mass -= t.outflow[0];
      for (int a = 0; a < Dim; ++a) external.impulse[a] -= t.outflow[static_cast<std::size_t>(1 + a)];
      external.work -= t.outflow[Dim + 1];
    }
    return;
  }
  if (halvings == 0)
    throw SimulationError(
        fmt::format("time {:.6g} s, step {}: density or energy does not stay positive on the grid, "
                    "whatever the step, down to {:.3g} s",
                    clock.time, clock.step, dt));
  step(0.5 * dt, halvings - 1);
  step(0.5 * dt, halvings - 1);
}

template <int Dim>
void Grid<Dim>::advance(double dt) {
  free_step_ = vote().dt;
  timers.time("grid", [&] {
    make_room();
    step(dt, most_halvings);
  });
  clock = {clock.time + dt, dt, clock.step + 1};
}

template <int Dim>
Totals Grid<Dim>::conserved() const {
  Totals sum = parallel_sum<Totals>(box_.size(), [&](std::size_t i) {
    Totals t;
    const auto u = cell(i);
    const double volume = box_.cell_volume();
    t.mass = u[0] * volume;
    const Vec<Dim> x = box_.centre(box_.cell(i));
    double squares = 0;
    for (int a = 0; a < Dim; ++a) {
      const double momentum = u[static_cast<std::size_t>(1 + a)];
      t.mass_moment[a] = t.mass * x[a];
      t.momentum[a] = momentum * volume;
      squares += momentum * momentum;
    }
    t.momentum_scale = std::sqrt(squares) * volume;
    t.kinetic = 0.5 * squares / u[0] * volume;
    t.internal = u[Dim + 1] * volume - t.kinetic;
    return t;
  });
  return sum;
}

template <int Dim>
void Grid<Dim>::persist(Archive& archive) {
  for (std::size_t a = 0; a < Dim; ++a) {
    std::int64_t cells = box_.cells[a];
    archive.integer(fmt::format("cells_{}", "xyz"[a]), cells);
    archive.number(fmt::format("corner_{}", "xyz"[a]), box_.corner[static_cast<int>(a)]);
    box_.cells[a] = static_cast<int>(cells);
  }
  archive.number("free_step", free_step_);
  archive.number("cell_steps", cell_steps_);
  archive.number("first_order_cells", first_order_);
  const std::size_t size = archive.size(box_.size());
  for (auto& column : now_) column.resize(size);
  archive.column("density", "kg/m^3", now_[0]);
  for (std::size_t a = 0; a < Dim; ++a) archive.column(fmt::format("momentum_{}", "xyz"[a]), "kg/(m^2 s)", now_[1 + a]);
  archive.column("energy", "J/m^3", now_[Dim + 1]);
  if (archive.reads()) cut_tiles();
}

template <int Dim>
std::string Grid<Dim>::describe(std::size_t i) const {
  const Vec<Dim> x = box_.centre(box_.cell(i));
  return fmt::format("cell {} at ({:.6g}) m", i, fmt::join(x.begin(), x.end(), ", "));
}

template <int Dim>
Whereabouts Grid<Dim>::whereabouts(std::size_t i) const {
  const Vec<Dim> x = box_.centre(box_.cell(i));
  Whereabouts where{"", {}, Dim};
  std::ranges::copy(x, where.x.begin());
  return where;
}

template <int Dim>
std::size_t Grid<Dim>::bytes() const {
  std::size_t sum = tiles_.capacity() * sizeof(TileState);
  for (const auto* cells : {&now_, &next_})
    for (const auto& column : *cells) sum += column.capacity() * sizeof(double);
  for (const auto& sweep : sweeps_) sum += sweep->bytes();
  return sum;
}

template <int Dim>
std::string Grid<Dim>::outline() const {
  std::string text = "grid\n";
  text +=
      fmt::format("  cells              {} of {}\n", fmt::join(box_.cells, " x "), format_quantity(box_.spacing, "m"));
  text += fmt::format("  fluid              {}\n", material_.name);
  text += fmt::format("  columns            density, momentum, energy, twice: {} bytes a cell\n", 2 * (Dim + 2) * 8);
  text +=
      fmt::format("  tiles              {} of at most {} cells\n", tiles_.size(), fmt::join(tile_shape<Dim>(), " x "));
  return text;
}

template <int Dim>
std::vector<Remark> Grid<Dim>::remarks() const {
  if (first_order_ == 0) return {};
  return {
      {fmt::format("grid: {:.0f} times a cell passed fluxes of first order, to stay positive", first_order_), false}};
}

template class Grid<2>;
template class Grid<3>;

}  // namespace ejecta
