#include "sph/population.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace ejecta {

namespace {

/// Books particle i as added (sign 1) or taken away (-1).
template <int Dim>
void book(Sph<Dim>& sph, std::size_t i, double sign) {
  const Particles<Dim>& p = sph.particles;
  const double mass = sign * p.column(Field::mass)[i];
  Vec<3> x = Vec<3>::Zero(), v = Vec<3>::Zero();
  x.template head<Dim>() = p.vector(Field::position, i);
  v.template head<Dim>() = p.vector(Field::velocity, i);
  ExternalLoad& load = sph.external;
  load.mass += mass;
  load.impulse += mass * v;
  load.angular_impulse += mass * x.cross(v);
  load.work += mass * (0.5 * v.squaredNorm() + p.column(Field::specific_energy)[i]);
}

/// As at the start of a run: forces belong to the particles that are there, and there is no step before.
template <int Dim>
void begin_again(Sph<Dim>& sph) {
  Particles<Dim>& p = sph.particles;
  p.set_material_ranges(ranges_of_materials(p.label(Label::material), sph.materials.size()));
  sph.lists.invalidate();
  sph.clock.dt = 0;  // nothing grows while the stages run
  sph.evaluate();
  sph.check_health();
  for (int a = 0; a < Dim; ++a)
    std::ranges::copy(p.column(Field::acceleration, a), p.previous(Field::acceleration, a).begin());
}

}  // namespace

template <int Dim>
void remove_particles(Sph<Dim>& sph, std::span<const char> doomed) {
  Particles<Dim>& p = sph.particles;
  std::vector<std::uint32_t> order(p.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto first_doomed =
      std::stable_partition(order.begin(), order.end(), [&](std::uint32_t i) { return !doomed[i]; });
  for (auto i = first_doomed; i != order.end(); ++i) book(sph, *i, -1);
  p.reorder(order);
  p.resize(static_cast<std::size_t>(first_doomed - order.begin()));
  begin_again(sph);
}

template <int Dim>
void add_particles(Sph<Dim>& sph, std::span<const std::size_t> originals,
                   const std::function<void(std::size_t)>& place) {
  Particles<Dim>& p = sph.particles;
  const std::size_t n = p.size();
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  for (const std::size_t i : originals) order.push_back(static_cast<std::uint32_t>(i));
  p.resize(order.size());
  p.reorder(order);  // copies where an index comes twice
  std::int32_t id = std::ranges::max(p.label(Label::id));
  for (std::size_t i = n; i < p.size(); ++i) {
    p.label(Label::id)[i] = ++id;
    place(i);
    book(sph, i, 1);
  }
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return p.label(Label::material)[i]; });
  p.reorder(order);
  begin_again(sph);
}

template void remove_particles<2>(Sph<2>&, std::span<const char>);
template void remove_particles<3>(Sph<3>&, std::span<const char>);
template void add_particles<2>(Sph<2>&, std::span<const std::size_t>, const std::function<void(std::size_t)>&);
template void add_particles<3>(Sph<3>&, std::span<const std::size_t>, const std::function<void(std::size_t)>&);

}  // namespace ejecta
