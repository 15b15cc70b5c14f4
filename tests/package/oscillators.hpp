#pragma once
#include "model/package_kind.hpp"

namespace ejecta {

/// Damped oscillators on anchored springs, with steps of their own: the smallest package there can be, to see that the
/// seam holds.
PackageKind oscillators();

}  // namespace ejecta
