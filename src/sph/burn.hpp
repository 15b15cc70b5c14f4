#pragma once
/// What is to be said of the explosives of a run.
#include "sph/sph.hpp"

namespace ejecta {

/// How much of them has burnt, and the energy that this has set free.
template <int Dim>
Quantities burn_quantities(const Sph<Dim>& sph);

/// A remark on each body of which some is never reached by a detonation.
template <int Dim>
std::vector<Remark> unlit(const Sph<Dim>& sph);

}  // namespace ejecta
