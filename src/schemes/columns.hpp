#pragma once
/// The columns of one field, looked up once.
#include <array>
#include <span>
#include <type_traits>

#include "particles/particles.hpp"

namespace ejecta {

/// Value is double, or const double to read only. Without the field there are none.
template <int Dim, class Value>
struct Columns {
  using Owner = std::conditional_t<std::is_const_v<Value>, const Particles<Dim>, Particles<Dim>>;
  std::array<std::span<Value>, Dim * Dim> of{};
  std::size_t count = 0;

  Columns(Owner& particles, Field field) {
    if (!particles.has(field)) return;
    count = static_cast<std::size_t>(components(info(field).shape, Dim));
    for (std::size_t k = 0; k < count; ++k) of[k] = particles.column(field, static_cast<int>(k));
  }
  /// Component k of particle i.
  Value& operator()(std::size_t k, std::size_t i) const { return of[k][i]; }
  /// Of a tensor that is stored row by row.
  void set(std::size_t i, const Mat<Dim>& m) const {
    for (std::size_t a = 0; a < Dim; ++a)
      for (std::size_t b = 0; b < Dim; ++b) of[a * Dim + b][i] = m(a, b);
  }
};

}  // namespace ejecta
