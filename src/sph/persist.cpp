/// What of the particles goes into a checkpoint: every column, rates also as they were at the step before.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "sph/sph.hpp"

namespace ejecta {

namespace {

/// Names under which fields stand in checkpoints written up to November 2026.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> former_names{{
    {"specific_energy_rate", "heating"},
    {"zeroth_moment", "neighbour_sum"},
    {"uncut_gradient", "coupled_gradient"},
    {"largest_mu", "approach_speed"},
    {"crack_length", "crack"},
}};

/// States that begin at zero: a run that had none, by its settings or of an earlier version, goes on with them.
constexpr std::array begin_at_zero{Field::volume_excess};

std::string_view name_in(const Archive& archive, std::string_view name) {
  const auto former = std::ranges::find(former_names, name, &std::pair<std::string_view, std::string_view>::first);
  if (former == former_names.end() || !archive.reads() || archive.has(std::string(name))) return name;
  const std::string_view old = former->second;
  return archive.has(std::string(old)) || archive.has(std::string(old) + "_0") ? old : name;
}

}  // namespace

template <int Dim>
void Sph<Dim>::persist(Archive& archive) {
  Particles<Dim>& p = particles;
  if (const std::size_t n = archive.size(p.size()); n != p.size()) p.resize(n);
  for (const Field field : p.fields()) {
    const FieldInfo& f = info(field);
    const int count = components(f.shape, Dim);
    const std::string_view saved = name_in(archive, f.name);
    for (int k = 0; k < count; ++k) {
      const std::string name = count == 1 ? std::string(saved) : fmt::format("{}_{}", saved, k);
      if (f.role == Role::derived && !archive.has(name)) continue;  // made again by the stages
      if (std::ranges::find(begin_at_zero, field) != begin_at_zero.end() && !archive.has(name)) {
        std::ranges::fill(p.column(field, k), 0.0);
        continue;
      }
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
