#pragma once
/// The live columns of the particles as the layers that look at them take them, without a copy.
#include "render/sampling.hpp"
#include "analysis/fragments.hpp"
#include "sph/sph.hpp"

namespace ejecta {

/// One live field of the particles.
template <int Dim>
FieldView field_view(const Particles<Dim>& particles, Field field);

/// The columns that slices are sampled from.
template <int Dim>
ParticleView particle_view(const Particles<Dim>& particles);

/// The columns of a simulation as fragments see them.
template <int Dim>
FragmentInput fragment_input(const Sph<Dim>& sim);

}  // namespace ejecta
