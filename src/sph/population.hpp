#pragma once
/// Particles that come and go between steps. What they carry is booked as coming from outside, and the step after is
/// as the first of a run: it knows of no rates before it.
#include <functional>
#include <span>

#include "sph/sph.hpp"

namespace ejecta {

/// Takes out the particles i with doomed[i] != 0, n values. Throws SimulationError if the others make no sense.
template <int Dim>
void remove_particles(Sph<Dim>& sph, std::span<const char> doomed);

/// Adds a copy of each of these particles, with an id of its own, and calls place(index of the copy) to give it the
/// state that it is to have. Material and body stay those of the original. Throws SimulationError likewise.
template <int Dim>
void add_particles(Sph<Dim>& sph, std::span<const std::size_t> originals,
                   const std::function<void(std::size_t)>& place);

}  // namespace ejecta
