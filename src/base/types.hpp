#pragma once
/// Small fixed-size vectors and matrices used everywhere outside the vectorised pair loop.
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

namespace ejecta {

template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;
template <int Dim>
using Mat = Eigen::Matrix<double, Dim, Dim>;

/// Independent components of a traceless symmetric tensor: (xx, yy, xy) in plane strain, (xx, yy, xy, xz, yz) in 3D.
/// The last diagonal component is -(xx + yy) in both: in 2D it is the out-of-plane stress zz.
template <int Dim>
inline constexpr int deviator_size = Dim == 2 ? 3 : 5;

/// Half-open index range [begin, end).
struct Range {
  std::size_t begin = 0, end = 0;
  std::size_t size() const { return end - begin; }
};

}  // namespace ejecta
