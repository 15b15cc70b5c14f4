#include "schemes/pair_records_impl.hpp"
#include "schemes/riemann_flux.hpp"

namespace ejecta {

template struct PairRecord<double, 2, RecordKind{}, RiemannFlux>;
template struct PairRecord<double, 3, RecordKind{}, RiemannFlux>;
template struct PairRecord<double, 2, RecordKind{.asph = true}, RiemannFlux>;
template struct PairRecord<double, 3, RecordKind{.asph = true}, RiemannFlux>;

}  // namespace ejecta
