#include "reference/radial_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <type_traits>

#include "base/errors.hpp"
#include "base/simd.hpp"

namespace ejecta {

namespace {

constexpr double courant = 0.45;
/// Of the first step, and growth from step to step: what begins as a jump needs some steps to become a wave.
constexpr double first_step = 0.1, growth = 1.1;
/// A quiet end grows when something has come within this many cells of it: as far as a step reaches, and as much again.
constexpr std::size_t quiet_margin = 8, quiet_growth = 64;
/// Relative change of density or pressure that counts as something. Less is far ahead of any wave.
constexpr double quiet_noise = 1e-10;

/// Cells or faces that are computed side by side: those of a register for the ideal gas, one of any other matter.
template <class EosT>
using Lanes = std::conditional_t<std::is_same_v<EosT, IdealGas>, simd::Doubles, double>;
template <class V>
constexpr std::size_t width = sizeof(V) / sizeof(double);

template <class V>
inline V load(const double* from) {
  V values;
  std::memcpy(&values, from, sizeof(V));
  return values;
}
template <class V>
inline void store(double* to, V values) {
  std::memcpy(to, &values, sizeof(V));
}

/// The central slope, but no more than twice either one-sided slope, and none at an extremum; times half the spacing.
template <class V>
inline V half_limited(V left, V right) {
  const V central = 0.25 * (left + right), most = simd::min(simd::magnitude(left), simd::magnitude(right));
  return left * right > 0 ? simd::max(V(-most), simd::min(central, most)) : V{};
}

/// The matter beside a face, SI.
template <class V>
struct FaceState {
  V density, velocity, pressure, sound, internal;
};
/// The last argument is what is reconstructed beside density and velocity: the pressure of an ideal gas, else the
/// specific energy, from which pressure and sound follow anew.
template <class V>
inline FaceState<V> face_state(const IdealGas& gas, V rho, V u, V p) {
  return {rho, u, p, simd::square_root(V(gas.gamma * p / rho)), p / ((gas.gamma - 1) * rho)};
}
template <class EosT>
FaceState<double> face_state(const EosT& eos, double rho, double u, double e) {
  const EosPoint point = eos.evaluate(rho, e);
  return {rho, u, point.pressure, sound_speed(point, rho, eos.sound_speed_floor()), e};
}

template <class V>
struct Flux {
  V mass, momentum, energy;
};

/// All of it is computed for either side and then chosen: lanes cannot branch. Amid matter at rest it gives the
/// pressure and nothing else, to the last bit.
template <class V>
inline Flux<V> hllc(const FaceState<V>& l, const FaceState<V>& r) {
  const V root_l = simd::square_root(l.density), root_r = simd::square_root(r.density), share = 1 / (root_l + root_r);
  const V mean_u = (root_l * l.velocity + root_r * r.velocity) * share, jump = r.velocity - l.velocity;
  const V mean_c = simd::square_root(V((root_l * l.sound * l.sound + root_r * r.sound * r.sound) * share +
                                       0.5 * root_l * root_r * share * share * jump * jump));
  // Wave speeds relative to the matter that they run into. Cold matter has none, but a contact needs some.
  const V least = 1e-12 * (simd::magnitude(l.velocity) + simd::magnitude(r.velocity)) + 1e-100;
  const V a_l = simd::max(simd::max(l.sound, V(l.velocity - mean_u + mean_c)), least);
  const V a_r = simd::max(simd::max(r.sound, V(mean_u - r.velocity + mean_c)), least);
  const V m_l = l.density * a_l, m_r = r.density * a_r;
  const V contact = (m_l * l.velocity + m_r * r.velocity + l.pressure - r.pressure) / (m_l + m_r);
  // From here on the side that the face lies in, seen with its wave running to the left.
  const auto left = contact >= 0;
  const V sign = left ? V(V{} + 1) : V(V{} - 1);
  const V rho = left ? l.density : r.density, u = sign * (left ? l.velocity : r.velocity), a = left ? a_l : a_r;
  const V p = left ? l.pressure : r.pressure, e = left ? l.internal : r.internal;
  const V star = sign * contact, total = rho * (e + 0.5 * u * u);
  const V wave = u - a, ratio = a / (star - wave), back = simd::min(wave, V{});
  const V total_behind = ratio * (total + rho * (star - u) * (star - p / (rho * a)));
  const V mass = rho * (u + back * (ratio - 1));
  const V momentum = rho * u * u + p + back * rho * (ratio * star - u);
  const V energy = (total + p) * u + back * (total_behind - total);
  return {sign * mass, momentum, sign * energy};
}

}  // namespace

double all_directions(Geometry geometry) {
  if (geometry == Geometry::planar) return 1;
  return (geometry == Geometry::cylindrical ? 2 : 4) * std::numbers::pi;
}

double shell_volume(Geometry geometry, double inner, double outer) {
  // As products with the thickness: differences of powers lose the digits of thin shells.
  const double thickness = outer - inner;
  if (geometry == Geometry::planar) return thickness;
  if (geometry == Geometry::cylindrical) return 0.5 * thickness * (inner + outer);
  return thickness * (inner * inner + inner * outer + outer * outer) / 3;
}

RadialFlow::RadialFlow(const Eos& eos, const RadialGrid& grid, const std::vector<RadialCell>& cells)
    : eos_(eos), grid_(grid), quiet_(cells.back()) {
  assert(cells.size() >= 4);
  quiet_.momentum = 0;
  resize(cells.size());
  for (std::size_t i = 0; i < cells_; ++i) {
    density_[ghosts + i] = cells[i].density;
    momentum_[ghosts + i] = cells[i].momentum;
    energy_[ghosts + i] = cells[i].energy;
  }
  initial_ = sum();
  find_states();
  grow();
}

/// Cells that come at the upper end are those of the quiet end.
void RadialFlow::resize(std::size_t cells) {
  // Whole registers may reach beyond the last cell or face.
  const std::size_t before = cells_, columns = cells + 2 * ghosts + width<simd::Doubles>;
  cells_ = cells;
  for (std::vector<double>* column :
       {&center_, &volume_, &density_, &momentum_, &energy_, &old_density_, &old_momentum_, &old_energy_, &velocity_,
        &internal_, &pressure_, &sound_, &density_change_, &velocity_change_, &third_change_})
    column->resize(columns);
  for (std::vector<double>* column : {&area_, &flux_.mass, &flux_.momentum, &flux_.energy}) column->resize(columns);
  const auto face = [&](std::size_t i) { return grid_.start + static_cast<double>(i) * grid_.spacing; };
  const auto area = [&](double r) {
    return grid_.geometry == Geometry::planar ? 1 : grid_.geometry == Geometry::cylindrical ? r : r * r;
  };
  area_[before] = area(face(before));
  for (std::size_t i = before; i < cells; ++i) {
    area_[i + 1] = area(face(i + 1));
    volume_[ghosts + i] = shell_volume(grid_.geometry, face(i), face(i + 1));
    center_[ghosts + i] = 0.5 * (face(i) + face(i + 1));
    density_[ghosts + i] = quiet_.density;
    momentum_[ghosts + i] = 0;
    energy_[ghosts + i] = quiet_.energy;
  }
}

void RadialFlow::grow() {
  if (grid_.upper != RadialEdge::quiet) return;
  const double rho = quiet_.density, rho_e = quiet_.energy;
  const auto moved = [&](std::size_t i) {
    return std::abs(density_[i] - rho) > quiet_noise * rho ||
           std::abs(energy_[i] - rho_e) > quiet_noise * std::abs(rho_e);
  };
  const std::size_t end = ghosts + cells_, margin = std::min(quiet_margin, cells_);
  bool near = false;
  for (std::size_t i = end - margin; i < end; ++i) near = near || moved(i);
  if (!near) return;
  resize(cells_ + quiet_growth);
  find_states();
}

void RadialFlow::find_states() {
  std::visit([this](const auto& eos) { find_states(eos); }, eos_);
}

template <class EosT>
void RadialFlow::find_states(const EosT& eos) {
  using V = Lanes<EosT>;
  for (std::size_t i = ghosts; i < ghosts + cells_; i += width<V>) {
    const V rho = load<V>(&density_[i]), u = load<V>(&momentum_[i]) / rho;
    V e = load<V>(&energy_[i]) / rho - 0.5 * u * u, p, c;
    if constexpr (std::is_same_v<EosT, IdealGas>) {
      // Where nearly all of the energy is motion, rounding decides on the sign of the rest.
      e = simd::max(e, V(1e-14 * u * u));
      p = (eos.gamma - 1) * rho * e;
      c = simd::square_root(V(eos.gamma * (eos.gamma - 1) * e));
    } else {
      const EosPoint point = eos.evaluate(rho, e);
      p = point.pressure;
      c = sound_speed(point, rho, eos.sound_speed_floor());
    }
    store(&velocity_[i], u);
    store(&internal_[i], e);
    store(&pressure_[i], p);
    store(&sound_[i], c);
  }
}

void RadialFlow::fill_ghosts(std::vector<double>& column, double sign) const {
  const std::size_t end = ghosts + cells_;
  for (std::size_t k = 0; k < ghosts; ++k) {
    double& below = column[ghosts - 1 - k];
    double& above = column[end + k];
    switch (grid_.lower) {
      case RadialEdge::mirror:
        below = sign * column[ghosts + k];
        break;
      case RadialEdge::periodic:
        below = column[end - 1 - k];
        break;
      default:
        below = column[ghosts];
    }
    switch (grid_.upper) {
      case RadialEdge::mirror:
        above = sign * column[end - 1 - k];
        break;
      case RadialEdge::periodic:
        above = column[ghosts + k];
        break;
      default:
        above = column[end - 1];
    }
  }
}

template <class EosT>
void RadialFlow::find_fluxes(const EosT& eos) {
  std::vector<double>& thirds = std::is_same_v<EosT, IdealGas> ? pressure_ : internal_;
  fill_ghosts(density_, 1);
  fill_ghosts(velocity_, -1);
  fill_ghosts(thirds, 1);
  using V = Lanes<EosT>;
  for (std::size_t i = ghosts - 1; i <= ghosts + cells_; i += width<V>) {
    const auto limit = [i](const std::vector<double>& column, std::vector<double>& change) {
      const V middle = load<V>(&column[i]);
      store(&change[i], half_limited<V>(middle - load<V>(&column[i - 1]), load<V>(&column[i + 1]) - middle));
    };
    limit(density_, density_change_);
    limit(velocity_, velocity_change_);
    limit(thirds, third_change_);
  }
  for (std::size_t f = 0; f <= cells_; f += width<V>) {
    const std::size_t l = ghosts - 1 + f, r = ghosts + f;
    const auto below = [l](const std::vector<double>& column, const std::vector<double>& change) {
      return V(load<V>(&column[l]) + load<V>(&change[l]));
    };
    const auto above = [r](const std::vector<double>& column, const std::vector<double>& change) {
      return V(load<V>(&column[r]) - load<V>(&change[r]));
    };
    const auto side = [&](const auto& at) {
      return face_state(eos, at(density_, density_change_), at(velocity_, velocity_change_), at(thirds, third_change_));
    };
    const Flux<V> flux = hllc<V>(side(below), side(above));
    store(&flux_.mass[f], flux.mass);
    store(&flux_.momentum[f], flux.momentum);
    store(&flux_.energy[f], flux.energy);
  }
  close_ends();
}

/// Nothing passes a mirror or the end of quiet matter, not even round-off.
void RadialFlow::close_ends() {
  const auto close = [&](std::size_t face) { flux_.mass[face] = flux_.energy[face] = 0; };
  if (grid_.lower == RadialEdge::mirror) close(0);
  if (grid_.upper == RadialEdge::mirror) close(cells_);
  if (grid_.upper == RadialEdge::quiet) {
    close(cells_);
    flux_.momentum[cells_] = pressure_[ghosts + cells_ - 1];
  }
}

void RadialFlow::add_fluxes(double dt) {
  using V = simd::Doubles;
  for (std::size_t f = 0; f < cells_; f += width<V>) {
    const std::size_t i = ghosts + f;
    const V share = dt / load<V>(&volume_[i]), p = load<V>(&pressure_[i]);
    const V below = share * load<V>(&area_[f]), above = share * load<V>(&area_[f + 1]);
    const auto add = [&](std::vector<double>& column, const std::vector<double>& flux, V less) {
      store(&column[i],
            V(load<V>(&column[i]) + below * (load<V>(&flux[f]) - less) - above * (load<V>(&flux[f + 1]) - less)));
    };
    add(density_, flux_.mass, V{});
    add(momentum_, flux_.momentum, p);
    add(energy_, flux_.energy, V{});
  }
  // Half of either stage counts (`step`).
  inflow_.mass += 0.5 * dt * (area_[0] * flux_.mass[0] - area_[cells_] * flux_.mass[cells_]);
  inflow_.energy += 0.5 * dt * (area_[0] * flux_.energy[0] - area_[cells_] * flux_.energy[cells_]);
}

double RadialFlow::longest_step() const {
  using V = simd::Doubles;
  V lanes{};
  std::size_t i = ghosts;
  const std::size_t end = ghosts + cells_;
  for (; i + width<V> <= end; i += width<V>)
    lanes = simd::max(lanes, V(simd::magnitude(load<V>(&velocity_[i])) + load<V>(&sound_[i])));
  double fastest = 0;
  for (std::size_t k = 0; k < width<V>; ++k) fastest = std::max(fastest, lanes[k]);
  for (; i < end; ++i) fastest = std::max(fastest, std::abs(velocity_[i]) + sound_[i]);
  return courant * grid_.spacing / fastest;
}

void RadialFlow::check() const {
  const auto wrong = [&](std::size_t i) {
    const double most = std::numeric_limits<double>::max();
    return !(density_[i] > 0) | !(density_[i] <= most) | !(std::abs(energy_[i]) <= most) | !(sound_[i] <= most);
  };
  int found = 0;  // without an early end, so that several cells are looked at at once
  for (std::size_t i = ghosts; i < ghosts + cells_; ++i) found |= wrong(i);
  if (!found) return;
  std::size_t i = ghosts;
  while (!wrong(i)) ++i;
  throw SimulationError(fmt::format(
      "one-dimensional reference: step {}, {} s, at {} m: density {} kg/m^3, energy {} J/m^3, sound speed {} m/s",
      steps_, time_, center_[i], density_[i], energy_[i], sound_[i]));
}

void RadialFlow::step(double dt) {
  old_density_ = density_;
  old_momentum_ = momentum_;
  old_energy_ = energy_;
  const auto go_on = [&] {
    std::visit([this](const auto& eos) { find_fluxes(eos); }, eos_);
    add_fluxes(dt);
  };
  go_on();
  find_states();
  go_on();
  for (std::size_t i = ghosts; i < ghosts + cells_; ++i) {
    density_[i] = 0.5 * (density_[i] + old_density_[i]);
    momentum_[i] = 0.5 * (momentum_[i] + old_momentum_[i]);
    energy_[i] = 0.5 * (energy_[i] + old_energy_[i]);
  }
  find_states();
  ++steps_;
  cell_steps_ += static_cast<std::int64_t>(cells_);
}

void RadialFlow::advance_to(double time) {
  while (time_ < time) {
    check();
    const double longest = longest_step();
    const double dt = std::min(longest, steps_ == 0 ? first_step * longest : growth * last_step_);
    last_step_ = dt;
    const double left = time - time_;
    if (dt >= left) {
      step(left);
      time_ = time;
    } else {
      // What is left after the last whole step is no splinter.
      const double taken = 2 * dt > left ? 0.5 * left : dt;
      step(taken);
      time_ += taken;
    }
    grow();
  }
}

RadialFlow::Totals RadialFlow::sum() const {
  Totals totals;
  const bool quiet = grid_.upper == RadialEdge::quiet;
  long double mass = 0, energy = 0;
  for (std::size_t i = ghosts; i < ghosts + cells_; ++i) {
    const long double v = volume_[i];
    mass += v * (static_cast<long double>(density_[i]) - (quiet ? quiet_.density : 0));
    energy += v * (static_cast<long double>(energy_[i]) - (quiet ? quiet_.energy : 0));
  }
  totals.mass = static_cast<double>(mass);
  totals.energy = static_cast<double>(energy);
  return totals;
}

RadialFlow::Errors RadialFlow::errors() const {
  const Totals now = sum();
  long double mass = 0, energy = 0;  // all that there is
  for (std::size_t i = ghosts; i < ghosts + cells_; ++i) {
    mass += static_cast<long double>(volume_[i]) * density_[i];
    energy += static_cast<long double>(volume_[i]) * std::abs(energy_[i]);
  }
  const auto error = [](double change, long double scale) {
    return scale > 0 ? change / static_cast<double>(scale) : change;
  };
  return {error(now.mass - initial_.mass - inflow_.mass, mass),
          error(now.energy - initial_.energy - inflow_.energy, energy)};
}

}  // namespace ejecta
