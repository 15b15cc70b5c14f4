/// The packages of Ejecta and one more: what src/app/packages.cpp would be with it.
#include "model/package_kind.hpp"
#include "oscillators.hpp"
#include "sph/particle_package.hpp"

namespace ejecta {

const std::vector<PackageKind>& package_kinds() {
  static const std::vector<PackageKind> kinds{particle_package(), oscillators()};
  return kinds;
}

}  // namespace ejecta
