/// What of the particles goes into a checkpoint: every column, rates also as they were at the step before.
#include <fmt/format.h>

#include "sph/sph.hpp"

namespace ejecta {

template <int Dim>
void Sph<Dim>::persist(Archive& archive) {
  Particles<Dim>& p = particles;
  if (const std::size_t n = archive.size(p.size()); n != p.size()) p.resize(n);
  for (const Field field : p.fields()) {
    const FieldInfo& f = info(field);
    const int count = components(f.shape, Dim);
    for (int k = 0; k < count; ++k) {
      const std::string name = count == 1 ? std::string(f.name) : fmt::format("{}_{}", f.name, k);
      if (f.role == Role::derived && !archive.has(name)) continue;  // made again by the stages
      archive.column(name, f.unit, p.column(field, k));
      if (f.role == Role::rate) archive.column("previous_" + name, f.unit, p.previous(field, k));
    }
  }
  archive.labels("id", p.label(Label::id));
  archive.labels("body", p.label(Label::body));
  archive.labels("material", p.label(Label::material));
  if (!archive.reads()) return;
  p.set_material_ranges(ranges_of_materials(p.label(Label::material), materials.size()));
  lists.invalidate();
}

template void Sph<2>::persist(Archive&);
template void Sph<3>::persist(Archive&);

}  // namespace ejecta
