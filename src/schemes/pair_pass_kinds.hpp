#pragma once
/// The passes of one kernel, by what the settings ask. Included only by the sources that EjectaPairPasses.cmake makes.
#include "schemes/monaghan_viscosity.hpp"
#include "schemes/pair_pass_impl.hpp"
#include "schemes/pair_rates.hpp"
#include "schemes/pair_rates_close.hpp"
#include "schemes/pair_surroundings.hpp"

namespace ejecta {

/// The pass of one kernel for what the settings ask, with smoothing lengths.
template <int Dim, class K>
std::unique_ptr<PairPass<Dim>> make_isotropic_pass_of(const PairPassSettings& s) {
  auto of_precision = [&]<class T>(T) -> std::unique_ptr<PairPass<Dim>> {
    auto of = [&]<PassKind Kind>() { return std::make_unique<PairPassOf<T, Dim, Kind, K, MonaghanViscosity>>(s); };
    constexpr bool stress = true, gradient = true;
    if (s.stress && s.bonded) return of.template operator()<PassKind{stress, gradient, false, false, true}>();
    if (s.stress) return of.template operator()<PassKind{stress, gradient}>();
    if (s.velocity_gradient) return of.template operator()<PassKind{!stress, gradient}>();
    return of.template operator()<PassKind{}>();
  };
  return s.precision == Precision::mixed ? of_precision(float{}) : of_precision(double{});
}

/// The same with smoothing tensors, or with cracks that cut the stress across them: both always with velocity
/// gradients.
template <int Dim, class K>
std::unique_ptr<PairPass<Dim>> make_anisotropic_pass_of(const PairPassSettings& s) {
  auto of_precision = [&]<class T>(T) -> std::unique_ptr<PairPass<Dim>> {
    auto of = [&]<PassKind Kind>() -> std::unique_ptr<PairPass<Dim>> {
      constexpr PassKind bonded{Kind.stress, Kind.gradient, Kind.asph, Kind.cracked, Kind.stress};
      if (Kind.stress && s.bonded) return std::make_unique<PairPassOf<T, Dim, bonded, K, MonaghanViscosity>>(s);
      return std::make_unique<PairPassOf<T, Dim, Kind, K, MonaghanViscosity>>(s);
    };
    constexpr bool stress = true, gradient = true, asph = true, cracked = true;
    if (s.cracked && s.asph) return of.template operator()<PassKind{stress, gradient, asph, cracked}>();
    if (s.cracked) return of.template operator()<PassKind{stress, gradient, !asph, cracked}>();
    if (s.stress) return of.template operator()<PassKind{stress, gradient, asph}>();
    return of.template operator()<PassKind{!stress, gradient, asph}>();
  };
  return s.precision == Precision::mixed ? of_precision(float{}) : of_precision(double{});
}

}  // namespace ejecta
