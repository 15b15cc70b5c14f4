/// Whether the particles make sense, and who they are.
#include <fmt/format.h>

#include <cmath>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "scene/names.hpp"
#include "sph/sph.hpp"

namespace ejecta {

namespace {

/// The first stage that wrote something not finite to the particle, else the integration.
template <int Dim>
std::string origin_of_failure(const Sph<Dim>& sph, std::size_t i) {
  for (const Stage<Dim>& stage : sph.stages)
    for (Field f : stage.writes)
      for (int k = 0; k < components(info(f).shape, Dim); ++k)
        if (!std::isfinite(sph.particles.column(f, k)[i]))
          return fmt::format("stage \"{}\" (field {})", stage.name, info(f).name);
  return sph.clock.step == 0 ? "after set-up" : "after correction";
}

/// Matter stores energy on either side of its state at rest, so none has less than nothing: what has lost more than
/// this share of the energy per mass has done work that nobody did on it.
constexpr double worrying_debt = 0.01;

/// Particles below zero by more than that, in words; empty if there are none.
template <int Dim>
std::string energy_debt(const Sph<Dim>& sph) {
  const auto& p = sph.particles;
  const Totals now = sph.conserved();
  const double mean = now.energy() / now.mass;
  if (!(mean > 0)) return {};
  const auto energy = p.column(Field::specific_energy);
  const auto in_debt = [&](std::size_t i) { return energy[i] < -worrying_debt * mean ? 1.0 : 0.0; };
  const double count = parallel_sum<double>(p.size(), in_debt);
  if (count == 0) return {};
  const IndexedMin least = parallel_min(p.size(), 0.0, [&](std::size_t i) { return energy[i]; });
  return fmt::format("{:.0f} particles have a specific energy below zero, down to {:.2g} times the mean energy: {}",
                     count, least.value / mean, sph.describe(least.index));
}

}  // namespace

template <int Dim>
Whereabouts Sph<Dim>::whereabouts(std::size_t i) const {
  Whereabouts where{scene.bodies[static_cast<std::size_t>(particles.label(Label::body)[i])].name, {}, Dim};
  for (std::size_t a = 0; a < Dim; ++a) where.x[a] = particles.column(Field::position, static_cast<int>(a))[i];
  return where;
}

template <int Dim>
std::vector<Remark> Sph<Dim>::remarks() const {
  std::vector<Remark> list;
  if (unconverged > 0)
    list.push_back({fmt::format("the distension solver {} failed to converge in {} particle-steps",
                                name_of(scene.numerics.distension_solver), unconverged),
                    true});
  if (const std::string debt = energy_debt(*this); !debt.empty()) list.push_back({debt, true});
  if (const ShapeReport& r = shape_report; r.votes > 0) {
    const double percent = 100 / static_cast<double>(r.votes);
    list.push_back({fmt::format(
        "shape of H: {} votes; {:.3g} % had too few neighbours, {:.3g} % changed as much as "
        "allowed, {:.3g} % reached the largest aspect",
        r.votes, percent * static_cast<double>(r.few_neighbours), percent * static_cast<double>(r.limited_change),
        percent * static_cast<double>(r.largest_aspect))});
  }
  return list;
}

template <int Dim>
std::string Sph<Dim>::describe(std::size_t i) const {
  const Particles<Dim>& p = particles;
  auto components = [&](Field f) {
    std::string text;
    for (int a = 0; a < Dim; ++a) text += fmt::format("{}{:.6g}", a ? ", " : "", p.column(f, a)[i]);
    return text;
  };
  return fmt::format(
      "particle {} (body \"{}\", material \"{}\") at ({}) m, velocity ({}) m/s, density {:.6g} kg/m^3, specific energy "
      "{:.6g} J/kg, smoothing length {:.6g} m",
      p.label(Label::id)[i], whereabouts(i).body, materials[static_cast<std::size_t>(p.label(Label::material)[i])].name,
      components(Field::position), components(Field::velocity), p.column(Field::density)[i],
      p.column(Field::specific_energy)[i], p.column(Field::smoothing_length)[i]);
}

template <int Dim>
void Sph<Dim>::check_health() const {
  const Particles<Dim>& p = particles;
  const auto finite = [&](std::size_t i) {
    double sum = p.column(Field::specific_energy)[i] + p.column(Field::density)[i];
    for (int a = 0; a < Dim; ++a)
      sum += p.column(Field::position, a)[i] + p.column(Field::velocity, a)[i] + p.column(Field::acceleration, a)[i];
    return std::isfinite(sum);
  };
  const auto healthy = [&](std::size_t i) {
    return finite(i) && p.column(Field::density)[i] > 0 && std::isfinite(p.vector(Field::velocity, i).squaredNorm());
  };
  const IndexedMin worst = parallel_min(p.size(), 0.5, [&](std::size_t i) { return healthy(i) ? 1.0 : 0.0; });
  if (worst.index == p.size()) return;
  const bool state = !finite(worst.index) || !(p.column(Field::density)[worst.index] > 0);
  throw SimulationError(fmt::format(
      "time {:.6g} s, step {}, {}: {}: {}", clock.time, clock.step, origin_of_failure(*this, worst.index),
      state ? "state not finite or density not positive" : "kinetic energy not finite", describe(worst.index)));
}

template void Sph<2>::check_health() const;
template void Sph<3>::check_health() const;
template std::vector<Remark> Sph<2>::remarks() const;
template std::vector<Remark> Sph<3>::remarks() const;
template std::string Sph<2>::describe(std::size_t) const;
template std::string Sph<3>::describe(std::size_t) const;
template Whereabouts Sph<2>::whereabouts(std::size_t) const;
template Whereabouts Sph<3>::whereabouts(std::size_t) const;

}  // namespace ejecta
