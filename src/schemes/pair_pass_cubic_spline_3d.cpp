#include "schemes/pair_pass_kinds.hpp"

namespace ejecta {
template std::unique_ptr<PairPass<3>> make_isotropic_pass_of<3, CubicSpline>(const PairPassSettings&);
}  // namespace ejecta
