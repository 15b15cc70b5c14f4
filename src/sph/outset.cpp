#include "sph/outset.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "sph/pieces.hpp"

namespace ejecta {

template <int Dim>
Outset outset(const Particles<Dim>& p, const Scene& scene, const std::vector<Material>& materials) {
  Outset start;
  start.bodies.resize(scene.bodies.size());
  const auto material_of = [&](std::size_t i) -> const Material& {
    return materials[static_cast<std::size_t>(p.label(Label::material)[i])];
  };
  double mass = 0;
  Vec<Dim> momentum = Vec<Dim>::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) {
    const std::size_t b = static_cast<std::size_t>(p.label(Label::body)[i]);
    BodyAtOutset& body = start.bodies[b];
    const Vec<Dim> mv = p.column(Field::mass)[i] * p.vector(Field::velocity, i);
    body.mass += p.column(Field::mass)[i];
    body.velocity.template head<Dim>() += mv;
    body.may_be_target = !scene.bodies[b].driven && !material_of(i).gas();
    momentum += mv;
    mass += p.column(Field::mass)[i];
  }
  for (BodyAtOutset& body : start.bodies) body.velocity /= body.mass;

  Vec<Dim> frame = momentum / mass;
  for (std::size_t a = 0; a < Dim; ++a)
    if (mirrors(scene.boundary.lower[a]) || mirrors(scene.boundary.upper[a])) frame[static_cast<int>(a)] = 0;
  double relative_speed = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec<Dim> v = p.vector(Field::velocity, i);
    start.speed = std::max(start.speed, v.norm());
    relative_speed = std::max(relative_speed, (v - frame).norm());
  }
  if (relative_speed < 1e-9 * start.speed) relative_speed = 0;  // what the sum has rounded
  for (const Material& material : materials)
    if (const auto explosive = material.explosive()) {
      const double density = material.bulk_density(), D = explosive->detonation_speed, s = explosive->cj_compression;
      start.speed = std::max(start.speed, D * s);
      start.density = std::max(start.density, density / (1 - s));
      start.pressure = std::max(start.pressure, density * D * D * s);
    }
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double density = p.column(Field::density)[i], u = relative_speed;
    const bool gas = material_of(i).gas();
    start.density = std::max(start.density, gas ? density : 1.2 * density);
    start.pressure =
        std::max({start.pressure, std::abs(p.column(Field::pressure)[i]),
                  gas ? density * u * u : 0.1 * density * u * std::max(u, p.column(Field::sound_speed)[i])});
    if (p.has(Field::deviatoric_stress))
      for (int k = 0; k < deviator_size<Dim>; ++k)
        start.pressure = std::max(start.pressure, std::abs(p.column(Field::deviatoric_stress, k)[i]));
  }
  return start;
}

std::size_t target_body(const Scene& scene, const std::vector<BodyAtOutset>& bodies) {
  if (!scene.fragments.target.empty()) {
    const auto named = std::ranges::find(scene.bodies, scene.fragments.target, &Body::name);
    return static_cast<std::size_t>(named - scene.bodies.begin());
  }
  double mass = 0, fastest = 0;
  Vec<3> momentum = Vec<3>::Zero();
  for (const BodyAtOutset& body : bodies) {
    mass += body.mass;
    momentum += body.mass * body.velocity;
    fastest = std::max(fastest, body.velocity.norm());
  }
  const auto before = [&](const BodyAtOutset& a, const BodyAtOutset& b) {
    const auto key = [&](const BodyAtOutset& body) {
      const bool at_rest = body.velocity.norm() <= 1e-9 * fastest;  // the sum over a spinning body is not exactly zero
      const double speed = at_rest ? 0 : (body.velocity - momentum / mass).norm();
      return std::tuple(!body.may_be_target, !at_rest, speed, -body.mass);
    };
    return key(a) < key(b);
  };
  return static_cast<std::size_t>(std::min_element(bodies.begin(), bodies.end(), before) - bodies.begin());
}

std::vector<std::int32_t> pieces_of_bodies(const Scene& scene, const std::vector<Material>& materials,
                                           const std::vector<int>& body_material) {
  std::vector<std::int32_t> pieces = pieces_of(scene, materials, body_material);
  std::ranges::replace(pieces, 0, -1);  // gases
  return pieces;
}

template Outset outset<2>(const Particles<2>&, const Scene&, const std::vector<Material>&);
template Outset outset<3>(const Particles<3>&, const Scene&, const std::vector<Material>&);

}  // namespace ejecta
