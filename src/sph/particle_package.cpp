#include "sph/particle_package.hpp"

#include "sph/sph.hpp"

namespace ejecta {

PackageKind particle_package() {
  PackageKind kind;
  kind.set_up = [](const Scene& scene, const std::vector<Material>& materials) -> std::unique_ptr<Package> {
    if (scene.dimension == 2) return set_up<2>(scene, materials);
    return set_up<3>(scene, materials);
  };
  kind.takes_part = [](const Scene& scene) { return !scene.numerics.on_grid(); };
  kind.estimate = estimate_particles;
  for (const FieldInfo& field : field_catalogue())
    if (field.role != Role::rate) kind.fields.emplace(field.name, field.unit);
  return kind;
}

}  // namespace ejecta
