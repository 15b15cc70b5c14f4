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

/// Independent components of a symmetric tensor, diagonal first: (xx, yy, xy) in 2D, (xx, yy, zz, xy, xz, yz) in 3D.
template <int Dim>
inline constexpr int symmetric_size = Dim*(Dim + 1) / 2;
template <int Dim>
using Symmetric = Eigen::Matrix<double, symmetric_size<Dim>, 1>;

template <int Dim>
Mat<Dim> matrix_of(const Symmetric<Dim>& s) {
  Mat<Dim> m;
  if constexpr (Dim == 2)
    m << s[0], s[2], s[2], s[1];
  else
    m << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
  return m;
}
template <int Dim>
Symmetric<Dim> symmetric_of(const Mat<Dim>& m) {
  Symmetric<Dim> s;
  if constexpr (Dim == 2)
    s << m(0, 0), m(1, 1), m(0, 1);
  else
    s << m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2);
  return s;
}

/// Half-open index range [begin, end).
struct Range {
  std::size_t begin = 0, end = 0;
  std::size_t size() const { return end - begin; }
};

}  // namespace ejecta
