#include "observe/columns.hpp"

namespace ejecta {

template <int Dim>
FieldView field_view(const Particles<Dim>& p, Field field) {
  const FieldInfo& f = info(field);
  FieldView view{std::string(f.name), std::string(f.unit), {}};
  for (int k = 0; k < components(f.shape, Dim); ++k) view.components.push_back(p.column(field, k));
  return view;
}

template <int Dim>
ParticleView particle_view(const Particles<Dim>& p) {
  ParticleView view;
  for (int a = 0; a < Dim; ++a) view.position[static_cast<std::size_t>(a)] = p.column(Field::position, a);
  view.mass = p.column(Field::mass);
  view.density = p.column(Field::density);
  view.smoothing_length = p.column(Field::smoothing_length);
  if (p.has(Field::smoothing_metric))
    for (int k = 0; k < symmetric_size<Dim>; ++k)
      view.smoothing_metric[static_cast<std::size_t>(k)] = p.column(Field::smoothing_metric, k);
  return view;
}

template <int Dim>
FragmentInput fragment_input(const Sph<Dim>& sim) {
  const Particles<Dim>& p = sim.particles;
  const Boundary& boundary = sim.scene.boundary;
  FragmentInput in;
  for (std::size_t a = 0; a < Dim; ++a)
    if (boundary.periodic(a)) in.box[a] = {boundary.min[a], boundary.length(a)};
  in.piece_of_body = pieces_of_bodies(sim.scene, sim.materials, sim.body_material);
  in.target = static_cast<std::int32_t>(target_body(sim.scene, sim.outset.bodies));
  for (int a = 0; a < Dim; ++a) {
    in.position[static_cast<std::size_t>(a)] = p.column(Field::position, a);
    in.velocity[static_cast<std::size_t>(a)] = p.column(Field::velocity, a);
  }
  in.mass = p.column(Field::mass);
  in.density = p.column(Field::density);
  if (p.has(Field::damage)) in.damage = p.column(Field::damage);
  if (p.has(Field::distension)) in.distension = p.column(Field::distension);
  const ParticleView view = particle_view(p);
  in.smoothing_length = view.smoothing_length;
  in.smoothing_metric = view.smoothing_metric;
  in.nodes_per_h = sim.scene.numerics.nodes_per_h;
  in.id = p.label(Label::id);
  in.body = p.label(Label::body);
  in.material = p.label(Label::material);
  return in;
}

template FieldView field_view<2>(const Particles<2>&, Field);
template FieldView field_view<3>(const Particles<3>&, Field);
template ParticleView particle_view<2>(const Particles<2>&);
template ParticleView particle_view<3>(const Particles<3>&);
template FragmentInput fragment_input<2>(const Sph<2>&);
template FragmentInput fragment_input<3>(const Sph<3>&);

}  // namespace ejecta
