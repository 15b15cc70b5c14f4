#pragma once
/// Columns of particle state. A column exists only if it was asked for; columns are stored component by component.
#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "particles/fields.hpp"

namespace ejecta {

/// The range of each material, particles of which are contiguous, in the order of their numbers.
std::vector<Range> ranges_of_materials(std::span<const std::int32_t> material, std::size_t materials);

/// Integer labels every particle carries.
enum class Label { id, body, material, count };

template <int Dim>
class Particles {
 public:
  /// n particles with the given fields (position, velocity, acceleration and mass are always there), all zero.
  /// Every rate gets two more columns, which the integrator needs: its value at the previous step, and what it is
  /// expected to be at the end of the present one.
  void allocate(std::size_t n, std::span<const Field> fields);

  std::size_t size() const { return size_; }
  bool has(Field f) const { return present_[index(f)]; }
  /// The fields present, in catalogue order.
  std::vector<Field> fields() const;

  /// One component of a field, n values in the field's SI unit.
  std::span<double> column(Field f, int component = 0) { return columns_[slot(f, component)]; }
  std::span<const double> column(Field f, int component = 0) const { return columns_[slot(f, component)]; }
  /// The same of a rate at the previous step.
  std::span<double> previous(Field rate, int component = 0) { return previous_[slot(rate, component)]; }
  std::span<const double> previous(Field rate, int component = 0) const { return previous_[slot(rate, component)]; }
  /// What a rate is expected to be at the end of the step; between predict() and correct() only.
  std::span<double> expected(Field rate, int component = 0) { return expected_[slot(rate, component)]; }
  std::span<const double> expected(Field rate, int component = 0) const { return expected_[slot(rate, component)]; }
  /// Makes the current rates the previous ones without copying.
  void swap_rates();

  std::span<std::int32_t> label(Label l) { return labels_[static_cast<std::size_t>(l)]; }
  std::span<const std::int32_t> label(Label l) const { return labels_[static_cast<std::size_t>(l)]; }

  Vec<Dim> vector(Field f, std::size_t i) const {
    Vec<Dim> v;
    for (int a = 0; a < Dim; ++a) v[a] = column(f, a)[i];
    return v;
  }
  void set_vector(Field f, std::size_t i, const Vec<Dim>& v) {
    for (int a = 0; a < Dim; ++a) column(f, a)[i] = v[a];
  }

  Mat<Dim> tensor(Field f, std::size_t i) const {
    Mat<Dim> m;
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) m(a, b) = column(f, a * Dim + b)[i];
    return m;
  }
  Mat<Dim> symmetric(Field f, std::size_t i) const {
    Symmetric<Dim> s;
    for (int k = 0; k < symmetric_size<Dim>; ++k) s[k] = column(f, k)[i];
    return matrix_of<Dim>(s);
  }
  void set_symmetric(Field f, std::size_t i, const Mat<Dim>& m) {
    const Symmetric<Dim> s = symmetric_of<Dim>(m);
    for (int k = 0; k < symmetric_size<Dim>; ++k) column(f, k)[i] = s[k];
  }

  /// Particles of one material are contiguous: the range of each, by material number.
  const std::vector<Range>& material_ranges() const { return material_ranges_; }
  void set_material_ranges(std::vector<Range> ranges) { material_ranges_ = std::move(ranges); }

  /// Puts particle order[i] at place i, in every column. `order` is a permutation of 0..n-1.
  void reorder(std::span<const std::uint32_t> order);

  /// Makes room for n particles: the first ones stay, what is new is zero. Material ranges are the caller's.
  void resize(std::size_t n);

  /// Memory of all columns [bytes].
  std::size_t bytes() const;

 private:
  static std::size_t index(Field f) { return static_cast<std::size_t>(f); }
  static constexpr int max_components = Dim * Dim;
  std::size_t slot(Field f, int component) const {
    assert(present_[index(f)] && component < components(info(f).shape, Dim));
    return index(f) * max_components + static_cast<std::size_t>(component);
  }

  std::size_t size_ = 0;
  std::array<bool, field_count> present_{};
  std::array<std::vector<double>, field_count * max_components> columns_, previous_, expected_;
  std::array<std::vector<std::int32_t>, static_cast<std::size_t>(Label::count)> labels_;
  std::vector<Range> material_ranges_;
  std::vector<double> scratch_;
  std::vector<std::int32_t> label_scratch_;
};

}  // namespace ejecta
