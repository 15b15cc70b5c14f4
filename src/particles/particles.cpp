#include "particles/particles.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace ejecta {

std::vector<Range> ranges_of_materials(std::span<const std::int32_t> material, std::size_t materials) {
  std::vector<Range> ranges;
  for (std::size_t m = 0; m < materials; ++m) {
    const auto equal = std::ranges::equal_range(material, static_cast<std::int32_t>(m));
    ranges.push_back({static_cast<std::size_t>(equal.begin() - material.begin()),
                      static_cast<std::size_t>(equal.end() - material.begin())});
  }
  return ranges;
}

template <int Dim>
void Particles<Dim>::allocate(std::size_t n, std::span<const Field> fields) {
  size_ = n;
  present_.fill(false);
  for (Field f : {Field::position, Field::velocity, Field::acceleration, Field::mass}) present_[index(f)] = true;
  for (Field f : fields) present_[index(f)] = true;
  for (const FieldInfo& f : field_catalogue())
    for (int k = 0; k < components(f.shape, Dim); ++k) {
      const std::size_t s = index(f.field) * max_components + static_cast<std::size_t>(k);
      columns_[s].assign(has(f.field) ? n : 0, 0.0);
      const bool rate = has(f.field) && f.role == Role::rate;
      previous_[s].assign(rate ? n : 0, 0.0);
      expected_[s].assign(rate && f.field != Field::acceleration ? n : 0, 0.0);
    }
  for (auto& label : labels_) label.assign(n, 0);
  scratch_.assign(n, 0.0);
  label_scratch_.assign(n, 0);
}

template <int Dim>
void Particles<Dim>::resize(std::size_t n) {
  auto fit = [&](auto& column) {
    if (column.size() == size_) column.resize(n);  // those of absent fields are empty
  };
  for (auto* columns : {&columns_, &previous_, &expected_})
    for (auto& column : *columns) fit(column);
  for (auto& label : labels_) fit(label);
  fit(scratch_);
  fit(label_scratch_);
  size_ = n;
}

template <int Dim>
std::vector<Field> Particles<Dim>::fields() const {
  std::vector<Field> present;
  for (const FieldInfo& f : field_catalogue())
    if (has(f.field)) present.push_back(f.field);
  return present;
}

template <int Dim>
void Particles<Dim>::swap_rates() {
  for (const FieldInfo& f : field_catalogue())
    if (has(f.field) && f.role == Role::rate)
      for (int k = 0; k < components(f.shape, Dim); ++k) columns_[slot(f.field, k)].swap(previous_[slot(f.field, k)]);
}

template <int Dim>
void Particles<Dim>::reorder(std::span<const std::uint32_t> order) {
  // There are many columns: for a few particles threads would take longer to meet than to do their work.
  constexpr std::size_t worth_threads = 50'000;
  auto permute = [&](auto& column, auto& scratch) {
    if (column.empty()) return;
    const auto fetch = [&](std::size_t i) { scratch[i] = column[order[i]]; };
    if (size_ < worth_threads)
      for (std::size_t i = 0; i < size_; ++i) fetch(i);
    else
      parallel_for(0, size_, fetch);
    column.swap(scratch);
  };
  for (auto& column : columns_) permute(column, scratch_);
  for (auto& column : previous_) permute(column, scratch_);
  for (auto& column : expected_) permute(column, scratch_);
  for (auto& label : labels_) permute(label, label_scratch_);
}

template <int Dim>
std::size_t Particles<Dim>::bytes() const {
  std::size_t doubles = scratch_.capacity(), labels = label_scratch_.capacity();
  for (const auto& column : columns_) doubles += column.capacity();
  for (const auto& column : previous_) doubles += column.capacity();
  for (const auto& column : expected_) doubles += column.capacity();
  for (const auto& label : labels_) labels += label.capacity();
  return doubles * sizeof(double) + labels * sizeof(std::int32_t);
}

template class Particles<2>;
template class Particles<3>;

}  // namespace ejecta
