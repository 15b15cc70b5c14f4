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

/// The stress that acts on own neighbours, and on other pieces.
template <int Dim>
ContactStress<Dim> corrected(const Mat<Dim>& sigma, const Surroundings<Dim>& around, std::size_t i) {
  const auto& sums = around.sums[i];
  const GradientCorrection<Dim> own = around.own(sums);
  if (sums.contact.isZero(0)) return {own.stress(sigma), Mat<Dim>::Zero()};
  return contact_stress<Dim>(sigma, sums.normal(), own, around.all(sums));
}

inline bool behind_a_wall(const Boundary& boundary, const Image& image) {
  for (std::size_t a = 0; a < 3; ++a)
    if (image.mirror[a] != 0 && boundary.kind[a] == BoundaryKind::reflecting) return true;
  return false;
}

}  // namespace record_detail

template <class T, int Dim, RecordKind Kind, class Flux>
void PairRecord<T, Dim, Kind, Flux>::pack(const Particles<Dim>& particles, const std::vector<Image>& images,
                                          const PairRules& rules, const RecordScales& scales, std::vector<T>& records) {
  using R = PairRecord;
  const std::size_t n = particles.size(), needed = (n + images.size()) * R::size;
  if (records.size() < needed) records.resize(needed + needed / 8);
  const double to_unit = 1 / scales.length_unit;
  const Columns<Dim, const double> position(particles, Field::position), velocity(particles, Field::velocity),
      metric(particles, Field::smoothing_metric), damage(particles, Field::damage_tensor),
      start(particles, Field::start_position), bond(particles, Field::bond);
  const FluxRecord flux(particles, scales);
  const auto h = particles.column(Field::smoothing_length), mass = particles.column(Field::mass),
             density = particles.column(Field::density), sound_speed = particles.column(Field::sound_speed);
  const auto body = particles.label(Label::body), material = particles.label(Label::material);
  parallel_for(0, n, [&](std::size_t i) {
    T* r = records.data() + i * R::size;
    for (std::size_t a = 0; a < Dim; ++a) {
      const int axis = static_cast<int>(a);
      record_detail::set_position<T, R>(r, R::x + axis, R::x_low + axis, position(a, i) * to_unit);
      r[R::v + a] = static_cast<T>(velocity(a, i));
    }
    const double h_reciprocal = scales.length_unit / h[i];
    if constexpr (Kind.asph) {
      for (std::size_t k = 0; k < metric.count; ++k)
        r[R::metric + k] = static_cast<T>(metric(k, i) * scales.length_unit * scales.length_unit);
      r[R::slope_norm] = static_cast<T>(scales.kernel_norm * record_detail::power<Dim>(h_reciprocal));
    } else {
      r[R::h] = static_cast<T>(0.05 * h[i] * to_unit);
      r[R::reach_reciprocal] = static_cast<T>(h_reciprocal / scales.support);
      r[R::slope_norm] =
          static_cast<T>(0.5 * scales.slope * scales.kernel_norm * record_detail::power<Dim>(h_reciprocal) *
                         h_reciprocal * (scales.slope_over_r ? 1 : h_reciprocal));
    }
    const double reference = rules.reference_density[static_cast<std::size_t>(material[i])];
    r[R::volume] = static_cast<T>(mass[i] / reference * record_detail::power<Dim>(to_unit));
    r[R::expansion] = static_cast<T>(reference / density[i]);
    r[R::compression] = static_cast<T>(density[i] / reference);
    r[R::density] = static_cast<T>(density[i]);
    r[R::sound_speed] = static_cast<T>(sound_speed[i]);
    r[R::mass] = static_cast<T>(mass[i] * record_detail::power<Dim>(to_unit));
    if constexpr (Kind.stress)
      r[R::piece] = rules.pieces.empty() ? T(0) : static_cast<T>(rules.pieces[static_cast<std::size_t>(body[i])]);
    if constexpr (Kind.bonded) {
      for (std::size_t a = 0; a < Dim; ++a) {
        const int axis = static_cast<int>(a);
        record_detail::set_position<T, R>(r, R::place + axis, R::place_low + axis, start(a, i) * to_unit);
      }
      r[R::bond] = static_cast<T>(bond(0, i) * scales.support * h[i] * to_unit);
    }
    if constexpr (Kind.cracked) {
      const Symmetric<Dim> cracks = record_detail::cracks_of(particles, damage, rules, i);
      for (int k = 0; k < symmetric_size<Dim>; ++k) r[R::damage + k] = static_cast<T>(cracks[k]);
    }
    flux.pack(i, r + R::flux);
  });
  for (std::size_t k = 0; k < images.size(); ++k) {
    const Image& image = images[k];
    T* r = records.data() + (n + k) * R::size;
    std::copy_n(records.data() + image.source * R::size, R::size, r);
    for (int a = 0; a < Dim; ++a) {
      if (image.shift[a] == 0 && image.mirror[a] == 0) continue;
      const auto moved = [&](double x) { return image_position(rules.boundary, image, a, x) * to_unit; };
      record_detail::set_position<T, R>(r, R::x + a, R::x_low + a,
                                        moved(position(static_cast<std::size_t>(a), image.source)));
      if constexpr (Kind.bonded)
        record_detail::set_position<T, R>(r, R::place + a, R::place_low + a,
                                          moved(start(static_cast<std::size_t>(a), image.source)));
      if (image.mirror[a] != 0) record_detail::mirror<T, R, Dim, Kind>(r, a);
    }
    // Piece 0 is gas: it presses against the wall by its own images.
    if constexpr (Kind.stress)
      if (r[R::piece] != 0 && record_detail::behind_a_wall(rules.boundary, image)) r[R::piece] = wall;
  }
}

template <class T, int Dim, RecordKind Kind, class Flux>
void PairRecord<T, Dim, Kind, Flux>::pack_contacts(const Particles<Dim>& particles, const std::vector<Image>& images,
                                                   const PairRules& rules, const Surroundings<Dim>& around,
                                                   std::vector<T>& contacts) {
  using R = PairRecord;
  const std::size_t n = particles.size(), needed = (n + images.size()) * R::contact_size;
  if (contacts.size() < needed) contacts.resize(needed + needed / 8);
  const auto h = particles.column(Field::smoothing_length);
  const auto body = particles.label(Label::body);
  parallel_for(0, n, [&](std::size_t i) {
    T* r = contacts.data() + i * R::contact_size;
    const auto& sums = around.sums[i];
    const Vec<Dim> normal = sums.normal();
    const double size = rules.sizes[static_cast<std::size_t>(body[i])];
    r[R::contact] = static_cast<T>(record_detail::contact_of(sums.occupied, around.half_space, size, h[i]));
    for (int a = 0; a < Dim; ++a) r[R::normal + a] = static_cast<T>(normal[a]);
  });
  for (std::size_t k = 0; k < images.size(); ++k) {
    const Image& image = images[k];
    T* r = contacts.data() + (n + k) * R::contact_size;
    std::copy_n(contacts.data() + image.source * R::contact_size, Dim + 1, r);
    for (int a = 0; a < Dim; ++a)
      if (image.mirror[a] != 0) r[R::normal + a] *= -1;
  }
}

template <class T, int Dim, RecordKind Kind, class Flux>
void PairRecord<T, Dim, Kind, Flux>::pack_stress(const Particles<Dim>& particles, const std::vector<Image>& images,
                                                 const PairRules& rules, const Surroundings<Dim>& around, std::vector<T>& records,
                                                 std::vector<T>& contacts) {
  using R = PairRecord;
  const std::size_t n = particles.size();
  const auto pressure = particles.column(Field::pressure);
  const Columns<Dim, const double> deviatoric_stress(particles, Field::deviatoric_stress),
      damage(particles, Field::damage_tensor), intact_share(particles, Field::intact_share);
  parallel_for(0, n, [&](std::size_t i) {
    T* r = records.data() + i * R::size;
    const double expansion = static_cast<double>(r[R::expansion]), squared = expansion * expansion;
    if constexpr (!Kind.stress) {
      r[R::stress] = static_cast<T>(-squared * pressure[i]);
    } else {
      const double scale = intact_share.count ? intact_share(0, i) : 1.0;
      auto deviator = [&](std::size_t k) { return scale * deviatoric_stress(k, i); };
      Symmetric<Dim> s = Symmetric<Dim>::Zero();
      if (deviatoric_stress.count) {
        if constexpr (Dim == 2)
          s << deviator(0), deviator(1), deviator(2);
        else
          s << deviator(0), deviator(1), -deviator(0) - deviator(1), deviator(2), deviator(3), deviator(4);
      }
      Mat<Dim> sigma = matrix_of<Dim>(s);
      if constexpr (Kind.cracked)
        if (const Symmetric<Dim> cracks = record_detail::cracks_of(particles, damage, rules, i); !cracks.isZero(0))
          sigma = transmitted<Dim>(sigma, matrix_of<Dim>(cracks));
      for (int a = 0; a < Dim; ++a) sigma(a, a) -= pressure[i];

      const auto [own, others] = record_detail::corrected<Dim>(sigma, around, i);
      for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) {
          r[R::stress + a * Dim + b] = static_cast<T>(squared * own(a, b));
          if (!contacts.empty())
            contacts[i * R::contact_size + static_cast<std::size_t>(R::press + a * Dim + b)] =
                static_cast<T>(squared * others(a, b));
        }
    }
  });
  for (std::size_t k = 0; k < images.size(); ++k) {
    const Image& image = images[k];
    const T* source = records.data() + image.source * R::size;
    T* r = records.data() + (n + k) * R::size;
    std::copy_n(source + R::stress, R::stresses, r + R::stress);
    if constexpr (Kind.stress) {
      for (int a = 0; a < Dim; ++a)
        if (image.mirror[a] != 0) record_detail::mirror_tensor<Dim>(r + R::stress, a);
      if (contacts.empty()) continue;
      T* t = contacts.data() + (n + k) * R::contact_size + R::press;
      std::copy_n(contacts.data() + image.source * R::contact_size + R::press, R::stresses, t);
      for (int a = 0; a < Dim; ++a)
        if (image.mirror[a] != 0) record_detail::mirror_tensor<Dim>(t, a);
    }
  }
}

}  // namespace ejecta
