#include "material/tensor_damage.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace ejecta {

template <int Dim>
Mat<Dim> rotation(const Mat<Dim>& gradient, double dt) {
  if constexpr (Dim == 2) {
    return Eigen::Rotation2Dd(0.5 * dt * (gradient(1, 0) - gradient(0, 1))).toRotationMatrix();
  } else {
    const Vec<3> turn =
        0.5 * dt *
        Vec<3>(gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0), gradient(1, 0) - gradient(0, 1));
    const double angle = turn.norm();
    if (angle == 0) return Mat<3>::Identity();
    return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  }
}

template <int Dim>
Mat<Dim> stress_strain(double pressure, const Deviator<Dim>& s, double young, double distension) {
  const Mat<Dim> stress =
      full_tensor<Dim>(s).template topLeftCorner<Dim, Dim>() - pressure * Mat<Dim>(Mat<Dim>::Identity());
  return distension / young * stress;
}

template <int Dim>
Mat<Dim> straining(CrackStrain choice, const Mat<Dim>& gradient) {
  const Mat<Dim> rate = 0.5 * (gradient + gradient.transpose());
  switch (choice) {
    case CrackStrain::benz_asphaug:
      break;
    case CrackStrain::pseudo_plastic:  // in plane strain too a third of the trace: the zz part is not stored
      return rate - rate.trace() / 3 * Mat<Dim>(Mat<Dim>::Identity());
    case CrackStrain::strain_history: {
      const Eigen::SelfAdjointEigenSolver<Mat<Dim>> eigen(rate);
      return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() * eigen.eigenvectors().transpose();
    }
  }
  return Mat<Dim>::Zero();
}

template <int Dim>
double damage_length(const Mat<Dim>& metric, const Vec<Dim>& normal) {
  const double section = metric.determinant() * normal.dot(metric.inverse() * normal);
  return Dim == 2 ? 1 / std::sqrt(section) : 1 / std::sqrt(std::sqrt(section));
}

template <int Dim>
void grow_cracks(Mat<Dim>& damage, const Mat<Dim>& before, const Mat<Dim>& after, const CrackGrowth<Dim>& growth,
                 double dt) {
  using Eigensystem = Eigen::SelfAdjointEigenSolver<Mat<Dim>>;
  // No eigenvalue is larger than the Frobenius norm: this spares most particles the solution.
  const double weakest = growth.cracks.weakest;
  if (!(std::max(before.squaredNorm(), after.squaredNorm()) >= weakest * weakest)) return;
  const Eigensystem strained(after);
  for (int k = Dim - 1; k >= 0; --k) {
    const Vec<Dim> n = strained.eigenvectors().col(k);
    const double from = n.dot(before * n), to = strained.eigenvalues()[k];
    if (!(std::max(from, to) >= weakest)) continue;
    // In the axes of D: n.D n and n.A n are then sums of what is positive, and their round-off cannot heal or exceed.
    const Eigensystem axes(damage);
    const Vec<Dim> d = axes.eigenvalues().cwiseMax(0).cwiseMin(1), a = Vec<Dim>::Ones() - d;
    const Vec<Dim> y = axes.eigenvectors().transpose() * n;
    const double broken = d.dot(y.cwiseAbs2()), intact = a.dot(y.cwiseAbs2());
    if (!(intact > 0)) continue;
    const double crack = crack_length(broken, growth.cracks.power);
    const double longer =
        longer_crack(crack, from, to, growth.cracks, dt * growth.crack_speed / damage_length<Dim>(growth.metric, n));
    if (!(longer > crack)) continue;
    const double lost = std::min((crack_damage(longer, growth.cracks.power) - broken) / intact, 1.0);
    const Vec<Dim> left = a.cwiseProduct(y);  // A n
    const Mat<Dim> grown = Mat<Dim>(d.asDiagonal()) + lost / intact * left * left.transpose();
    damage = turned<Dim>(grown, axes.eigenvectors());
  }
}

template <int Dim>
double largest_eigenvalue(const Mat<Dim>& tensor) {
  return Eigen::SelfAdjointEigenSolver<Mat<Dim>>(tensor, Eigen::EigenvaluesOnly).eigenvalues()[Dim - 1];
}

template Mat<2> rotation<2>(const Mat<2>&, double);
template Mat<3> rotation<3>(const Mat<3>&, double);
template Mat<2> stress_strain<2>(double, const Deviator<2>&, double, double);
template Mat<3> stress_strain<3>(double, const Deviator<3>&, double, double);
template Mat<2> straining<2>(CrackStrain, const Mat<2>&);
template Mat<3> straining<3>(CrackStrain, const Mat<3>&);
template double damage_length<2>(const Mat<2>&, const Vec<2>&);
template double damage_length<3>(const Mat<3>&, const Vec<3>&);
template void grow_cracks<2>(Mat<2>&, const Mat<2>&, const Mat<2>&, const CrackGrowth<2>&, double);
template void grow_cracks<3>(Mat<3>&, const Mat<3>&, const Mat<3>&, const CrackGrowth<3>&, double);
template double largest_eigenvalue<2>(const Mat<2>&);
template double largest_eigenvalue<3>(const Mat<3>&);

}  // namespace ejecta
