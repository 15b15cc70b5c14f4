#pragma once
/// How the records of a pass are filled. Included only where they are instantiated for a flux.
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "schemes/columns.hpp"
#include "schemes/cracked_stress.hpp"
#include "schemes/gradient_correction.hpp"
#include "schemes/pair_records.hpp"

namespace ejecta {

namespace record_detail {

template <int Dim>
double power(double a) {
  return Dim == 2 ? a * a : a * a * a;
}

template <class T, class R>
void set_position(T* record, int place, int low, double x) {
  record[place] = static_cast<T>(x);
  if constexpr (R::split) record[low] = static_cast<T>(x - static_cast<double>(record[place]));
}

/// D of a particle; 0 where its material is not cut by cracks.
template <int Dim>
Symmetric<Dim> cracks_of(const Particles<Dim>& particles, const Columns<Dim, const double>& damage,
                         const PairRules& rules, std::size_t i) {
  Symmetric<Dim> cracks = Symmetric<Dim>::Zero();
  if (rules.cut_by_cracks[static_cast<std::size_t>(particles.label(Label::material)[i])])
    for (std::size_t k = 0; k < damage.count; ++k) cracks[static_cast<int>(k)] = damage(k, i);
  return cracks;
}

/// Mirrors at a face normal to `axis` what pack() fills in.
template <class T, class R, int Dim, RecordKind Kind>
void mirror(T* record, int axis) {
  record[R::v + axis] = -record[R::v + axis];
  if constexpr (Kind.asph) mirror_symmetric<Dim>(record + R::metric, axis);
  if constexpr (Kind.cracked) mirror_symmetric<Dim>(record + R::damage, axis);
  R::FluxRecord::mirror(record + R::flux, axis);
}

/// The same of a tensor stored row by row.
template <int Dim, class T>
void mirror_tensor(T* tensor, int axis) {
  for (int other = 0; other < Dim; ++other) {
    if (other == axis) continue;
    tensor[axis * Dim + other] *= -1;
    tensor[other * Dim + axis] *= -1;
  }
}

/// How far a particle is in contact with other pieces: from where it is half its size from their surface. Contact sets
/// in over `onset` of that: in a collision at speed v bodies come nearer by v/c particle sizes only, and a viscosity
/// that acted on the way there would take the energy that the rebound needs.
inline double contact_of(double occupied, const HalfSpace& filled, double size, double h) {
  constexpr double onset = 0.02;
  return occupied > 0 ? std::clamp((occupied / filled(0.5 * size / h) - 1) / onset, 0.0, 1.0) : 0;
}

/// The stress that acts on own neighbours, on other pieces, and of the first the part that passes no crack.
template <int Dim>
struct ActingStress {
  Mat<Dim> own, others, shear;
};
/// Of sigma = -P I + S. What is behind a crack strains the particle by its volume alone, so S acts on what is not: by
/// the adjoint of that gradient, or it would do work again and again without ever giving way.
template <int Dim>
ActingStress<Dim> corrected(double pressure, const Mat<Dim>& S, const Surroundings<Dim>& around, std::size_t i) {
  const auto& sums = around.sums[i];
  const GradientCorrection<Dim> own = around.own(sums);
  const Mat<Dim> sigma = S - pressure * Mat<Dim>::Identity();
  const ContactStress<Dim> whole = sums.contact.isZero(0)
                                       ? ContactStress<Dim>{own.stress(sigma), Mat<Dim>::Zero()}
                                       : contact_stress<Dim>(sigma, sums.normal(), own, around.all(sums));
  if (around.cut.empty()) return {whole.own, whole.others, Mat<Dim>::Zero()};
  const Mat<Dim> shear = around.uncut(i).stress(S);
  return {whole.own + (shear - own.stress(S)), whole.others, shear};
}

/// P and S of a particle, as its cracks let it through.
template <int Dim, RecordKind Kind>
class StressOf {
 public:
  StressOf(const Particles<Dim>& particles, const PairRules& rules)
      : particles_(particles),
        rules_(rules),
        pressure_(particles.column(Field::pressure)),
        deviator_(particles, Field::deviatoric_stress),
        damage_(particles, Field::damage_tensor),
        intact_share_(particles, Field::intact_share) {}

  double pressure(std::size_t i) const { return pressure_[i]; }
  Mat<Dim> deviator(std::size_t i) const {
    const double scale = intact_share_.count ? intact_share_(0, i) : 1.0;
    auto component = [&](std::size_t k) { return scale * deviator_(k, i); };
    Symmetric<Dim> s = Symmetric<Dim>::Zero();
    if (deviator_.count) {
      if constexpr (Dim == 2)
        s << component(0), component(1), component(2);
      else
        s << component(0), component(1), -component(0) - component(1), component(2), component(3), component(4);
    }
    const Mat<Dim> S = matrix_of<Dim>(s);
    if constexpr (Kind.cracked)
      if (const Symmetric<Dim> cracks = cracks_of(particles_, damage_, rules_, i); !cracks.isZero(0))
        return transmitted<Dim>(S, matrix_of<Dim>(cracks));
    return S;
  }

 private:
  const Particles<Dim>& particles_;
  const PairRules& rules_;
  std::span<const double> pressure_;
  Columns<Dim, const double> deviator_, damage_, intact_share_;
};

/// Fills the records of the particles of one owner, but for the stress.
template <class T, int Dim, RecordKind Kind, class Flux>
class Filler {
  using R = PairRecord<T, Dim, Kind, Flux>;

 public:
  Filler(const Particles<Dim>& particles, const PairRules& rules, const RecordScales& scales)
      : particles_(particles),
        rules_(rules),
        scales_(scales),
        to_unit_(1 / scales.length_unit),
        position_(particles, Field::position),
        velocity_(particles, Field::velocity),
        metric_(particles, Field::smoothing_metric),
        damage_(particles, Field::damage_tensor),
        start_(particles, Field::start_position),
        bond_(particles, Field::bond),
        flux_(particles, scales),
        h_(particles.column(Field::smoothing_length)),
        mass_(particles.column(Field::mass)),
        density_(particles.column(Field::density)),
        sound_speed_(particles.column(Field::sound_speed)),
        body_(particles.label(Label::body)),
        material_(particles.label(Label::material)) {}

  void fill(std::size_t i, T* r) const {
    const auto power = record_detail::power<Dim>;
    for (std::size_t a = 0; a < Dim; ++a) {
      const int axis = static_cast<int>(a);
      set_position<T, R>(r, R::x + axis, R::x_low + axis, position_(a, i) * to_unit_);
      r[R::v + a] = static_cast<T>(velocity_(a, i));
    }
    const double h_reciprocal = scales_.length_unit / h_[i];
    if constexpr (Kind.asph) {
      for (std::size_t k = 0; k < metric_.count; ++k)
        r[R::metric + k] = static_cast<T>(metric_(k, i) * scales_.length_unit * scales_.length_unit);
      r[R::slope_norm] = static_cast<T>(scales_.kernel_norm * power(h_reciprocal));
    } else {
      r[R::h] = static_cast<T>(0.05 * h_[i] * to_unit_);
      r[R::reach_reciprocal] = static_cast<T>(h_reciprocal / scales_.support);
      r[R::slope_norm] = static_cast<T>(0.5 * scales_.slope * scales_.kernel_norm * power(h_reciprocal) * h_reciprocal *
                                        (scales_.slope_over_r ? 1 : h_reciprocal));
    }
    const double reference = rules_.reference_density[static_cast<std::size_t>(material_[i])];
    r[R::volume] = static_cast<T>(mass_[i] / reference * power(to_unit_));
    r[R::expansion] = static_cast<T>(reference / density_[i]);
    r[R::compression] = static_cast<T>(density_[i] / reference);
    r[R::density] = static_cast<T>(density_[i]);
    r[R::sound_speed] = static_cast<T>(sound_speed_[i]);
    r[R::reference] = static_cast<T>(reference);
    if constexpr (Kind.stress)
      r[R::piece] = rules_.pieces.empty() ? T(0) : static_cast<T>(rules_.pieces[static_cast<std::size_t>(body_[i])]);
    if constexpr (Kind.bonded) {
      for (std::size_t a = 0; a < Dim; ++a) {
        const int axis = static_cast<int>(a);
        set_position<T, R>(r, R::place + axis, R::place_low + axis, start_(a, i) * to_unit_);
      }
      r[R::bond] = static_cast<T>(bond_(0, i) * scales_.support * h_[i] * to_unit_);
      std::fill_n(r + R::deformation, Dim * Dim + 1, T(0));  // nobody knows it of guests
    }
    if constexpr (Kind.cracked) {
      const Symmetric<Dim> cracks = cracks_of(particles_, damage_, rules_, i);
      for (int k = 0; k < symmetric_size<Dim>; ++k)
        r[R::damage + k] = static_cast<T>(k < Dim ? cracks[k] : 2 * cracks[k]);
    }
    flux_.pack(i, r + R::flux);
  }

  /// Makes the record of particle i that of its ghost.
  void transform(std::size_t i, const Transform& seen, T* r) const {
    for (int axis = 0; axis < Dim; ++axis) {
      if (!seen.moves(axis)) continue;
      const auto a = static_cast<std::size_t>(axis);
      const auto moved = [&](double x) { return seen.position(axis, x) * to_unit_; };
      set_position<T, R>(r, R::x + axis, R::x_low + axis, moved(position_(a, i)));
      if constexpr (Kind.bonded) set_position<T, R>(r, R::place + axis, R::place_low + axis, moved(start_(a, i)));
      if (seen.mirrors(axis)) mirror<T, R, Dim, Kind>(r, axis);
    }
    // Piece 0 is gas: it presses against the wall by its own images.
    if constexpr (Kind.stress)
      if (seen.behind_wall && r[R::piece] != 0) r[R::piece] = wall;
  }

 private:
  const Particles<Dim>& particles_;
  const PairRules& rules_;
  RecordScales scales_;
  double to_unit_;
  Columns<Dim, const double> position_, velocity_, metric_, damage_, start_, bond_;
  typename R::FluxRecord flux_;
  std::span<const double> h_, mass_, density_, sound_speed_;
  std::span<const std::int32_t> body_, material_;
};

}  // namespace record_detail

template <class T, int Dim, RecordKind Kind, class Flux>
void PairRecord<T, Dim, Kind, Flux>::pack(const Particles<Dim>& particles, const GhostList<Dim>& ghosts,
                                          const PairRules& rules, const RecordScales& scales, std::vector<T>& records) {
  using Filler = record_detail::Filler<T, Dim, Kind, Flux>;
  const std::size_t n = particles.size(), needed = (n + ghosts.size()) * size;
  if (records.size() < needed) records.resize(needed + needed / 8);
  const Filler own(particles, rules, scales);
  std::vector<Filler> guests;
  for (const Particles<Dim>* guest : ghosts.guests) guests.emplace_back(*guest, rules, scales);
  parallel_for(0, n, [&](std::size_t i) { own.fill(i, records.data() + i * size); });
  for (std::size_t k = 0; k < ghosts.size(); ++k) {
    const Ghost& ghost = ghosts.ghosts[k];
    const Filler& owner = ghost.owner == 0 ? own : guests[ghost.owner - 1u];
    T* r = records.data() + (n + k) * size;
    if (ghost.owner == 0)
      std::copy_n(records.data() + ghost.source * size, size, r);
    else
      owner.fill(ghost.source, r);
    owner.transform(ghost.source, ghosts.transform(ghost), r);
  }
}

template <class T, int Dim, RecordKind Kind, class Flux>
void PairRecord<T, Dim, Kind, Flux>::pack_contacts(const Particles<Dim>& particles, const GhostList<Dim>& ghosts,
                                                   const PairRules& rules, const Surroundings<Dim>& around,
                                                   std::vector<T>& contacts) {
  const std::size_t n = particles.size(), needed = (n + ghosts.size()) * contact_size;
  if (contacts.size() < needed) contacts.resize(needed + needed / 8);
  const auto h = particles.column(Field::smoothing_length);
  const auto body = particles.label(Label::body);
  parallel_for(0, n, [&](std::size_t i) {
    T* r = contacts.data() + i * contact_size;
    const auto& sums = around.sums[i];
    const Vec<Dim> outward = sums.normal();
    const double particle_size = rules.sizes[static_cast<std::size_t>(body[i])];
    r[contact] = static_cast<T>(record_detail::contact_of(sums.occupied, around.half_space, particle_size, h[i]));
    for (int a = 0; a < Dim; ++a) r[normal + a] = static_cast<T>(outward[a]);
  });
  for (std::size_t k = 0; k < ghosts.size(); ++k) {
    const Ghost& ghost = ghosts.ghosts[k];
    T* r = contacts.data() + (n + k) * contact_size;
    if (ghost.owner != 0) {  // nobody knows the surroundings of a guest
      std::fill_n(r, Dim + 1, T(0));
      continue;
    }
    std::copy_n(contacts.data() + ghost.source * contact_size, Dim + 1, r);
    for (int a = 0; a < Dim; ++a)
      if (ghosts.transform(ghost).mirrors(a)) r[normal + a] *= -1;
  }
}

template <class T, int Dim, RecordKind Kind, class Flux>
void PairRecord<T, Dim, Kind, Flux>::pack_stress(const Particles<Dim>& particles, const GhostList<Dim>& ghosts,
                                                 const PairRules& rules, const Surroundings<Dim>& around,
                                                 std::vector<T>& records, std::vector<T>& contacts) {
  using StressOf = record_detail::StressOf<Dim, Kind>;
  const std::size_t n = particles.size();
  const StressOf own_stress(particles, rules);
  std::vector<StressOf> guests;
  for (const Particles<Dim>* guest : ghosts.guests) guests.emplace_back(*guest, rules);
  /// of(P, S) gives what acts.
  const auto fill = [&](const StressOf& source, std::size_t i, std::size_t place, const auto& of) {
    T* r = records.data() + place * size;
    const double rho0_over_rho = static_cast<double>(r[expansion]), squared = rho0_over_rho * rho0_over_rho;
    if constexpr (!Kind.stress) {
      r[stress] = static_cast<T>(-squared * source.pressure(i));
    } else {
      const auto [own, others, through] = of(source.pressure(i), source.deviator(i));
      for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) {
          r[stress + a * Dim + b] = static_cast<T>(squared * own(a, b));
          if constexpr (Kind.cracked) r[shear + a * Dim + b] = static_cast<T>(squared * through(a, b));
          if (!contacts.empty())
            contacts[place * contact_size + static_cast<std::size_t>(press + a * Dim + b)] =
                static_cast<T>(squared * others(a, b));
        }
    }
  };
  parallel_for(0, n, [&](std::size_t i) {
    fill(own_stress, i, i, [&](double P, const Mat<Dim>& S) { return record_detail::corrected<Dim>(P, S, around, i); });
  });
  for (std::size_t k = 0; k < ghosts.size(); ++k) {
    const Ghost& ghost = ghosts.ghosts[k];
    T* r = records.data() + (n + k) * size + stress;
    T* t = contacts.empty() ? nullptr : contacts.data() + (n + k) * contact_size + press;
    if (ghost.owner == 0) {
      // With what passes no crack and the deformation.
      std::copy_n(records.data() + ghost.source * size + stress, damage - stress, r);
      if (t) std::copy_n(contacts.data() + ghost.source * contact_size + press, stresses, t);
    } else {
      fill(guests[ghost.owner - 1u], ghost.source, n + k, [](double P, const Mat<Dim>& S) {
        const Mat<Dim> sigma = S - P * Mat<Dim>::Identity();
        return record_detail::ActingStress<Dim>{sigma, std::min(0.0, sigma.trace() / Dim) * Mat<Dim>::Identity(), S};
      });
    }
    if constexpr (Kind.stress)
      for (int a = 0; a < Dim; ++a) {
        if (!ghosts.transform(ghost).mirrors(a)) continue;
        record_detail::mirror_tensor<Dim>(r, a);
        if constexpr (Kind.cracked) record_detail::mirror_tensor<Dim>(r + shear - stress, a);
        if constexpr (Kind.bonded) record_detail::mirror_tensor<Dim>(r + deformation - stress, a);
        if (t) record_detail::mirror_tensor<Dim>(t, a);
      }
  }
}

}  // namespace ejecta
