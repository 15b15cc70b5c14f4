/// The packages of Ejecta: to add one, add a line.
#include "grid/grid_package.hpp"
#include "hybrid/hybrid_package.hpp"
#include "model/package_kind.hpp"
#include "sph/particle_package.hpp"

namespace ejecta {

const std::vector<PackageKind>& package_kinds() {
  static const std::vector<PackageKind> kinds{particle_package(), grid_package(), hybrid_package()};
  return kinds;
}

}  // namespace ejecta
