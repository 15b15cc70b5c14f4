#include "sph/sph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.hpp"
#include "model/find_blast.hpp"
#include "schemes/kernels.hpp"
#include "sph/burn.hpp"
#include "sph/diagnostics.hpp"
#include "sph/integrator.hpp"

namespace ejecta {

template <int Dim>
void Sph<Dim>::evaluate() {
  for (const Stage<Dim>& stage : stages) timers.time(stage.name, [&] { stage.run(*this); });
}

template <int Dim>
Vote Sph<Dim>::vote() {
  Vote least;
  timers.time("time step", [&] {
    for (const Criterion<Dim>& criterion : criteria)
      if (const Vote vote = criterion.vote(*this); vote.dt < least.dt) least = vote;
  });
  return least;
}

template <int Dim>
void Sph<Dim>::advance(double dt) {
  timers.time("integration", [&] { predict(particles, dt, clock.dt, scene.numerics.godunov()); });
  clock.dt = dt;
  clock.time += dt;
  ++clock.step;
  const ExternalLoad before = external;
  evaluate();
  timers.time("integration", [&] { correct(particles, dt); });
  add_step(external, before, external, dt);
}

template <int Dim>
Totals Sph<Dim>::conserved() const {
  return totals(particles);
}

template <int Dim>
Kept Sph<Dim>::kept() const {
  return kept_between(scene.boundary);
}

template <int Dim>
bool Sph<Dim>::is_loaded() const {
  return std::ranges::any_of(scene.bodies, &Body::driven);
}

template <int Dim>
Quantities Sph<Dim>::quantities() const {
  const Particles<Dim>& p = particles;
  auto extreme = [&](Field f, double sign) {
    return sign * parallel_min(p.size(), std::numeric_limits<double>::max(), [&](std::size_t i) {
                    return sign * p.column(f)[i];
                  }).value;
  };
  Quantities list{
      {"max pressure", "Pa", highest_pressure(*this), "highest of a particle with neighbours of its piece", true},
      {"min density", "kg/m^3", extreme(Field::density, 1), "lowest of a particle"},
      {"max density", "kg/m^3", extreme(Field::density, -1), "highest of a particle"}};
  if (p.has(Field::distension))
    list.push_back({"min distension", "1", extreme(Field::distension, 1), "of the most crushed particle"});
  if (p.has(Field::damage)) {
    constexpr double damaged = 0.99;
    const auto mass = p.column(Field::mass), damage = p.column(Field::damage);
    const double broken =
        parallel_sum<double>(p.size(), [&](std::size_t i) { return damage[i] > damaged ? mass[i] : 0.0; });
    const double all = parallel_sum<double>(p.size(), [&](std::size_t i) { return mass[i]; });
    list.push_back({"damaged mass fraction", "1", broken / all, "share of the mass with damage above 0.99", true});
  }
  if (p.has(Field::burnt)) std::ranges::move(burn_quantities(*this), std::back_inserter(list));
  if (scene.charge && scene.gas) std::ranges::move(quantities_of(blast()), std::back_inserter(list));
  return list;
}

template <int Dim>
std::vector<Remark> Sph<Dim>::remarks_at_start() const {
  std::vector<Remark> list = particles.has(Field::lighting_time) ? unlit(*this) : std::vector<Remark>{};
  if (scene.fragments.enabled) {
    const std::size_t target = target_body(scene, outset.bodies);
    const Material& material = materials[static_cast<std::size_t>(body_material[target])];
    if (material.solid() && !material.damage && !material.breaks_in_shear() && !material.stretches())
      list.push_back({fmt::format("fragments of {}: {} has no damage: where it comes apart is decided by "
                                  "particles that lose their neighbours, not by cracks",
                                  scene.bodies[target].name, material.name),
                      true});
  }
  return list;
}

template <int Dim>
std::size_t Sph<Dim>::bytes() const {
  std::size_t kept = 0;
  for (const Stage<Dim>& stage : stages) kept += stage.bytes();
  return particles.bytes() + lists.bytes() + pass->bytes() + kept;
}

template <int Dim>
double mean_neighbours(const Sph<Dim>& sph) {
  const double radius = kernel_support(sph.scene.numerics.kernel);
  const auto sum = sph.particles.column(Field::zeroth_moment);
  const double unit_ball = Dim == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;
  return parallel_sum<double>(sum.size(),
                              [&](std::size_t i) {
                                return unit_ball * std::pow(radius * sph.support->effective_nodes_per_h(sum[i]), Dim);
                              }) /
         static_cast<double>(sum.size());
}

template struct Sph<2>;
template struct Sph<3>;
template double mean_neighbours<2>(const Sph<2>&);
template double mean_neighbours<3>(const Sph<3>&);

}  // namespace ejecta
