#include <algorithm>

#include "base/parallel.hpp"
#include "sph/stages.hpp"

namespace ejecta {

namespace {

/// Spacings over which the front is spread: with fewer its speed gets uneven, with more the states behind it form
/// later.
constexpr double burn_width = 2.5;

}  // namespace

template <int Dim>
void burn(Sph<Dim>& sph) {
  Particles<Dim>& p = sph.particles;
  const auto lit = p.column(Field::lighting_time), density = p.column(Field::density);
  const auto burnt = p.column(Field::burnt);
  const auto body = p.label(Label::body);
  for (std::size_t m = 0; m < sph.materials.size(); ++m) {
    const auto explosive = sph.materials[m].explosive();
    if (!explosive) continue;
    const Range range = p.material_ranges()[m];
    const double rest = sph.materials[m].bulk_density();
    parallel_for(range.begin, range.end, [&](std::size_t i) {
      const double width =
          burn_width * sph.scene.spacing * sph.scene.bodies[static_cast<std::size_t>(body[i])].spacing_factor;
      const double by_time = 0.5 + (sph.clock.time - lit[i]) * explosive->detonation_speed / width;
      const double by_compression = (1 - rest / density[i]) / explosive->cj_compression;
      burnt[i] = std::min(1.0, std::max({burnt[i], by_time, by_compression}));
    });
  }
}

template void burn<2>(Sph<2>&);
template void burn<3>(Sph<3>&);

}  // namespace ejecta
