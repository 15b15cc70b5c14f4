#include "schemes/pair_records.hpp"

#include <array>
#include <cmath>

#include "base/parallel.hpp"

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
template <class T, class R, int Dim, bool Stress>
void mirror(T* record, int axis) {
  record[R::v + axis] = -record[R::v + axis];
  if constexpr (Stress && Dim == 2) record[R::stress + 2] = -record[R::stress + 2];
  if constexpr (Stress && Dim == 3) {
    constexpr int first_off_diagonal = 3;  // xy, xz, yz: each axis takes part in two of them
    for (int pair = 0; pair < 3; ++pair)
      if (pair != 2 - axis) {
        T& shear = record[R::stress + first_off_diagonal + pair];
        shear = -shear;
      }
  }
}

}  // namespace

template <class T, int Dim, bool Stress>
void pack_records(const Particles<Dim>& particles, const std::vector<Image>& images, const Boundary& boundary,
                  double kernel_norm, double length_unit, std::span<const double> intact, std::vector<T>& records) {
  using R = PairRecord<T, Dim, Stress>;
  const std::size_t n = particles.size(), needed = (n + images.size()) * R::size;
  if (records.size() < needed) records.resize(needed + needed / 8);
  const double to_unit = 1 / length_unit;
  const bool has_switch = particles.has(Field::shear_switch);
  std::array<std::span<const double>, Dim> position, velocity;
  for (int a = 0; a < Dim; ++a) {
    position[a] = particles.column(Field::position, a);
    velocity[a] = particles.column(Field::velocity, a);
  }
  std::array<std::span<const double>, Stress ? deviator_size<Dim> : 0> deviatoric_stress;
  for (std::size_t k = 0; k < deviatoric_stress.size(); ++k)
    deviatoric_stress[k] = particles.column(Field::deviatoric_stress, static_cast<int>(k));
  const auto shear_switch = has_switch ? particles.column(Field::shear_switch) : std::span<const double>{};
  const auto h = particles.column(Field::smoothing_length), mass = particles.column(Field::mass),
             density = particles.column(Field::density), pressure = particles.column(Field::pressure),
             sound_speed = particles.column(Field::sound_speed);
  parallel_for(0, n, [&](std::size_t i) {
    T* r = records.data() + i * R::size;
    for (int a = 0; a < Dim; ++a) {
      set_position<T, R, Dim>(r, a, position[a][i] * to_unit);
      r[R::v + a] = static_cast<T>(velocity[a][i]);
    }
    const double h_reciprocal = length_unit / h[i], density_reciprocal = 1 / density[i];
    r[R::h] = static_cast<T>(h[i] * to_unit);
    r[R::h_reciprocal] = static_cast<T>(h_reciprocal);
    r[R::slope_norm] = static_cast<T>(kernel_norm * power<Dim>(h_reciprocal) * h_reciprocal * h_reciprocal);
    r[R::mass] = static_cast<T>(mass[i] * power<Dim>(to_unit));
    r[R::density_reciprocal] = static_cast<T>(density_reciprocal);
    r[R::sound_speed] = static_cast<T>(sound_speed[i]);
    r[R::shear_switch] = has_switch ? static_cast<T>(shear_switch[i]) : T(1);
    const double per_density2 = density_reciprocal * density_reciprocal;
    if constexpr (!Stress) {
      r[R::stress] = static_cast<T>(-pressure[i] * per_density2);
    } else {
      const double scale = intact.empty() ? 1.0 : intact[i];
      auto deviator = [&](int k) { return scale * deviatoric_stress[k][i]; };
      T* s = r + R::stress;
      s[0] = static_cast<T>((deviator(0) - pressure[i]) * per_density2);
      s[1] = static_cast<T>((deviator(1) - pressure[i]) * per_density2);
      if constexpr (Dim == 2) {
        s[2] = static_cast<T>(deviator(2) * per_density2);
      } else {
        s[2] = static_cast<T>((-deviator(0) - deviator(1) - pressure[i]) * per_density2);
        for (int k = 2; k < 5; ++k) s[k + 1] = static_cast<T>(deviator(k) * per_density2);
      }
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
      if (image.mirror[a] != 0) mirror<T, R, Dim, Stress>(r, a);
    }
  }
}

template void pack_records<double, 2, false>(const Particles<2>&, const std::vector<Image>&, const Boundary&, double,
                                             double, std::span<const double>, std::vector<double>&);
template void pack_records<double, 2, true>(const Particles<2>&, const std::vector<Image>&, const Boundary&, double,
                                            double, std::span<const double>, std::vector<double>&);
template void pack_records<float, 2, false>(const Particles<2>&, const std::vector<Image>&, const Boundary&, double,
                                            double, std::span<const double>, std::vector<float>&);
template void pack_records<float, 2, true>(const Particles<2>&, const std::vector<Image>&, const Boundary&, double,
                                           double, std::span<const double>, std::vector<float>&);
template void pack_records<double, 3, false>(const Particles<3>&, const std::vector<Image>&, const Boundary&, double,
                                             double, std::span<const double>, std::vector<double>&);
template void pack_records<double, 3, true>(const Particles<3>&, const std::vector<Image>&, const Boundary&, double,
                                            double, std::span<const double>, std::vector<double>&);
template void pack_records<float, 3, false>(const Particles<3>&, const std::vector<Image>&, const Boundary&, double,
                                            double, std::span<const double>, std::vector<float>&);
template void pack_records<float, 3, true>(const Particles<3>&, const std::vector<Image>&, const Boundary&, double,
                                           double, std::span<const double>, std::vector<float>&);

}  // namespace ejecta
