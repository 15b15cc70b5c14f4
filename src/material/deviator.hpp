#pragma once
/// Traceless symmetric tensors by their independent components (order: base/types.hpp), and what is asked of them.
/// In plane strain the third diagonal component zz = -(xx + yy) is part of every invariant.
#include <algorithm>
#include <cmath>

#include "base/types.hpp"

namespace ejecta {

template <int Dim>
using Deviator = Eigen::Matrix<double, deviator_size<Dim>, 1>;

/// The full 3 x 3 tensor.
template <int Dim>
Mat<3> full_tensor(const Deviator<Dim>& s) {
  Mat<3> m = Mat<3>::Zero();
  m(0, 0) = s[0];
  m(1, 1) = s[1];
  m(2, 2) = -(s[0] + s[1]);
  m(0, 1) = m(1, 0) = s[2];
  if constexpr (Dim == 3) {
    m(0, 2) = m(2, 0) = s[3];
    m(1, 2) = m(2, 1) = s[4];
  }
  return m;
}

/// J2 = s_ij s_ij / 2 [Pa^2].
template <int Dim>
double second_invariant(const Deviator<Dim>& s) {
  double j2 = s[0] * s[0] + s[1] * s[1] + s[0] * s[1] + s[2] * s[2];
  if constexpr (Dim == 3) j2 += s[3] * s[3] + s[4] * s[4];
  return j2;
}

/// Von Mises equivalent stress sqrt(3 J2) [Pa]: the uniaxial stress of the same J2.
template <int Dim>
double equivalent_stress(const Deviator<Dim>& s) {
  return std::sqrt(3 * second_invariant<Dim>(s));
}

/// Largest eigenvalue of sigma = -P I + S [Pa], tension positive; in plane strain the out-of-plane stress competes too.
/// 3D: trigonometric solution of the characteristic cubic (Smith 1961, Comm. ACM 4, 168), scaled so that no power of
/// the stress can over- or underflow. Absolute error below 1e-7 sqrt(J2), reached where the two largest eigenvalues
/// meet.
template <int Dim>
double largest_principal_stress(double pressure, const Deviator<Dim>& s) {
  if constexpr (Dim == 2) {
    const double mean = 0.5 * (s[0] + s[1]), in_plane = mean + std::hypot(0.5 * (s[0] - s[1]), s[2]);
    return std::max(in_plane, -2 * mean) - pressure;
  } else {
    const double scale = std::sqrt(second_invariant<3>(s) / 3);
    if (scale < 1e-100) return -pressure;
    const Deviator<3> n = s / scale;
    const double zz = -(n[0] + n[1]);
    const double half_det = 0.5 * (n[0] * (n[1] * zz - n[4] * n[4]) - n[2] * (n[2] * zz - n[4] * n[3]) +
                                   n[3] * (n[2] * n[4] - n[1] * n[3]));
    return 2 * scale * std::cos(std::acos(std::clamp(half_det, -1.0, 1.0)) / 3) - pressure;
  }
}

}  // namespace ejecta
