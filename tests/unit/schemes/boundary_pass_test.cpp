#include <gtest/gtest.h>

#include "unit/schemes/reference_pass.hpp"

namespace ejecta {
namespace {

/// The particles and all their copies beyond the faces as particles of their own.
template <int Dim>
std::vector<Copy<Dim>> with_copies(const Particles<Dim>& p, const Boundary& boundary, Particles<Dim>& all) {
  std::vector<Copy<Dim>> copies;
  std::vector<Vec<Dim>> places;
  for (std::size_t i = 0; i < p.size(); ++i) {
    copies.push_back({i});
    places.push_back(p.vector(Field::position, i));
  }
  for (int a = 0; a < Dim; ++a) {
    const auto k = static_cast<std::size_t>(a);
    if (boundary.kind[k] == BoundaryKind::open) continue;
    for (std::size_t c = 0, before = copies.size(); c < before; ++c)
      for (const bool upper : {false, true}) {
        Copy<Dim> copy = copies[c];
        Vec<Dim> x = places[c];
        if (boundary.kind[k] == BoundaryKind::periodic) {
          x[a] += (upper ? 1 : -1) * (boundary.max[k] - boundary.min[k]);
        } else {
          x[a] = 2 * (upper ? boundary.max[k] : boundary.min[k]) - x[a];
          copy.sign[a] = -1;
          copy.behind_wall |= boundary.kind[k] == BoundaryKind::reflecting;
        }
        copies.push_back(copy);
        places.push_back(x);
      }
  }
  all.allocate(copies.size(), p.fields());
  for (std::size_t c = 0; c < copies.size(); ++c) {
    const std::size_t source = copies[c].source;
    for (const Field f : p.fields())
      for (int k = 0; k < components(info(f).shape, Dim); ++k) all.column(f, k)[c] = p.column(f, k)[source];
    for (const Label label : {Label::body, Label::material}) all.label(label)[c] = p.label(label)[source];
    all.label(Label::id)[c] = static_cast<std::int32_t>(c);
    all.set_vector(Field::position, c, places[c]);
    all.set_vector(Field::velocity, c, copies[c].sign.cwiseProduct(p.vector(Field::velocity, source)));
  }
  all.set_material_ranges({{0, copies.size()}});
  return copies;
}

template <int Dim>
void expect_images_act_like_copies(const std::array<BoundaryKind, 3>& kinds, Precision precision, bool solid) {
  auto settings = settings_of(Kernel::wendland_c2, precision, true, true);
  settings.friction = 0.3;
  const std::size_t n = Dim == 3 ? 400 : 200;
  auto p = random_matter<Dim>(n, 33, true, 1.2);
  // The cloud reaches from -0.3 to 0.7 of its edge.
  const double edge = spacing * std::pow(static_cast<double>(n), 1.0 / Dim);
  settings.rules.boundary = {kinds, {-0.3 * edge, -0.3 * edge, -0.3 * edge}, {0.7 * edge, 0.7 * edge, 0.7 * edge}};
  settings.rules.pieces = solid ? std::vector{2, 2} : std::vector{0, 0};
  settings.rules.sizes = {spacing, spacing};
  settings.contacts = solid;
  Particles<Dim> all;
  const auto copies = with_copies(p, settings.rules.boundary, all);
  const Reference<Dim> reference(all, settings, copies);
  const auto lists = run_rates(p, settings);
  ASSERT_GT(lists.images().size(), n / 4);
  for (std::size_t i = 0; i < n; ++i) {
    const Sums<Dim> sums = reference.rates(i);
    const double tolerance = precision == Precision::mixed ? 3e-6 : 1e-12;
    EXPECT_LT((p.vector(Field::acceleration, i) - sums.acceleration).norm(), tolerance * sums.acceleration_scale);
    EXPECT_NEAR(p.column(Field::heating)[i], sums.heating, tolerance * sums.heating_scale);
    EXPECT_LT((velocity_gradient_of(p, i) - sums.gradient).norm(), tolerance * sums.gradient_scale);
  }
  const auto closed = [](BoundaryKind kind) { return kind == BoundaryKind::open || kind == BoundaryKind::periodic; };
  // An image's position is rounded once more than its source's, hence not to the last bit.
  if (std::ranges::all_of(kinds, closed)) {
    EXPECT_LT(balance_of(p).momentum, precision == Precision::mixed ? 1e-8 : 1e-13);
  }
}

TEST(PairPass, ImagesActLikeCopiesOfTheirSources) {
  using enum BoundaryKind;
  for (const bool solid : {false, true})
    for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
      SCOPED_TRACE(testing::Message() << "solid " << solid << ", precision " << static_cast<int>(precision));
      expect_images_act_like_copies<2>({periodic, periodic, open}, precision, solid);
      expect_images_act_like_copies<2>({reflecting, periodic, open}, precision, solid);
      expect_images_act_like_copies<3>({periodic, open, reflecting}, precision, solid);
      expect_images_act_like_copies<3>({reflecting, symmetry, reflecting}, precision, solid);
    }
}

}  // namespace
}  // namespace ejecta
