#include "schemes/pair_pass_kinds.hpp"

namespace ejecta {
template std::unique_ptr<PairPass<2>> make_isotropic_pass_of<2, QuinticSpline>(const PairPassSettings&);
}  // namespace ejecta
