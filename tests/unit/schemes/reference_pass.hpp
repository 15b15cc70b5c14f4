#pragma once
/// The pair sums of pair_pass.hpp as plain loops over all pairs, written from the formulas alone.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "schemes/cracked_stress.hpp"
#include "schemes/hourglass.hpp"
#include "schemes/kernels.hpp"
#include "unit/schemes/random_matter.hpp"

namespace ejecta {

/// Sums of one particle, and of the magnitudes of their terms: round-off is measured against those.
template <int Dim>
struct Sums {
  Vec<Dim> acceleration = Vec<Dim>::Zero();
  double heating = 0, moment = 0, approach = 0, density = 0, stretch = 1;
  Mat<Dim> gradient = Mat<Dim>::Zero(), uncut_gradient = Mat<Dim>::Zero();
  double acceleration_scale = 0, heating_scale = 0, gradient_scale = 0;
};

/// S of particle i; intact_share scales it, cracks cut it.
template <int Dim>
Mat<Dim> deviator_of(const Particles<Dim>& p, bool cracked, std::size_t i) {
  Mat<Dim> s = Mat<Dim>::Zero();
  if (p.has(Field::deviatoric_stress)) {
    const auto d = [&](int k) {
      return (p.has(Field::intact_share) ? p.column(Field::intact_share)[i] : 1) *
             p.column(Field::deviatoric_stress, k)[i];
    };
    if constexpr (Dim == 2)
      s << d(0), d(2), d(2), d(1);
    else
      s << d(0), d(2), d(3), d(2), d(1), d(4), d(3), d(4), -d(0) - d(1);
  }
  return cracked ? transmitted<Dim>(s, p.symmetric(Field::damage_tensor, i)) : s;
}

/// A kernel by its functions.
struct KernelFunctions {
  double support, norm;
  double (*value)(double);
  double (*slope)(double);  ///< of the value
};
inline KernelFunctions functions_of(Kernel kernel, int dim) {
  return with_kernel(kernel, [&](auto k) {
    using K = decltype(k);
    return KernelFunctions{K::support, dim == 2 ? K::template norm<2> : K::template norm<3>,
                           [](double q) { return q < K::support ? K::value(q) : 0.0; },
                           [](double q) { return q > 0 && q < K::support ? q * K::slope_over_q(q, 1 / q) : 0.0; }};
  });
}

/// P and Q of gradient_correction.hpp, always by the singular values.
template <int Dim>
struct Inverse {
  Mat<Dim> P = Mat<Dim>::Identity(), Q = Mat<Dim>::Identity();
  /// squares: sum of |H^-1 V_j grad W|^2.
  static Inverse of(const Mat<Dim>& M, double squares) {
    const double least = std::max(least_moment, std::sqrt(squares) / most_stiffness);
    const auto svd = svd_of<Dim>(M);
    const Vec<Dim> p = (svd.singularValues() / least).cwiseMin(1);
    const Vec<Dim> q = svd.singularValues().cwiseMax(least).cwiseInverse();
    const Mat<Dim>&U = svd.matrixU(), &V = svd.matrixV();
    return {U * p.asDiagonal() * U.transpose(), U * q.asDiagonal() * V.transpose()};
  }
};

/// What a particle of the reference copies, if it is an image: the components of its vectors along a face that mirrors
/// it have changed sign, and behind a wall it belongs to the wall.
template <int Dim>
struct Copy {
  std::size_t source;
  Vec<Dim> sign = Vec<Dim>::Ones();
  bool behind_wall = false;
};

template <int Dim>
class Reference {
 public:
  /// The first particles are those asked for; the others may be copies of them.
  Reference(const Particles<Dim>& particles, const PairPassSettings& settings, std::vector<Copy<Dim>> copies = {})
      : p_(particles),
        settings_(settings),
        kernel_(functions_of(settings.kernel, Dim)),
        copies_(std::move(copies)),
        views_(particles.size()) {
    look_around();
  }

  Sums<Dim> rates(std::size_t i) const {
    Sums<Dim> sums;
    const View& own = views_[i];
    const double rho = column(Field::density, i), c = column(Field::sound_speed, i),
                 h = column(Field::smoothing_length, i);
    Mat<Dim> R = Mat<Dim>::Zero(), others = R, uncut = R, of_contact = R;
    for (std::size_t j = 0; j < p_.size(); ++j) {
      const Pair q = pair(i, j);
      const View& other = views_[j];
      sums.moment -= kernel_.slope(q.eta_i);
      sums.density += column(Field::mass, j) * kernel_.norm * own.H.determinant() * kernel_.value(q.eta_i);
      sums.stretch = std::max(sums.stretch, q.stretch);
      if (q.r == 0) continue;

      double closing = q.v.dot(q.x),
             f = 0.5 * (column(Field::viscosity_factor, i) + column(Field::viscosity_factor, j));
      closing -= smooth_closing(i, j, q.x, closing);
      const double c_j = column(Field::sound_speed, j), rho_j = column(Field::density, j);
      Vec<Dim> n = own.normal - other.normal;
      if (!q.own) {
        closing = q.v.dot(q.x);
        if (n.squaredNorm() > 0.01) {
          const double gap = q.v.dot(n) * q.x.dot(n) / n.squaredNorm();
          closing = gap + std::abs(closing - gap);
        }
        f = contact_of_pair(i, j) * std::min(1.0, 4 * std::min(c, c_j) / (c + c_j));
      }
      const double mean_h = 0.5 * (h + column(Field::smoothing_length, j));
      const double mu = std::min(0.0, closing) * (settings_.asph ? q.eta / (q.eta * q.eta + 0.01) / q.r
                                                                 : mean_h / (q.r * q.r + 0.01 * mean_h * mean_h));
      const double mean_rho = 2 / (1 / rho + 1 / rho_j);
      const double viscosity =
          f * mean_rho * (-settings_.viscosity_alpha * 0.5 * (c + c_j) * mu + settings_.viscosity_beta * mu * mu);
      const Vec<Dim> drag = viscosity * (settings_.stress ? Vec<Dim>(q.central * q.x) : q.g);
      const Vec<Dim> spring = hourglass(own, other, q) * q.central / (own.r * other.r) * q.x;
      if (q.eta_i < kernel_.support) sums.approach = std::max(sums.approach, -mu);

      // V_i w_ij and V_j w_ji, relative to V_i V_j.
      const double ours_share = weight(i, j) / other.V, theirs_share = weight(j, i) / own.V;
      const double cut = q.own ? cut_share(i, j, q.x) : 0;
      const Mat<Dim> ours =
                         q.own ? Mat<Dim>(ours_share * (own.own - cut * own.shear)) : Mat<Dim>(share(i, j) * own.press),
                     theirs = q.own ? Mat<Dim>(theirs_share * (other.own - cut * other.shear))
                                    : Mat<Dim>(share(j, i) * other.press);
      Vec<Dim> force = (ours + theirs) * q.g - drag - spring;
      double heat = q.v.dot(ours * q.g) - 0.5 * q.v.dot(drag + spring);
      if (!q.own && settings_.friction > 0 && n.norm() > 0) {
        n.normalize();
        // A wall rests: the image of what slides to the right slides to the left.
        Vec<Dim> slide = q.v;
        if (other.piece == wall) slide = -p_.vector(Field::velocity, j) - p_.vector(Field::velocity, i);
        slide -= slide.dot(n) * n;
        const double push = std::max(0.0, -force.dot(n));
        const Vec<Dim> rub =
            std::min(settings_.friction * push, std::min(own.Z, other.Z) * slide.norm() * q.central * q.r) *
            slide.normalized();
        force += rub;
        heat += 0.5 * rub.dot(slide);
      }
      sums.acceleration += other.V / rho * force;
      sums.heating += other.V / rho * heat;
      const double gradient_weight = q.own ? weight(i, j) : other.V, strain = other.V * q.v.norm() * q.g.norm();
      sums.acceleration_scale +=
          other.V / rho * ((ours.norm() + theirs.norm()) * q.g.norm() + drag.norm() + spring.norm());
      sums.heating_scale +=
          (ours.norm() + theirs.norm()) / rho * strain + other.V / rho * (drag + spring).norm() * q.v.norm();
      sums.gradient_scale += gradient_weight * q.v.norm() * q.g.norm();

      const Mat<Dim> add = gradient_weight * q.v * q.g.transpose();
      if (!q.own) {
        others += share(i, j) * add;
        continue;
      }
      R += add;
      uncut += (1 - cut) * add;
    }
    const auto corrected = [](const Inverse<Dim>& k, const Mat<Dim>& raw) { return k.P * raw * k.Q.transpose(); };
    sums.gradient = corrected(inverse(own.moment, own.squares), R);
    if (!own.others.isZero(0)) {
      const Mat<Dim> both =
          corrected(inverse(own.moment + own.others, own.squares + own.squares_of_others), R + others);
      const double opening = own.normal.dot((both - sums.gradient) * own.normal);
      if (opening < 0 || !own.press.isZero(0)) of_contact = opening * own.normal * own.normal.transpose();
    }
    sums.gradient += of_contact;
    sums.uncut_gradient = corrected(uncut_inverse(own), uncut) + of_contact;
    return sums;
  }

  /// The stress that acts on other pieces.
  const Mat<Dim>& press(std::size_t i) const { return views_[i].press; }

 private:
  /// What partners see of a particle.
  struct View {
    Mat<Dim> G, H, L, own, press = Mat<Dim>::Zero(), moment = Mat<Dim>::Zero(), others = Mat<Dim>::Zero(),
                           cut = Mat<Dim>::Zero(), shear = Mat<Dim>::Zero();
    Vec<Dim> normal = Vec<Dim>::Zero();
    double squares = 0, squares_of_others = 0;
    double V, r, Z, contact = 0;  ///< r: rho0/rho
    Mat<Dim> F = Mat<Dim>::Zero();
    double k = 0;  ///< of the springs of its bonds
    int piece = 0;
  };
  struct Pair {
    Vec<Dim> x, v, g, X;  ///< x_j - x_i, v_j - v_i, grad_i W, x_j - x_i at the start
    double r, central, eta_i, eta, stretch;
    bool own, bonded = false;
  };

  double column(Field f, std::size_t i) const { return p_.column(f)[i]; }
  std::size_t source(std::size_t i) const { return i < copies_.size() ? copies_[i].source : i; }
  /// grad_i W with the smoothing of particle k alone.
  Vec<Dim> one_sided(std::size_t k, const Vec<Dim>& y, double& eta) const {
    eta = (views_[k].H * y).norm();
    if (eta == 0) return Vec<Dim>::Zero();
    return -kernel_.norm * views_[k].H.determinant() * kernel_.slope(eta) / eta * (views_[k].G * y);
  }

  Pair pair(std::size_t i, std::size_t j) const {
    Pair q;
    q.x = p_.vector(Field::position, j) - p_.vector(Field::position, i);
    q.v = p_.vector(Field::velocity, j) - p_.vector(Field::velocity, i);
    q.r = q.x.norm();
    q.own = views_[i].piece == views_[j].piece;
    Vec<Dim> y = q.x;
    q.stretch = 1;
    if (settings_.bonded && q.own && column(Field::bond, i) > 0 && column(Field::bond, j) > 0) {
      const Vec<Dim> start = p_.vector(Field::start_position, j) - p_.vector(Field::start_position, i);
      q.own =
          start.norm() <= kernel_.support * (column(Field::smoothing_length, i) + column(Field::smoothing_length, j));
      if (q.own) y = start;
      q.bonded = q.own;
    }
    q.X = y;

    double eta_j;
    q.g = 0.5 * (one_sided(i, y, q.eta_i) + one_sided(j, y, eta_j));
    q.eta = 0.5 * (q.eta_i + eta_j);
    // Of a bond the kernel sees the separation at the start, and the viscosity acts along the present one.
    q.central = y.norm() > 0 ? y.dot(q.g) / y.squaredNorm() : 0;
    if (q.g.norm() > 0) q.stretch = std::max(1.0, q.r / y.norm());
    return q;
  }

  void look_around() {
    const std::size_t all = p_.size();
    const std::vector<int>& pieces = settings_.rules.pieces;
    for (std::size_t i = 0; i < all; ++i) {
      View& view = views_[i];
      const double h = column(Field::smoothing_length, i);
      view.H = Mat<Dim>::Identity() / h;
      if (settings_.asph)
        view.H = Eigen::SelfAdjointEigenSolver<Mat<Dim>>(p_.symmetric(Field::smoothing_metric, i)).operatorSqrt();
      view.G = view.H * view.H;
      const Mat<Dim> L = strained() ? p_.tensor(Field::velocity_gradient, source(i)) : Mat<Dim>(Mat<Dim>::Zero());
      view.L = i < copies_.size() ? Mat<Dim>(copies_[i].sign.asDiagonal() * L * copies_[i].sign.asDiagonal()) : L;
      view.V = column(Field::mass, i) / column(Field::density, i);
      const auto material = static_cast<std::size_t>(p_.label(Label::material)[i]);
      view.r = settings_.rules.reference_density.at(material) / column(Field::density, i);
      view.Z = column(Field::density, i) * column(Field::sound_speed, i);
      if (!pieces.empty()) view.piece = pieces[static_cast<std::size_t>(p_.label(Label::body)[i])];
      if (i < copies_.size() && copies_[i].behind_wall && view.piece != 0) view.piece = wall;
    }
    for (std::size_t i = 0; settings_.contacts && i < all; ++i)
      if (source(i) == i) feel(i);
    from_sources([](View& view, const View& of, const Vec<Dim>& sign) {
      view.contact = of.contact;
      view.normal = sign.cwiseProduct(of.normal);
    });
    for (std::size_t i = 0; i < all; ++i) {
      if (source(i) != i) continue;
      View& view = views_[i];
      for (std::size_t j = 0; j < all; ++j) {
        const Pair q = pair(i, j);
        if (q.own) {
          view.moment += weight(i, j) * q.x * q.g.transpose();
          if (q.r > 0) view.cut += cut_share(i, j, q.x) * weight(i, j) * q.x * q.g.transpose();
        } else
          view.others += share(i, j) * views_[j].V * q.x * q.g.transpose();
        const Vec<Dim> scaled = (q.own ? weight(i, j) : share(i, j) * views_[j].V) * view.H.inverse() * q.g;
        (q.own ? view.squares : view.squares_of_others) += scaled.squaredNorm();
      }
      if (settings_.bonded) deform(i);
      const Mat<Dim> S = deviator_of(p_, settings_.cracked, i),
                     sigma = S - column(Field::pressure, i) * Mat<Dim>::Identity();
      const Inverse<Dim> own = inverse(view.moment, view.squares),
                         both = inverse(view.moment + view.others, view.squares + view.squares_of_others);
      const Vec<Dim>& n = view.normal;
      const Mat<Dim> passed = std::min(0.0, n.dot(sigma * n)) * n * n.transpose();
      if (!view.others.isZero(0)) view.press = both.P * passed * both.Q;
      view.own = own.P * (view.others.isZero(0) ? sigma : Mat<Dim>(sigma - passed)) * own.Q + view.press;
      const Inverse<Dim> uncut = uncut_inverse(view);
      view.shear = uncut.P * S * uncut.Q;
      view.own += view.shear - own.P * S * own.Q;
    }
    from_sources([](View& view, const View& of, const Vec<Dim>& sign) {
      view.own = sign.asDiagonal() * of.own * sign.asDiagonal();
      view.press = sign.asDiagonal() * of.press * sign.asDiagonal();
      view.shear = sign.asDiagonal() * of.shear * sign.asDiagonal();
    });
  }
  /// What a bonded particle takes for its deformation since the start.
  void deform(std::size_t i) {
    View& view = views_[i];
    Mat<Dim> at_the_start = Mat<Dim>::Zero();
    for (std::size_t j = 0; j < p_.size(); ++j) {
      const Pair q = pair(i, j);
      if (q.own) at_the_start += weight(i, j) * q.X * q.g.transpose();
    }
    const Inverse<Dim> start = Inverse<Dim>::of(at_the_start, view.squares);
    if (!start.P.isIdentity(1e-12)) return;
    view.F = view.moment * at_the_start.inverse();
    view.k = hourglass_stiffness * view.Z * view.Z / column(Field::density, i);
  }
  /// Pressure of the springs of hourglass.hpp.
  static double hourglass(const View& i, const View& j, const Pair& q) {
    const auto one = [&](const View& view) {
      const double off = q.x.dot(view.F * q.X) / (q.r * q.r) - 1;
      return view.k * (off - std::clamp(off, -hourglass_onset, hourglass_onset));
    };
    return q.bonded ? 0.5 * (one(i) + one(j)) : 0;
  }
  template <class Take>
  void from_sources(Take&& take) {
    for (std::size_t i = 0; i < copies_.size(); ++i)
      if (source(i) != i) take(views_[i], views_[source(i)], copies_[i].sign);
  }
  /// The share of a pair that the cracks of either side cut off.
  double cut_share(std::size_t i, std::size_t j, const Vec<Dim>& x) const {
    if (!settings_.cracked) return 0;
    const Vec<Dim> n = x.normalized();
    return std::max(n.dot(p_.symmetric(Field::damage_tensor, i) * n), n.dot(p_.symmetric(Field::damage_tensor, j) * n));
  }
  Inverse<Dim> uncut_inverse(const View& view) const {
    return view.cut.isZero(0) ? inverse(view.moment, view.squares)
                              : Inverse<Dim>::of(view.moment - view.cut, view.squares);
  }
  Inverse<Dim> inverse(const Mat<Dim>& M, double squares) const {
    return settings_.gradient_correction ? Inverse<Dim>::of(M, squares) : Inverse<Dim>{};
  }

  /// Where other pieces are, and how near.
  void feel(std::size_t i) {
    Vec<Dim> outward = Vec<Dim>::Zero();
    double occupied = 0;
    for (std::size_t j = 0; j < p_.size(); ++j) {
      const Pair q = pair(i, j);
      if (q.own || q.g.isZero(0)) continue;
      outward += views_[j].V * q.g;
      occupied += views_[j].V * kernel_.norm * views_[i].H.determinant() * kernel_.value(q.eta_i);
    }
    if (occupied == 0) return;
    const double size = settings_.rules.sizes[static_cast<std::size_t>(p_.label(Label::body)[i])];
    const HalfSpace half_space = with_kernel(settings_.kernel, [](auto kernel) { return HalfSpace(kernel, Dim); });
    const double half_size_away = half_space(0.5 * size / column(Field::smoothing_length, i));
    views_[i].contact = std::clamp((occupied / half_size_away - 1) / 0.02, 0.0, 1.0);
    views_[i].normal = outward.normalized();
  }
  bool strained() const { return p_.has(Field::velocity_gradient) && p_.has(Field::shock_switch); }
  /// What of a closing of the pair, v.x, the viscosity leaves alone: the smooth part, where there is no shock.
  double smooth_closing(std::size_t i, std::size_t j, const Vec<Dim>& x, double closing) const {
    if (!strained() || closing >= 0) return 0;
    const double a = x.dot(views_[i].L * x), b = x.dot(views_[j].L * x);
    if (a >= 0 || b >= 0) return 0;
    const double mean = 2 / (1 / a + 1 / b), off = std::abs(mean - closing) / (0.3 * std::abs(closing));
    const double calm = 1 - 0.5 * (column(Field::shock_switch, i) + column(Field::shock_switch, j));
    return calm * mean * std::clamp(2 - off, 0.0, 1.0);
  }
  /// w_ij of neighbours, V0_j r_i s_ij with V0 = V/r: from s = 1 to the ratio of volumes as r_i/r_j + r_j/r_i goes from
  /// `alike` to four times that.
  double weight(std::size_t i, std::size_t j) const {
    const double ratio = views_[j].r / views_[i].r, differ = ratio + 1 / ratio;
    const double volumes = std::clamp((differ / settings_.alike - 1) / 3, 0.0, 1.0);
    return views_[j].V / views_[j].r * views_[i].r * (1 + volumes * (ratio - 1));
  }
  double contact_of_pair(std::size_t i, std::size_t j) const { return std::max(views_[i].contact, views_[j].contact); }
  /// Share of i in a contact with j: the softer of two decides.
  double share(std::size_t i, std::size_t j) const {
    return contact_of_pair(i, j) * 2 * views_[j].Z / (views_[i].Z + views_[j].Z);
  }

  const Particles<Dim>& p_;
  PairPassSettings settings_;
  KernelFunctions kernel_;
  std::vector<Copy<Dim>> copies_;
  std::vector<View> views_;
};

}  // namespace ejecta
