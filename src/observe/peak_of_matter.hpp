#pragma once
#include "particles/particles.hpp"

namespace ejecta {

/// The highest pressure that a piece of a body has seen [Pa], and not a particle on its own: the highest that two
/// particles which began side by side, within `reach` [m], have both seen. Of a body that has no two the highest of all
/// its particles. They remember their peaks (output.peaks).
template <int Dim>
double peak_of_matter(const Particles<Dim>& particles, std::int32_t body, double reach);

}  // namespace ejecta
