#pragma once
/// What several stages ask of one particle.
#include "material/deviator.hpp"
#include "material/material.hpp"
#include "particles/particles.hpp"
#include "scene/scene.hpp"

namespace ejecta {

template <int Dim>
Deviator<Dim> deviator(const Particles<Dim>& particles, std::size_t i) {
  Deviator<Dim> s;
  for (int k = 0; k < deviator_size<Dim>; ++k) s[k] = particles.column(Field::deviatoric_stress, k)[i];
  return s;
}

/// Distension of a particle; 1 where its material has no pores.
template <int Dim>
double distension_of(const Particles<Dim>& p, const Material& material, std::size_t i) {
  return material.porosity ? p.column(Field::distension)[i] : 1.0;
}

/// Velocity gradient that strains and turns the matter of a particle [1/s]: with tensor damage the one that sees no
/// motion across a crack.
template <int Dim>
Mat<Dim> straining_gradient(const Particles<Dim>& p, const Material& material, std::size_t i) {
  const bool coupled = material.tensor_damage() && p.has(Field::uncut_gradient);
  return p.tensor(coupled ? Field::uncut_gradient : Field::velocity_gradient, i);
}

/// Whether the particle belongs to a body that keeps its velocity.
template <int Dim>
bool driven(const Particles<Dim>& p, const Scene& scene, std::size_t i) {
  return scene.bodies[static_cast<std::size_t>(p.label(Label::body)[i])].driven;
}

}  // namespace ejecta
