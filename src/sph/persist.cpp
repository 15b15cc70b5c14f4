/// What of the particles goes into a checkpoint: every column, rates also as they were at the step before.
#include <fmt/format.h>

#include "base/errors.hpp"
#include "sph/sph.hpp"

namespace ejecta {

template <int Dim>
void Sph<Dim>::persist(Archive& archive) {
  Particles<Dim>& p = particles;
  if (const std::size_t n = archive.size(p.size()); n != p.size())
    throw InputError(fmt::format("expected a checkpoint of {} particles, got {}: it belongs to another scene", p.size(), n));
  for (const Field field : p.fields()) {
    const FieldInfo& f = info(field);
    const int count = components(f.shape, Dim);
    for (int k = 0; k < count; ++k) {
      const std::string name = count == 1 ? std::string(f.name) : fmt::format("{}_{}", f.name, k);
      archive.column(name, f.unit, p.column(field, k));
      if (f.role == Role::rate) archive.column("previous_" + name, f.unit, p.previous(field, k));
    }
  }
  archive.labels("id", p.label(Label::id));
  archive.labels("body", p.label(Label::body));
  archive.labels("material", p.label(Label::material));
  if (archive.reads()) lists.invalidate();
}

template void Sph<2>::persist(Archive&);
template void Sph<3>::persist(Archive&);

}  // namespace ejecta
