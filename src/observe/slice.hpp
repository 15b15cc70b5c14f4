#pragma once
/// Pictures of the particles by the true kernel.
#include <span>
#include <vector>

#include "observe/view.hpp"
#include "particles/particles.hpp"
#include "render/sampling.hpp"
#include "render/volume.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// Fields of a slice: what an impact is about, else what a gas is about.
template <int Dim>
std::vector<Field> slice_fields(const Particles<Dim>& particles);

/// Fields in the plane y = plane_y [m], of the whole domain in 2D.
template <int Dim>
SampledImage make_slice(const Particles<Dim>& particles, std::span<const Field> fields, Kernel kernel,
                        const PixelGrid& grid, double plane_y);

/// How full space is behind the plane y = plane_y [m], as far as the view of a scene goes.
SampledVolume make_volume(const Particles<3>& particles, Kernel kernel, const View& view, double spacing);

/// Mass per area seen along y.
template <int Dim>
SampledImage make_column_density(const Particles<Dim>& particles, Kernel kernel, const PixelGrid& grid);

}  // namespace ejecta
