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
    for (std::size_t c = 0, before = copies.size(); c < before; ++c)
      for (const bool upper : {false, true}) {
        const BoundaryKind kind = upper ? boundary.upper[k] : boundary.lower[k];
        if (kind == BoundaryKind::open) continue;
        Copy<Dim> copy = copies[c];
        Vec<Dim> x = places[c];
        if (kind == BoundaryKind::periodic) {
          x[a] += (upper ? 1 : -1) * (boundary.max[k] - boundary.min[k]);
        } else {
          x[a] = 2 * (upper ? boundary.max[k] : boundary.min[k]) - x[a];
          copy.sign[a] = -1;
          copy.behind_wall |= kind == BoundaryKind::reflecting;
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
void expect_images_act_like_copies(const std::array<BoundaryKind, 3>& lower, const std::array<BoundaryKind, 3>& upper,
                                   Precision precision, bool solid) {
  auto settings = settings_of(Kernel::wendland_c2, precision, true, true);
  settings.friction = 0.3;
  const std::size_t n = Dim == 3 ? 400 : 200;
  auto p = random_matter<Dim>(n, 33, true, 1.2);
  // The cloud reaches from -0.3 to 0.7 of its edge.
  const double edge = spacing * std::pow(static_cast<double>(n), 1.0 / Dim);
  const Boundary boundary{lower, upper, {-0.3 * edge, -0.3 * edge, -0.3 * edge}, {0.7 * edge, 0.7 * edge, 0.7 * edge}};
  settings.rules.pieces = solid ? std::vector{2, 2} : std::vector{0, 0};
  settings.rules.sizes = {spacing, spacing};
  settings.contacts = solid;
  Particles<Dim> all;
  const auto copies = with_copies(p, boundary, all);
  const Reference<Dim> reference(all, settings, copies);
  const auto lists = run_rates(p, settings, boundary);
  ASSERT_GT(lists.ghosts().size(), lower == upper ? n / 4 : n / 8);  // half as many behind one face of two
  for (std::size_t i = 0; i < n; ++i) {
    const Sums<Dim> sums = reference.rates(i);
    const double tolerance = precision == Precision::mixed ? 3e-6 : 1e-12;
    EXPECT_LT((p.vector(Field::acceleration, i) - sums.acceleration).norm(), tolerance * sums.acceleration_scale);
    EXPECT_NEAR(p.column(Field::specific_energy_rate)[i], sums.heating, tolerance * sums.heating_scale);
    EXPECT_LT((velocity_gradient_of(p, i) - sums.gradient).norm(), tolerance * sums.gradient_scale);
  }
  // A ghost's position is rounded once more than its source's, hence not to the last bit.
  if (!boundary.any(mirrors)) {
    EXPECT_LT(balance_of(p).momentum, precision == Precision::mixed ? 1e-8 : 1e-13);
  }
}

TEST(PairPass, ImagesActLikeCopiesOfTheirSources) {
  using enum BoundaryKind;
  for (const bool solid : {false, true})
    for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
      SCOPED_TRACE(testing::Message() << "solid " << solid << ", precision " << static_cast<int>(precision));
      const auto alike = [&]<int Dim>(const std::array<BoundaryKind, 3>& kinds) {
        expect_images_act_like_copies<Dim>(kinds, kinds, precision, solid);
      };
      alike.operator()<2>({periodic, periodic, open});
      alike.operator()<2>({reflecting, periodic, open});
      alike.operator()<3>({periodic, open, reflecting});
      alike.operator()<3>({reflecting, symmetry, reflecting});
      expect_images_act_like_copies<2>({reflecting, open, open}, {open, symmetry, open}, precision, solid);
      expect_images_act_like_copies<3>({reflecting, periodic, open}, {symmetry, periodic, reflecting}, precision,
                                       solid);
    }
}

/// The last third of a cloud, by their ids, as guests: what the others feel must be the same as from their own kind.
template <int Dim>
void expect_guests_act_like_own(Precision precision, bool solid, const Boundary& boundary) {
  auto settings = settings_of(Kernel::wendland_c2, precision, solid, false);
  settings.gradient_correction = false;  // nobody knows the surroundings of a guest
  const std::size_t n = 300, own = 200;
  auto together = random_matter<Dim>(n, 34, solid, 1.2);
  Particles<Dim> host, guest;
  for (Particles<Dim>* part : {&host, &guest}) {
    const std::size_t first = part == &host ? 0 : own, count = part == &host ? own : n - own;
    part->allocate(count, together.fields());
    for (const Field f : together.fields())
      for (int k = 0; k < components(info(f).shape, Dim); ++k)
        std::ranges::copy(together.column(f, k).subspan(first, count), part->column(f, k).begin());
    for (const Label label : {Label::id, Label::body, Label::material})
      std::ranges::copy(together.label(label).subspan(first, count), part->label(label).begin());
    part->set_material_ranges({{0, count}});
  }
  run_rates(together, settings, boundary);
  const auto lists = run_rates(host, settings, boundary, Guests<Dim>{&guest});
  ASSERT_GE(lists.ghosts().size(), n - own);
  const double tolerance = precision == Precision::mixed ? 3e-6 : 1e-12;
  double scale = 0, heat_scale = 0;
  for (std::size_t i = 0; i < own; ++i) {
    scale = std::max(scale, together.vector(Field::acceleration, i).norm());
    heat_scale = std::max(heat_scale, std::abs(together.column(Field::specific_energy_rate)[i]));
  }
  for (std::size_t i = 0; i < own; ++i) {
    EXPECT_LT((host.vector(Field::acceleration, i) - together.vector(Field::acceleration, i)).norm(),
              tolerance * scale);
    EXPECT_NEAR(host.column(Field::specific_energy_rate)[i], together.column(Field::specific_energy_rate)[i],
                tolerance * heat_scale);
  }
}

TEST(PairPass, GuestsActLikeOwnParticles) {
  using enum BoundaryKind;
  Boundary corner;  // guests have mirror images too
  corner.lower[0] = symmetry;
  corner.min[0] = -2 * spacing;
  for (const Boundary& boundary : {Boundary{}, corner})
    for (const bool solid : {false, true})
      for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
        SCOPED_TRACE(testing::Message() << "solid " << solid << ", precision " << static_cast<int>(precision));
        expect_guests_act_like_own<2>(precision, solid, boundary);
        expect_guests_act_like_own<3>(precision, solid, boundary);
      }
}

}  // namespace
}  // namespace ejecta
