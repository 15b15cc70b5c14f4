#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "particles/smoothing_metric.hpp"
#include "schemes/lattice_sums.hpp"
#include "sph/stages.hpp"

namespace ejecta {

namespace {

/// Bounds on h relative to that of the body's lattice: solids must not reach out for neighbours that have flown away; a
/// gas may follow its expansion, and compression by 8000 in 3D.
constexpr double least_relative_h = 0.25, gas_range = 20;

struct Bounds {
  double least, most;  ///< m
};

/// Bounds on the smoothing length of particle i of a material.
template <int Dim>
Bounds bounds_on_h(const Sph<Dim>& sph, const Material& material, std::size_t i) {
  const Numerics& numerics = sph.scene.numerics;
  const Body& body = sph.scene.bodies[static_cast<std::size_t>(sph.particles.label(Label::body)[i])];
  const double h0 = numerics.nodes_per_h * sph.scene.spacing * body.spacing_factor;
  if (!material.solid()) return {h0 / gas_range, h0 * gas_range};
  // A growth of 1 asks for a constant h.
  return {numerics.smoothing_growth > 1 ? least_relative_h * h0 : h0, numerics.smoothing_growth * h0};
}

}  // namespace

template <int Dim>
void smoothing_lengths(Sph<Dim>& sph) {
  Particles<Dim>& p = sph.particles;
  const bool tensor = p.has(Field::smoothing_metric), bonds = p.has(Field::bond);
  for (std::size_t m = 0; m < sph.materials.size(); ++m) {
    const Range range = p.material_ranges()[m];
    parallel_for(range.begin, range.end, [&](std::size_t i) {
      if (bonds && p.column(Field::bond)[i] > 0) return;  // as it was at the start
      const Bounds bounds = bounds_on_h(sph, sph.materials[m], i);
      double& h = p.column(Field::smoothing_length)[i];
      const double before = h;
      h = std::clamp(h * sph.support->growth(p.column(Field::zeroth_moment)[i]), bounds.least, bounds.most);
      if (!tensor) return;
      const double factor = (before / h) * (before / h);
      for (int k = 0; k < symmetric_size<Dim>; ++k) p.column(Field::smoothing_metric, k)[i] *= factor;
    });
  }
}

template <int Dim>
void pilot_lengths(Sph<Dim>& sph) {
  Particles<Dim>& p = sph.particles;
  const Numerics& n = sph.scene.numerics;
  const auto h = p.column(Field::smoothing_length), density = p.column(Field::density), mass = p.column(Field::mass);
  parallel_for(0, p.size(), [&](std::size_t i) { h[i] *= n.pilot_width; });
  sph.pass->density(p, sph.lists);
  // The pass divides by what the lattice gives with n_h particles in h.
  const double wider = lattice_sums(n.kernel, Dim, n.pilot_width * n.nodes_per_h).density /
                       lattice_sums(n.kernel, Dim, n.nodes_per_h).density;
  for (std::size_t m = 0; m < sph.materials.size(); ++m) {
    const Range range = p.material_ranges()[m];
    parallel_for(range.begin, range.end, [&](std::size_t i) {
      const double volume = wider * mass[i] / density[i], size = Dim == 2 ? std::sqrt(volume) : std::cbrt(volume);
      const Bounds bounds = bounds_on_h(sph, sph.materials[m], i);
      h[i] = std::clamp(n.nodes_per_h * size, bounds.least, bounds.most);
    });
  }
}

template <int Dim>
void carry_smoothing(Sph<Dim>& sph) {
  if (sph.clock.step == 0) return;
  Particles<Dim>& p = sph.particles;
  const bool bonds = p.has(Field::bond);
  for (std::size_t m = 0; m < sph.materials.size(); ++m) {
    const Range range = p.material_ranges()[m];
    parallel_for(range.begin, range.end, [&](std::size_t i) {
      if (bonds && p.column(Field::bond)[i] > 0) return;
      const Mat<Dim> carried =
          limited_metric<Dim>(carried_metric<Dim>(p.symmetric(Field::smoothing_metric, i),
                                                  p.tensor(Field::velocity_gradient, i), sph.clock.dt),
                              sph.scene.numerics.largest_aspect);
      const Bounds bounds = bounds_on_h(sph, sph.materials[m], i);
      const double free = smoothing_length_of<Dim>(carried), h = std::clamp(free, bounds.least, bounds.most);
      p.column(Field::smoothing_length)[i] = h;
      p.set_symmetric(Field::smoothing_metric, i, carried * ((free / h) * (free / h)));
    });
  }
}

template void smoothing_lengths<2>(Sph<2>&);
template void smoothing_lengths<3>(Sph<3>&);
template void pilot_lengths<2>(Sph<2>&);
template void pilot_lengths<3>(Sph<3>&);
template void carry_smoothing<2>(Sph<2>&);
template void carry_smoothing<3>(Sph<3>&);

}  // namespace ejecta
