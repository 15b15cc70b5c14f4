#include "schemes/monaghan_viscosity.hpp"
#include "schemes/pair_records_impl.hpp"

namespace ejecta {

double power_of_two_below(double length) { return std::ldexp(1.0, std::ilogb(length)); }

// stress, asph, cracked, bonded, strained
#define EJECTA_RECORDS(T, DIM)                                                                         \
  template struct PairRecord<T, DIM, RecordKind{}, MonaghanViscosity>;                                 \
  template struct PairRecord<T, DIM, RecordKind{false, false, false, false, true}, MonaghanViscosity>; \
  template struct PairRecord<T, DIM, RecordKind{false, true, false, false, true}, MonaghanViscosity>;  \
  template struct PairRecord<T, DIM, RecordKind{true, false, false, false, true}, MonaghanViscosity>;  \
  template struct PairRecord<T, DIM, RecordKind{true, true, false, false, true}, MonaghanViscosity>;   \
  template struct PairRecord<T, DIM, RecordKind{true, false, true, false, true}, MonaghanViscosity>;   \
  template struct PairRecord<T, DIM, RecordKind{true, true, true, false, true}, MonaghanViscosity>;    \
  template struct PairRecord<T, DIM, RecordKind{true, false, false, true, true}, MonaghanViscosity>;   \
  template struct PairRecord<T, DIM, RecordKind{true, true, false, true, true}, MonaghanViscosity>;    \
  template struct PairRecord<T, DIM, RecordKind{true, false, true, true, true}, MonaghanViscosity>;    \
  template struct PairRecord<T, DIM, RecordKind{true, true, true, true, true}, MonaghanViscosity>;
EJECTA_RECORDS(double, 2)
EJECTA_RECORDS(double, 3)
EJECTA_RECORDS(float, 2)
EJECTA_RECORDS(float, 3)
#undef EJECTA_RECORDS

}  // namespace ejecta
