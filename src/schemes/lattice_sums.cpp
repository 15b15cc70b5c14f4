#include "schemes/lattice_sums.hpp"

#include <cmath>

#include "schemes/kernels.hpp"

namespace ejecta {

LatticeSums lattice_sums(Kernel kernel, int dim, double nodes_per_h) {
  return with_kernel(kernel, [&](auto k) {
    using K = decltype(k);
    const int reach = static_cast<int>(K::support * nodes_per_h), deep = dim == 3 ? reach : 0;
    LatticeSums sums{K::value(0.0), 0};
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j)
        for (int l = -deep; l <= deep; ++l) {
          const double q = std::sqrt(static_cast<double>(i * i + j * j + l * l)) / nodes_per_h;
          if (q == 0 || q >= K::support) continue;
          sums.density += K::value(q);
          sums.gradient -= q * q * K::slope_over_q(q, 1 / q) / dim;
        }
    const double scale = (dim == 2 ? K::template norm<2> : K::template norm<3>) / std::pow(nodes_per_h, dim);
    return LatticeSums{scale * sums.density, scale * sums.gradient};
  });
}

}  // namespace ejecta
