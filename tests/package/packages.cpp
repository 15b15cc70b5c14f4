/// The packages of Ejecta and one more, here before them: the order is free.
#include "model/package_kind.hpp"
#include "oscillators.hpp"
#include "sph/particle_package.hpp"

namespace ejecta {

const std::vector<PackageKind>& package_kinds() {
  static const std::vector<PackageKind> kinds{oscillators(), particle_package()};
  return kinds;
}

}  // namespace ejecta
