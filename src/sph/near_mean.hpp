#pragma once
#include "particles/particles.hpp"

namespace ejecta {

/// Mean pressure over the particles within their smoothing length of a point, by their volumes and a weight that falls
/// to zero there (Shepard 1968).
template <int Dim>
class NearMean {
 public:
  NearMean(const Particles<Dim>& particles, const Vec<Dim>& x) : p_(particles), x_(x) {}
  void add(std::size_t i) {
    const double q = (p_.vector(Field::position, i) - x_).norm() / p_.column(Field::smoothing_length)[i];
    if (q >= 1) return;
    const double weight = (1 - q) * (1 - q) * (1 + 2 * q) * p_.column(Field::mass)[i] / p_.column(Field::density)[i];
    sum_ += weight * p_.column(Field::pressure)[i];
    weights_ += weight;
  }
  /// Pa; `otherwise` if no particle is near.
  double pressure(double otherwise) const { return weights_ > 0 ? sum_ / weights_ : otherwise; }

 private:
  const Particles<Dim>& p_;
  Vec<Dim> x_;
  double sum_ = 0, weights_ = 0;
};

}  // namespace ejecta
