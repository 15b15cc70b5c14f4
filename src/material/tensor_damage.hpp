#pragma once
/// Damage with a direction: a symmetric tensor D, n.D n the damage across the normal n, eigenvalues 0 to 1. Cracks open
/// across the directions of positive effective strain (Owen 2010, section III; Weibull flaws and growth: damage.hpp).
/// In plane strain D lies in the plane: cracks normal to the plane cannot be told apart from none.
#include "base/types.hpp"
#include "material/damage.hpp"
#include "material/deviator.hpp"

namespace ejecta {

/// The rotation exp(W dt) of matter in a time dt [s], W the antisymmetric part of the velocity gradient dv_a/dx_b
/// [1/s]: exactly orthogonal, so that a turned tensor keeps its eigenvalues; exact for a steady spin.
template <int Dim>
Mat<Dim> rotation(const Mat<Dim>& gradient, double dt);

/// Q T Q^T: a symmetric tensor carried along by the rotation Q.
template <int Dim>
Mat<Dim> turned(const Mat<Dim>& tensor, const Mat<Dim>& q) {
  const Mat<Dim> t = q * tensor * q.transpose();
  return 0.5 * (t + t.transpose());
}

/// Strain that opens flaws by the stress of the undamaged solid: alpha (S - P I)/E (Benz & Asphaug 1995, with all
/// directions in place of the largest). For alpha see local_strain().
template <int Dim>
Mat<Dim> stress_strain(double pressure, const Deviator<Dim>& s, double young, double distension);

/// Rate of the strain that a memory choice accumulates [1/s], in a frame that turns with the matter.
///   pseudo_plastic: deviator of the rate of deformation, dev(sym L): what Hooke's law S = 2 G e makes of the elastic
///                   predictor of S, without the return to the yield surface. (Divided by G instead of 2 G, as some
///                   codes have it, the strain is twice as large; flaws k eps^m of such a code are k 2^m here.)
///   strain_history: positive part of sym L: stretching accumulates, what is pressed together later heals nothing.
/// Zero for benz_asphaug, which has no memory.
template <int Dim>
Mat<Dim> straining(CrackStrain choice, const Mat<Dim>& gradient);

/// Radius [m] of the region that a crack of normal n relieves: the geometric mean of the semi-axes of the section of
/// the smoothing ellipsoid x.G x = 1 normal to n, (det(G) n.G^-1 n)^(-1/(2 (Dim - 1))); h for G = I/h^2.
template <int Dim>
double damage_length(const Mat<Dim>& metric, const Vec<Dim>& normal);

/// What a particle's cracks depend on.
template <int Dim>
struct CrackGrowth {
  OpenCracks cracks;
  double crack_speed;  ///< m/s
  Mat<Dim> metric;     ///< G [1/m^2]
};

/// Lets the cracks of `damage` grow for a time dt [s], in which the strain goes from `before` to `after`, across every
/// eigenvector n of `after`, largest strain first: from D0 = n.D n to D1 >= D0 by longer_crack() with R(n).
/// The intact part A = I - D loses its share across n,
///   A <- A - (D1 - D0)/(1 - D0) A n (A n)^T/(n.A n),
/// which is D <- D + (D1 - D0) n n^T if n is an eigenvector of D. Added for any other n, n n^T would carry eigenvalues
/// beyond 1, and cutting them off would heal the cracks that were open; this form is A^(1/2) (I - g p p^T) A^(1/2) with
/// |p| = 1 and 0 <= g <= 1, so that 0 <= A <= its old value: eigenvalues stay in 0..1 and nothing heals.
template <int Dim>
void grow_cracks(Mat<Dim>& damage, const Mat<Dim>& before, const Mat<Dim>& after, const CrackGrowth<Dim>& growth,
                 double dt);

/// Largest eigenvalue of a symmetric tensor.
template <int Dim>
double largest_eigenvalue(const Mat<Dim>& tensor);

}  // namespace ejecta
