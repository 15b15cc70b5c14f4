#pragma once
/// The passes of one kernel with Godunov fluxes. Included only by the sources that EjectaPairPasses.cmake makes.
#include "schemes/pair_fluxes.hpp"
#include "schemes/pair_pass_impl.hpp"
#include "schemes/riemann_flux.hpp"

namespace ejecta {

/// With smoothing lengths or tensors, in double precision.
template <int Dim, class K>
std::unique_ptr<PairPass<Dim>> make_riemann_pass_of(const PairPassSettings& s) {
  constexpr PassKind lengths{}, tensors{.asph = true};
  if (s.asph) return std::make_unique<PairPassOf<double, Dim, tensors, K, RiemannFlux>>(s);
  return std::make_unique<PairPassOf<double, Dim, lengths, K, RiemannFlux>>(s);
}

}  // namespace ejecta
