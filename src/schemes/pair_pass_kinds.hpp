#pragma once
/// The passes of one kernel, by what the settings ask. Included only by the sources that EjectaPairPasses.cmake makes.
#include "schemes/pair_pass_impl.hpp"

namespace ejecta {

/// The pass of one kernel for what the settings ask, with smoothing lengths.
template <int Dim, class K>
std::unique_ptr<PairPass<Dim>> make_isotropic_pass_of(const PairPassSettings& s) {
  auto of_precision = [&]<class T>(T) -> std::unique_ptr<PairPass<Dim>> {
    auto of = [&]<PassKind Kind>() { return std::make_unique<PairPassOf<T, Dim, Kind, K>>(s); };
    constexpr bool stress = true, gradient = true;
    if (s.stress && s.bonded) return of.template operator()<PassKind{stress, gradient, false, false, true}>();
    if (s.stress) return of.template operator()<PassKind{stress, gradient}>();
    if (s.velocity_gradient) return of.template operator()<PassKind{!stress, gradient}>();
    return of.template operator()<PassKind{}>();
  };
  return s.precision == Precision::mixed ? of_precision(float{}) : of_precision(double{});
}

/// The same with smoothing tensors or with stress cut off by cracks: both always with velocity gradients.
template <int Dim, class K>
std::unique_ptr<PairPass<Dim>> make_tensor_pass_of(const PairPassSettings& s) {
  auto of_precision = [&]<class T>(T) -> std::unique_ptr<PairPass<Dim>> {
    auto of = [&]<PassKind Kind>() -> std::unique_ptr<PairPass<Dim>> {
      constexpr PassKind bonded{Kind.stress, Kind.gradient, Kind.tensor, Kind.coupled, Kind.stress};
      if (Kind.stress && s.bonded) return std::make_unique<PairPassOf<T, Dim, bonded, K>>(s);
      return std::make_unique<PairPassOf<T, Dim, Kind, K>>(s);
    };
    constexpr bool stress = true, gradient = true, tensor = true, coupled = true;
    if (s.coupled && s.tensor) return of.template operator()<PassKind{stress, gradient, tensor, coupled}>();
    if (s.coupled) return of.template operator()<PassKind{stress, gradient, !tensor, coupled}>();
    if (s.stress) return of.template operator()<PassKind{stress, gradient, tensor}>();
    return of.template operator()<PassKind{!stress, gradient, tensor}>();
  };
  return s.precision == Precision::mixed ? of_precision(float{}) : of_precision(double{});
}

}  // namespace ejecta
