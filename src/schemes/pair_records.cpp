#include "schemes/pair_records.hpp"

#include <array>
#include <cmath>

#include "base/parallel.hpp"
#include "schemes/cracked_stress.hpp"

namespace ejecta {

double power_of_two_below(double length) { return std::ldexp(1.0, std::ilogb(length)); }

namespace {

template <int Dim>
double power(double a) {
  return Dim == 2 ? a * a : a * a * a;
}

template <class T, class R, int Dim>
void set_position(T* record, int axis, double x) {
  record[R::x + axis] = static_cast<T>(x);
  if constexpr (R::split) record[R::x_low + axis] = static_cast<T>(x - static_cast<double>(record[R::x + axis]));
}

/// Mirrors what changes sign at a face normal to `axis`.
template <class T, class R, int Dim, RecordKind Kind>
void mirror(T* record, int axis) {
  record[R::v + axis] = -record[R::v + axis];
  if constexpr (Kind.stress) mirror_symmetric<Dim>(record + R::stress, axis);
  if constexpr (Kind.tensor) mirror_symmetric<Dim>(record + R::metric, axis);
  if constexpr (Kind.coupled) mirror_symmetric<Dim>(record + R::damage, axis);
}

/// The columns of one field, looked up once.
template <int Dim>
struct Columns {
  std::array<std::span<const double>, Dim * Dim> of{};
  std::size_t count = 0;

  Columns() = default;
  Columns(const Particles<Dim>& particles, Field field)
      : count(static_cast<std::size_t>(components(info(field).shape, Dim))) {
    for (std::size_t k = 0; k < count; ++k) of[k] = particles.column(field, static_cast<int>(k));
  }
  double operator()(std::size_t k, std::size_t i) const { return of[k][i]; }
};

}  // namespace

template <class T, int Dim, RecordKind Kind>
void PairRecord<T, Dim, Kind>::pack(const Particles<Dim>& particles, const std::vector<Image>& images,
                                    const Boundary& boundary, double kernel_norm, double length_unit,
                                    std::span<const double> intact, std::span<const char> cut_by_cracks,
                                    std::vector<T>& records) {
  using R = PairRecord;
  const std::size_t n = particles.size(), needed = (n + images.size()) * R::size;
  if (records.size() < needed) records.resize(needed + needed / 8);
  const double to_unit = 1 / length_unit;
  const bool has_switch = particles.has(Field::shear_switch);
  const Columns<Dim> position(particles, Field::position), velocity(particles, Field::velocity);
  Columns<Dim> deviatoric_stress, metric, damage;
  if constexpr (Kind.stress) deviatoric_stress = {particles, Field::deviatoric_stress};
  if constexpr (Kind.tensor) metric = {particles, Field::smoothing_metric};
  if constexpr (Kind.coupled) damage = {particles, Field::damage_tensor};
  const auto shear_switch = has_switch ? particles.column(Field::shear_switch) : std::span<const double>{};
  const auto h = particles.column(Field::smoothing_length), mass = particles.column(Field::mass),
             density = particles.column(Field::density), pressure = particles.column(Field::pressure),
             sound_speed = particles.column(Field::sound_speed);
  parallel_for(0, n, [&](std::size_t i) {
    T* r = records.data() + i * R::size;
    for (std::size_t a = 0; a < Dim; ++a) {
      set_position<T, R, Dim>(r, static_cast<int>(a), position(a, i) * to_unit);
      r[R::v + a] = static_cast<T>(velocity(a, i));
    }
    const double h_reciprocal = length_unit / h[i], density_reciprocal = 1 / density[i];
    if constexpr (Kind.tensor) {
      for (std::size_t k = 0; k < metric.count; ++k)
        r[R::metric + k] = static_cast<T>(metric(k, i) * length_unit * length_unit);
      r[R::slope_norm] = static_cast<T>(kernel_norm * power<Dim>(h_reciprocal));
    } else {
      r[R::h] = static_cast<T>(h[i] * to_unit);
      r[R::h_reciprocal] = static_cast<T>(h_reciprocal);
      r[R::slope_norm] = static_cast<T>(kernel_norm * power<Dim>(h_reciprocal) * h_reciprocal * h_reciprocal);
    }
    r[R::mass] = static_cast<T>(mass[i] * power<Dim>(to_unit));
    r[R::density_reciprocal] = static_cast<T>(density_reciprocal);
    r[R::sound_speed] = static_cast<T>(sound_speed[i]);
    r[R::shear_switch] = has_switch ? static_cast<T>(shear_switch[i]) : T(1);
    const double per_density2 = density_reciprocal * density_reciprocal;
    if constexpr (!Kind.stress) {
      r[R::stress] = static_cast<T>(-pressure[i] * per_density2);
    } else {
      const double scale = intact.empty() ? 1.0 : intact[i];
      auto deviator = [&](std::size_t k) { return scale * deviatoric_stress(k, i); };
      Symmetric<Dim> sigma;
      if constexpr (Dim == 2)
        sigma << deviator(0), deviator(1), deviator(2);
      else
        sigma << deviator(0), deviator(1), -deviator(0) - deviator(1), deviator(2), deviator(3), deviator(4);
      if constexpr (Kind.coupled) {
        Symmetric<Dim> cracks = Symmetric<Dim>::Zero();
        if (cut_by_cracks[static_cast<std::size_t>(particles.label(Label::material)[i])])
          for (std::size_t k = 0; k < damage.count; ++k) cracks[static_cast<int>(k)] = damage(k, i);
        if (!cracks.isZero(0))
          sigma = symmetric_of<Dim>(transmitted<Dim>(matrix_of<Dim>(sigma), matrix_of<Dim>(cracks)));
        for (int k = 0; k < symmetric_size<Dim>; ++k) r[R::damage + k] = static_cast<T>(cracks[k]);
      }
      for (int a = 0; a < Dim; ++a) sigma[a] -= pressure[i];
      for (int k = 0; k < symmetric_size<Dim>; ++k) r[R::stress + k] = static_cast<T>(sigma[k] * per_density2);
    }
  });
  for (std::size_t k = 0; k < images.size(); ++k) {
    const Image& image = images[k];
    T* r = records.data() + (n + k) * R::size;
    std::copy_n(records.data() + image.source * R::size, R::size, r);
    for (int a = 0; a < Dim; ++a) {
      if (image.shift[a] == 0 && image.mirror[a] == 0) continue;
      const double x = particles.column(Field::position, a)[image.source];
      set_position<T, R, Dim>(r, a, image_position(boundary, image, a, x) * to_unit);
      if (image.mirror[a] != 0) mirror<T, R, Dim, Kind>(r, a);
    }
  }
}

// stress, tensor, coupled
template struct PairRecord<double, 2, RecordKind{false, false, false}>;
template struct PairRecord<double, 2, RecordKind{true, false, false}>;
template struct PairRecord<double, 2, RecordKind{false, true, false}>;
template struct PairRecord<double, 2, RecordKind{true, true, false}>;
template struct PairRecord<double, 2, RecordKind{true, false, true}>;
template struct PairRecord<double, 2, RecordKind{true, true, true}>;
template struct PairRecord<double, 3, RecordKind{false, false, false}>;
template struct PairRecord<double, 3, RecordKind{true, false, false}>;
template struct PairRecord<double, 3, RecordKind{false, true, false}>;
template struct PairRecord<double, 3, RecordKind{true, true, false}>;
template struct PairRecord<double, 3, RecordKind{true, false, true}>;
template struct PairRecord<double, 3, RecordKind{true, true, true}>;
template struct PairRecord<float, 2, RecordKind{false, false, false}>;
template struct PairRecord<float, 2, RecordKind{true, false, false}>;
template struct PairRecord<float, 2, RecordKind{false, true, false}>;
template struct PairRecord<float, 2, RecordKind{true, true, false}>;
template struct PairRecord<float, 2, RecordKind{true, false, true}>;
template struct PairRecord<float, 2, RecordKind{true, true, true}>;
template struct PairRecord<float, 3, RecordKind{false, false, false}>;
template struct PairRecord<float, 3, RecordKind{true, false, false}>;
template struct PairRecord<float, 3, RecordKind{false, true, false}>;
template struct PairRecord<float, 3, RecordKind{true, true, false}>;
template struct PairRecord<float, 3, RecordKind{true, false, true}>;
template struct PairRecord<float, 3, RecordKind{true, true, true}>;

}  // namespace ejecta
