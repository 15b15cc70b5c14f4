#include "sph/particle_package.hpp"

#include "sph/sph.hpp"

namespace ejecta {

PackageKind particle_package() {
  return {{}, [](const Scene& scene, const std::vector<Material>& materials) -> std::unique_ptr<Package> {
            if (scene.dimension == 2) return set_up<2>(scene, materials);
            return set_up<3>(scene, materials);
          }};
}

}  // namespace ejecta
