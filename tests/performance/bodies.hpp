#pragma once
/// The bodies that are measured: a ball (3D) or disc (2D) of pumice, or of a gas, at rest on its lattice. They go
/// through the set-up of a run; one thread does all.
#include <fmt/format.h>

#include <map>

#include "base/parallel.hpp"
#include "unit/sph/small_scenes.hpp"

namespace ejecta {

/// A body of about n particles; overrides as on the command line. The same request is set up once.
template <int Dim>
Sph<Dim>& body(const std::string& material, double n, const std::vector<std::string>& overrides = {}) {
  static std::map<std::string, std::unique_ptr<Sph<Dim>>> made;
  const double radius = 35, volume = Dim == 2 ? 3.1416 * radius * radius : 4.1888 * radius * radius * radius;
  const std::string text = fmt::format(
      "[scene]\nname = \"body\"\ndimension = {}\n[resolution]\nspacing = \"{} mm\"\n[time]\nend = \"1 ms\"\n"
      "[[bodies]]\nname = \"body\"\nmaterial = \"{}\"\nshape = \"{}\"\nradius = \"{} mm\"\n{}",
      Dim, std::pow(volume / n, 1.0 / Dim), material, Dim == 2 ? "disc" : "sphere", radius,
      material == "air" ? "pressure = \"1e5 Pa\"\n" : "");
  std::string key = text;
  for (const std::string& o : overrides) key += o + "\n";
  auto& simulation = made[key];
  if (!simulation) {
    set_threads(1);
    simulation = start<Dim>(text, overrides);
  }
  return *simulation;
}

template <int Dim>
std::array<std::span<const double>, 3> vectors(const Particles<Dim>& p, Field f) {
  std::array<std::span<const double>, 3> columns;
  for (int a = 0; a < Dim; ++a) columns[static_cast<std::size_t>(a)] = p.column(f, a);
  return columns;
}

}  // namespace ejecta
