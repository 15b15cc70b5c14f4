#include "observe/plane_impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/shape_geometry.hpp"

namespace ejecta {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Vec<3> vector_of(const Triple& t) { return {t[0], t[1], t[2]}; }

/// Speed of sound [m/s] of matter that nothing has compressed yet.
double sound_speed_of(const Material& m, double density) {
  if (m.porosity) return 0;
  if (m.elastic) return m.elastic->longitudinal_speed(density);
  return std::visit(
      [&](const auto& eos) {
        return sound_speed(eos.evaluate(density, energy_at_rest(m.eos)), density, eos.sound_speed_floor());
      },
      m.eos);
}

/// What takes part in an impact.
struct Collider {
  const Body* body;
  double density, sound_speed;   ///< SI
  Vec<3> half = Vec<3>::Zero();  ///< m

  /// rho Us [kg/(m^2 s)].
  double impedance(double closing) const { return body->driven ? infinity : density * (sound_speed + 0.75 * closing); }
  /// Across a direction [m].
  double width(const Vec<3>& along, int dimension) const {
    double sum = 0;
    for (int a = 0; a < dimension; ++a) sum += (1 - along[a] * along[a]) * 2 * half[a];
    return sum / (dimension - 1);
  }
};

template <int Dim>
Vec<3> half_extent_of(const Body& body) {
  Vec<3> half = Vec<3>::Zero();
  half.template head<Dim>() = with_shape<Dim>(body, [](const auto& shape) -> Vec<Dim> { return shape.half_extent(); });
  return half;
}

std::vector<Collider> colliders_of(const Scene& scene, const std::vector<Material>& materials) {
  std::vector<Collider> list;
  for (const Body& body : scene.bodies) {
    const auto m = std::ranges::find(materials, body.material, &Material::name);
    if (m == materials.end() || m->gas()) continue;
    const double density = is_set(body.density) ? body.density : m->bulk_density();
    list.push_back({&body, density, sound_speed_of(*m, density),
                    scene.dimension == 2 ? half_extent_of<2>(body) : half_extent_of<3>(body)});
  }
  return list;
}

/// Of a body of impedance `z` that is struck by one of impedance `other` with a velocity [m/s].
void add(PlaneImpact& impact, double closing, double z, double other, double share, const Vec<3>& before,
         const Vec<3>& way) {
  if (std::isinf(z)) return;                                            // it does not give way
  const double received = std::isinf(other) ? 1 : other / (z + other);  // of the velocity
  impact.pressure = std::max(impact.pressure, share * closing * received * z);
  impact.speed = std::max(impact.speed, (before + 2 * share * closing * received * way).norm());
}

}  // namespace

PlaneImpact strongest_impact(const Scene& scene, const std::vector<Material>& materials) {
  PlaneImpact impact;
  const std::vector<Collider> all = colliders_of(scene, materials);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Vec<3> x = vector_of(all[i].body->center), v = vector_of(all[i].body->velocity);
    for (std::size_t j = 0; j < i; ++j) {
      const Vec<3> relative = v - vector_of(all[j].body->velocity);
      const double closing = relative.norm();
      if (!(closing > 0) || (x - vector_of(all[j].body->center)).dot(relative) >= 0) continue;
      const Vec<3> way = relative.normalized();  // on which j is pushed
      const double wi = all[i].width(way, scene.dimension), wj = all[j].width(way, scene.dimension);
      const double share = std::min(wi, wj) / std::max(wi, wj);
      const double zi = all[i].impedance(closing), zj = all[j].impedance(closing);
      add(impact, closing, zj, zi, share, vector_of(all[j].body->velocity), way);
      add(impact, closing, zi, zj, share, v, -way);
    }
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a) {
      const double along = v[static_cast<int>(a)];
      if (!mirrors(along > 0 ? scene.boundary.upper[a] : scene.boundary.lower[a]) || along == 0) continue;
      Vec<3> way = Vec<3>::Zero();
      way[static_cast<int>(a)] = along > 0 ? -1 : 1;
      add(impact, std::abs(along), all[i].impedance(2 * std::abs(along)), infinity, 1, v, way);
    }
  }
  return impact;
}

}  // namespace ejecta
