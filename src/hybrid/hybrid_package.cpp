#include "hybrid/hybrid_package.hpp"

#include "hybrid/hybrid.hpp"

namespace ejecta {

PackageKind hybrid_package() {
  PackageKind kind;
  kind.section = {"hybrid", "particles where fronts are, on a grid", [] { return std::make_shared<HybridSettings>(); }, {"hybrid"}};
  kind.set_up = [](const Scene& scene, const std::vector<Material>& materials) -> std::unique_ptr<Package> {
    if (scene.dimension == 2) return std::make_unique<Hybrid<2>>(scene, materials);
    return std::make_unique<Hybrid<3>>(scene, materials);
  };
  kind.fields = {{"zone", "1"}};
  kind.takes_part = [](const Scene& scene) { return scene.numerics.scheme == SchemeKind::hybrid; };
  return kind;
}

}  // namespace ejecta
