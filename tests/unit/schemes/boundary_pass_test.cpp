#include <gtest/gtest.h>

#include "unit/schemes/reference_pass.hpp"

namespace ejecta {
namespace {

/// The particles and all their copies beyond the faces as particles of their own.
template <int Dim>
Particles<Dim> with_copies(const Particles<Dim>& p, const Boundary& boundary) {
  struct Copy {
    std::size_t source;
    Vec<Dim> x, sign;
  };
  std::vector<Copy> copies;
  for (std::size_t i = 0; i < p.size(); ++i) copies.push_back({i, p.vector(Field::position, i), Vec<Dim>::Ones()});
  for (int a = 0; a < Dim; ++a) {
    const auto k = static_cast<std::size_t>(a);
    if (boundary.kind[k] == BoundaryKind::open) continue;
    for (std::size_t c = 0, before = copies.size(); c < before; ++c)
      for (const bool upper : {false, true}) {
        Copy copy = copies[c];
        if (boundary.kind[k] == BoundaryKind::periodic) {
          copy.x[a] += (upper ? 1 : -1) * (boundary.max[k] - boundary.min[k]);
        } else {
          copy.x[a] = 2 * (upper ? boundary.max[k] : boundary.min[k]) - copy.x[a];
          copy.sign[a] = -1;
        }
        copies.push_back(copy);
      }
  }
  Particles<Dim> all;
  all.allocate(copies.size(), p.fields());
  for (std::size_t c = 0; c < copies.size(); ++c) {
    for (const Field f : p.fields())
      for (int k = 0; k < components(info(f).shape, Dim); ++k) all.column(f, k)[c] = p.column(f, k)[copies[c].source];
    all.label(Label::id)[c] = static_cast<std::int32_t>(c);
    all.set_vector(Field::position, c, copies[c].x);
    const Vec<Dim> sign = copies[c].sign;
    all.set_vector(Field::velocity, c, sign.cwiseProduct(p.vector(Field::velocity, copies[c].source)));
    all.column(Field::deviatoric_stress, 2)[c] *= sign[0] * sign[1];
    if constexpr (Dim == 3) {
      all.column(Field::deviatoric_stress, 3)[c] *= sign[0] * sign[2];
      all.column(Field::deviatoric_stress, 4)[c] *= sign[1] * sign[2];
    }
  }
  all.set_material_ranges({{0, copies.size()}});
  return all;
}

template <int Dim>
void expect_images_act_like_copies(const std::array<BoundaryKind, 3>& kinds, Precision precision) {
  auto settings = settings_of(Kernel::wendland_c2, precision, true, false);
  const std::size_t n = Dim == 3 ? 400 : 200;
  auto p = random_matter<Dim>(n, 33, true, 1.2);
  // The cloud reaches from -0.3 to 0.7 of its edge.
  const double edge = spacing * std::pow(static_cast<double>(n), 1.0 / Dim);
  settings.boundary = {kinds, {-0.3 * edge, -0.3 * edge, -0.3 * edge}, {0.7 * edge, 0.7 * edge, 0.7 * edge}};
  const auto copies = with_copies(p, settings.boundary);
  const auto lists = run_rates(p, settings);
  ASSERT_GT(lists.images().size(), n / 4);
  Vec<Dim> total = Vec<Dim>::Zero();
  double scale = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Sums<Dim> sums = reference_rates(copies, settings, {}, i);
    const double tolerance = precision == Precision::mixed ? 3e-6 : 1e-12;
    EXPECT_LT((p.vector(Field::acceleration, i) - sums.acceleration).norm(), tolerance * sums.acceleration_scale);
    EXPECT_NEAR(p.column(Field::heating)[i], sums.heating, tolerance * sums.heating_scale);
    EXPECT_LT((velocity_gradient_of(p, i) - sums.gradient).norm(), tolerance * sums.gradient_scale);
    total += p.column(Field::mass)[i] * p.vector(Field::acceleration, i);
    scale += p.column(Field::mass)[i] * p.vector(Field::acceleration, i).norm();
  }
  const bool closed = std::count(kinds.begin(), kinds.end(), BoundaryKind::reflecting) == 0;
  // An image's position is rounded once more than its source's, hence not to the last bit.
  if (closed) {
    EXPECT_LT(total.norm(), (precision == Precision::mixed ? 1e-8 : 1e-13) * scale);
  }
}

TEST(PairPass, ImagesActLikeCopiesOfTheirSources) {
  using enum BoundaryKind;
  for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
    expect_images_act_like_copies<2>({periodic, periodic, open}, precision);
    expect_images_act_like_copies<2>({reflecting, periodic, open}, precision);
    expect_images_act_like_copies<3>({periodic, open, reflecting}, precision);
    expect_images_act_like_copies<3>({reflecting, reflecting, reflecting}, precision);
  }
}

}  // namespace
}  // namespace ejecta
