#include "hybrid/solids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "schemes/kernels.hpp"

namespace ejecta {

namespace {

/// The bodies alone, as a scene of SPH.
Scene scene_of_solids(Scene scene, const std::vector<Material>& materials) {
  std::erase_if(scene.bodies, [&](const Body& body) { return !is_solid(body, materials); });
  if (!scene.bodies.empty() && scene.numerics.kernel == Kernel::gaussian)
    throw InputError(
        fmt::format("{}: numerics.kernel: expected another one than gaussian where bodies are solid", scene.file));
  scene.numerics.scheme = SchemeKind::sph;
  scene.numerics.density = DensityMethod::continuity;
  scene.charge.reset();
  scene.gas.reset();
  return scene;
}

std::vector<Material> materials_of(const Scene& scene, const std::vector<Material>& materials) {
  std::vector<Material> used;
  std::ranges::copy_if(materials, std::back_inserter(used), [&](const Material& m) {
    return std::ranges::any_of(scene.bodies, [&](const Body& body) { return body.material == m.name; });
  });
  return used;
}

}  // namespace

bool is_solid(const Body& body, const std::vector<Material>& materials) {
  return !std::ranges::find(materials, body.material, &Material::name)->gas();
}

Scene with_gas_for_solids(Scene scene, const std::vector<Material>& materials) {
  bool any = false;
  for (Body& body : scene.bodies) {
    if (!is_solid(body, materials)) continue;
    if (!scene.gas)
      throw InputError(fmt::format("{}: bodies.{}: expected [gas] around a solid with numerics.scheme = \"hybrid\"",
                                   body.origin, body.name));
    if (body.spacing_factor > 1)
      throw InputError(
          fmt::format("{}: bodies.{}.spacing_factor: expected at most 1, got {}: gas would pass between "
                      "the particles of a coarser body",
                      body.origin, body.name, body.spacing_factor));
    any = true;
    body.material = scene.gas->material;
    body.density = scene.gas->density;
    body.pressure = scene.gas->pressure;
    body.specific_energy = 0;
    body.velocity = {0, 0, 0};
    body.driven = false;
    body.profile = {};
    body.weld = "auto";
  }
  if (!any) return scene;
  scene.fragments.enabled = false;  // these are of the bodies
  scene.output.peaks = false;
  return scene;
}

template <int Dim>
Solids<Dim>::Solids(const Scene& scene, const std::vector<Material>& materials) {
  const Scene alone = scene_of_solids(scene, materials);
  sph_ = set_up<Dim>(alone, materials_of(alone, materials));
  const Particles<Dim>& p = sph_->particles;
  loads_.resize(p.size());
  spacing_.resize(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    spacing_[static_cast<std::size_t>(p.label(Label::id)[i])] =
        scene.spacing * alone.bodies[static_cast<std::size_t>(p.label(Label::body)[i])].spacing_factor;
}

template <int Dim>
std::vector<std::uint32_t> Solids<Dim>::by_id() const {
  const auto id = sph_->particles.label(Label::id);
  std::vector<std::uint32_t> places(id.size());
  for (std::size_t i = 0; i < id.size(); ++i) places[static_cast<std::size_t>(id[i])] = static_cast<std::uint32_t>(i);
  return places;
}

template <int Dim>
std::vector<Placement<Dim>> Solids<Dim>::images(double gas_density) const {
  const Particles<Dim>& p = sph_->particles;
  std::vector<Placement<Dim>> placements(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double volume = p.column(Field::mass)[i] / p.column(Field::density)[i];
    const Vec<Dim> x = p.vector(Field::position, i);
    placements[static_cast<std::size_t>(p.label(Label::id)[i])] = {x,           x, volume, std::pow(volume, 1.0 / Dim),
                                                                   gas_density, 0, 0};
  }
  return placements;
}

template <int Dim>
void Solids<Dim>::add_loads(const Sph<Dim>& gas, double dt) {
  const Particles<Dim>& g = gas.particles;
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (!is_image(g, i)) continue;
    GasLoad<Dim>& load = loads_[static_cast<std::size_t>(g.label(Label::id)[i])];
    const double half = 0.5 * dt * g.column(Field::mass)[i];
    load.impulse += half * g.vector(Field::acceleration, i);
    load.energy += half * g.column(Field::specific_energy_rate)[i];
  }
}

template <int Dim>
void Solids<Dim>::begin(Sph<Dim>& gas, double dt) {
  std::ranges::fill(loads_, GasLoad<Dim>{});
  add_loads(gas, dt);
  const Particles<Dim>& p = sph_->particles;
  const std::vector<std::uint32_t> of_id = by_id();
  Particles<Dim>& g = gas.particles;
  wall_velocity_.resize(p.size());
  for (std::size_t id = 0; id < p.size(); ++id) wall_velocity_[id] = p.vector(Field::velocity, of_id[id]);
  parallel_for(0, g.size(), [&](std::size_t i) {
    if (!is_image(g, i)) return;
    const std::size_t solid = of_id[static_cast<std::size_t>(g.label(Label::id)[i])];
    g.set_vector(Field::position, i, p.vector(Field::position, solid));
    g.set_vector(Field::velocity, i, p.vector(Field::velocity, solid));
    g.set_vector(Field::acceleration, i, Vec<Dim>::Zero());
    g.column(Field::specific_energy_rate)[i] = 0;
  });
}

template <int Dim>
void Solids<Dim>::mirror(Sph<Dim>& gas, const ParticlesByCell<Dim>& by_cell, const Box<Dim>& box,
                         const CellState<Dim>& rest) const {
  Particles<Dim>& g = gas.particles;
  const double support = kernel_support(gas.scene.numerics.kernel);
  std::vector<char> holds_gas(box.size(), 0);
  for (std::size_t i = 0; i < g.size(); ++i)
    if (!is_image(g, i)) holds_gas[cell_of(box, g.vector(Field::position, i))] = 1;
  parallel_for(0, g.size(), [&](std::size_t i) {
    if (!is_image(g, i)) return;
    const Vec<Dim> x = g.vector(Field::position, i), own = g.vector(Field::velocity, i);
    const double reach = support * g.column(Field::smoothing_length)[i];
    CellState<Dim> mean{};
    mean.velocity = Vec<Dim>::Zero();
    Vec<Dim> outwards = Vec<Dim>::Zero();  // of the body, up to 1
    double all = 0;
    const auto see = [&](std::size_t j, const Vec<Dim>& d, const Vec<Dim>& v) {
      const double r = d.norm(), q = r / reach;
      if (q >= 1) return;
      const double weight = (1 - q) * (1 - q) * (1 + 2 * q) * g.column(Field::mass)[j] / g.column(Field::density)[j];
      all += weight;
      mean.density += weight * g.column(Field::density)[j];
      mean.pressure += weight * g.column(Field::pressure)[j];
      mean.sound_speed += weight * g.column(Field::sound_speed)[j];
      mean.specific_energy += weight * g.column(Field::specific_energy)[j];
      mean.velocity += weight * v;
      if (r > 0) outwards += weight / r * d;
    };
    const auto radius = static_cast<int>(std::ceil(reach / box.spacing));
    bool near = false;
    for_cells_near<Dim>(box, box.cell(cell_of(box, x)), radius, [&](std::size_t c, int) { near |= holds_gas[c] != 0; });
    if (near)
      by_cell.for_near(box, cell_of(box, x), radius, [&](std::size_t j) {
        if (is_image(g, j)) return;
        // And its own images behind mirrors.
        const Vec<Dim> y = g.vector(Field::position, j);
        for (unsigned mirrored = 0; mirrored < 1u << Dim; ++mirrored) {
          Vec<Dim> d = shortest_way(box, x, y), v = g.vector(Field::velocity, j);
          bool there = true;
          for (int a = 0; a < Dim; ++a) {
            const auto k = static_cast<std::size_t>(a);
            const double length = box.cells[k] * box.spacing;
            if (!(mirrored >> k & 1u)) continue;
            const double low = box.corner[a], high = low + length;
            const bool at_low = mirrors(box.lower[k]) && x[a] - low < reach,
                       at_high = mirrors(box.upper[k]) && high - x[a] < reach;
            there = there && (at_low || at_high);
            d[a] = 2 * (at_low ? low : high) - y[a] - x[a];
            v[a] = -v[a];
          }
          if (there) see(j, d, v);
        }
      });
    if (all > 0) {
      mean.density /= all;
      mean.pressure /= all;
      mean.sound_speed /= all;
      mean.specific_energy /= all;
      mean.velocity /= all;
      outwards /= all;
      // A particle that gas surrounds has no surface: it is a body that gas closes in on.
      const double length = outwards.norm(), share = std::min(1.0, 2 * length);
      const Vec<Dim> n = length > 0 ? Vec<Dim>(outwards / length) : Vec<Dim>::Zero();
      const Vec<Dim> turned = mean.velocity - 2 * (mean.velocity - own).dot(n) * n;
      mean.velocity = own + share * (turned - own);
    } else {
      mean = rest;
      mean.velocity = own;
    }
    double& density = g.column(Field::density)[i];
    g.column(Field::mass)[i] *= mean.density / density;
    density = mean.density;
    g.column(Field::pressure)[i] = mean.pressure;
    g.column(Field::sound_speed)[i] = mean.sound_speed;
    g.column(Field::specific_energy)[i] = mean.specific_energy;
    g.set_vector(Field::velocity, i, mean.velocity);
  });
}

template <int Dim>
void Solids<Dim>::keep_power(Sph<Dim>& gas) const {
  Particles<Dim>& g = gas.particles;
  parallel_for(0, g.size(), [&](std::size_t i) {
    if (is_image(g, i))
      g.column(Field::specific_energy_rate)[i] += g.vector(Field::acceleration, i).dot(g.vector(Field::velocity, i));
  });
}

/// Gas particles within a surface come back to it, and lose the velocity with which they went in, which heats them.
template <int Dim>
void Solids<Dim>::hold_out(Sph<Dim>& gas, const ParticlesByCell<Dim>& by_cell, const Box<Dim>& box) {
  using Shape = WendlandC2;
  constexpr double width = 1.3;                      // smoothing length, in spacings of the solid
  constexpr double surface = 0.5, most_moved = 0.1;  // of a spacing, in one step
  Particles<Dim>& g = gas.particles;
  const double norm = Shape::norm<Dim> / std::pow(width, Dim);
  const auto radius = static_cast<int>(std::ceil(Shape::support * width * gas.scene.spacing / box.spacing));
  const auto for_images = [&](std::size_t i, auto&& see) {
    const Vec<Dim> x = g.vector(Field::position, i);
    by_cell.for_near(box, cell_of(box, x), radius, [&](std::size_t j) {
      if (!is_image(g, j)) return;
      const double h = width * spacing_[static_cast<std::size_t>(g.label(Label::id)[j])];
      const Vec<Dim> d = shortest_way<Dim>(box, x, g.vector(Field::position, j)) / h;
      const double q = d.norm();
      if (q < Shape::support) see(j, d, q, h);
    });
  };
  std::vector<char> near(box.size(), 0);  // most gas is far from solids
  for (std::size_t i = 0; i < g.size(); ++i)
    if (is_image(g, i))
      for_cells_near<Dim>(box, box.cell(cell_of(box, g.vector(Field::position, i))), radius,
                          [&](std::size_t cell, int) { near[cell] = 1; });
  std::vector<double> filled(g.size(), 0.0);
  parallel_for(0, g.size(), [&](std::size_t i) {
    if (is_image(g, i) || near[cell_of(box, g.vector(Field::position, i))] == 0) return;
    for_images(i, [&](std::size_t, const Vec<Dim>&, double q, double) { filled[i] += norm * Shape::value(q); });
  });
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (filled[i] <= surface) continue;
    Vec<Dim> rise = Vec<Dim>::Zero(), own = Vec<Dim>::Zero();  // gradient of `filled`, velocity of the wall
    for_images(i, [&](std::size_t j, const Vec<Dim>& d, double q, double h) {
      rise -= norm * Shape::slope_over_q(q, q > 0 ? 1 / q : 0.0) / h * d;
      own += norm * Shape::value(q) / filled[i] * wall_velocity_[static_cast<std::size_t>(g.label(Label::id)[j])];
    });
    const double steep = rise.norm();
    if (!(steep > 0)) continue;
    const Vec<Dim> outwards = -rise / steep, x = g.vector(Field::position, i), v = g.vector(Field::velocity, i);
    g.set_vector(Field::position, i,
                 x + std::min((filled[i] - surface) / steep, most_moved * gas.scene.spacing) * outwards);
    const double into = -(v - own).dot(outwards);
    if (!(into > 0)) continue;
    const double mass = g.column(Field::mass)[i];
    double given = 0;  // energy
    for_images(i, [&](std::size_t j, const Vec<Dim>&, double q, double) {
      const auto id = static_cast<std::size_t>(g.label(Label::id)[j]);
      const Vec<Dim> impulse = -mass * into * norm * Shape::value(q) / filled[i] * outwards;
      const double work = impulse.dot(wall_velocity_[id]);
      loads_[id].impulse += impulse;
      loads_[id].energy += work;
      given += work;
    });
    const Vec<Dim> stopped = v + into * outwards;
    g.column(Field::specific_energy)[i] += 0.5 * (v.squaredNorm() - stopped.squaredNorm()) - given / mass;
    g.set_vector(Field::velocity, i, stopped);
  }
}

/// The bodies' own steps within one of the gas, whose loads are spread over them evenly.
template <int Dim>
void Solids<Dim>::carry(double dt) {
  const double started = sph_->clock.time;
  for (double left = dt; left > 1e-12 * dt;) {
    const double steps = std::max(1.0, std::ceil(left / sph_->vote().dt - 1e-9)), step = left / steps;
    for (std::size_t i = 0; i < sph_->particles.size(); ++i)
      kick(i, loads_[static_cast<std::size_t>(sph_->particles.label(Label::id)[i])], step / dt, step);
    sph_->advance(step);
    left = steps == 1 ? 0 : started + dt - sph_->clock.time;
  }
}

/// `share` of a load, before a step dt. What of the energy is not work heats the body: nothing where the Riemann
/// problems have the wall at its velocity. The opening kick of the step (integrator.hpp) takes the particle to have the
/// velocity that the step before left.
template <int Dim>
void Solids<Dim>::kick(std::size_t i, const GasLoad<Dim>& load, double share, double dt) {
  Particles<Dim>& p = sph_->particles;
  const double mass = p.column(Field::mass)[i];
  const Vec<Dim> v = p.vector(Field::velocity, i), impulse = share * load.impulse;
  double work = impulse.dot(v);
  if (sph_->scene.bodies[static_cast<std::size_t>(p.label(Label::body)[i])].driven) {
    sph_->external.impulse.template head<Dim>() -= impulse;
    sph_->external.work -= work;
  } else {
    work += 0.5 * impulse.squaredNorm() / mass + 0.5 * dt * p.vector(Field::acceleration, i).dot(impulse);
    p.set_vector(Field::velocity, i, v + impulse / mass);
  }
  p.column(Field::specific_energy)[i] += (share * load.energy - work) / mass;
}

template class Solids<2>;
template class Solids<3>;

}  // namespace ejecta
