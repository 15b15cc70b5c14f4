#include <gtest/gtest.h>

#include <cstring>

#include "particles/smoothing_metric.hpp"
#include "unit/base/thread_counts.hpp"
#include "unit/schemes/reference_pass.hpp"

namespace ejecta {
namespace {

/// Random matter with ellipsoids, and if asked for with cracks.
template <int Dim>
Particles<Dim> tensor_matter(std::size_t n, unsigned seed, bool stress, bool cracks) {
  const auto plain = random_matter<Dim>(n, seed, stress);
  std::vector<Field> fields = plain.fields();
  fields.push_back(Field::smoothing_metric);
  if (cracks) fields.insert(fields.end(), {Field::damage_tensor, Field::uncut_gradient});
  Particles<Dim> p;
  p.allocate(n, fields);
  for (const Field f : plain.fields())
    for (int k = 0; k < components(info(f).shape, Dim); ++k)
      std::ranges::copy(plain.column(f, k), p.column(f, k).begin());
  for (const Label label : {Label::body, Label::material})
    std::ranges::copy(plain.label(label), p.label(label).begin());
  p.set_material_ranges(plain.material_ranges());
  random_ellipsoids(p, 4, seed + 2);
  Uniform uniform(seed + 3);
  for (std::size_t i = 0; cracks && i < n; ++i) {
    Vec<Dim> normal;
    for (int a = 0; a < Dim; ++a) normal[a] = uniform(-1, 1);
    normal.normalize();
    if (i % 3 != 0) p.set_symmetric(Field::damage_tensor, i, uniform(0, 1) * normal * normal.transpose());
  }
  return p;
}

PairPassSettings tensor_settings(Kernel kernel, Precision precision, bool stress, bool cracked) {
  PairPassSettings s = settings_of(kernel, precision, stress, stress);
  s.asph = true;
  s.cracked = cracked;
  if (cracked) s.rules.cut_by_cracks = {1, 1};
  return s;
}

template <int Dim>
void expect_formulas(std::size_t n, const PairPassSettings& settings) {
  SCOPED_TRACE(testing::Message() << Dim << "D, kernel " << static_cast<int>(settings.kernel) << ", precision "
                                  << static_cast<int>(settings.precision) << ", cracked " << settings.cracked);
  auto p = tensor_matter<Dim>(n, 41, settings.stress, settings.cracked);
  sort_in_space(p, cluster_size(settings.precision));
  const Reference<Dim> reference(p, settings);
  run_rates(p, settings);
  const double tolerance = settings.precision == Precision::mixed ? 2e-5 : 2e-13;
  for (std::size_t i = 0; i < n; ++i) {
    const Sums<Dim> sums = reference.rates(i);
    EXPECT_LT((p.vector(Field::acceleration, i) - sums.acceleration).norm(), tolerance * sums.acceleration_scale);
    EXPECT_NEAR(p.column(Field::specific_energy_rate)[i], sums.heating, tolerance * sums.heating_scale);
    EXPECT_NEAR(p.column(Field::zeroth_moment)[i] / sums.moment, 1, tolerance);
    EXPECT_NEAR(p.column(Field::largest_mu)[i], sums.approach, 10 * tolerance * std::max(sums.approach, 1.0));
    EXPECT_LT((velocity_gradient_of(p, i) - sums.gradient).norm(), 10 * tolerance * sums.gradient_scale);
    if (!settings.cracked) continue;
    EXPECT_LT((p.tensor(Field::uncut_gradient, i) - sums.uncut_gradient).norm(), 10 * tolerance * sums.gradient_scale);
  }
}

/// What the deviator strains by, behind no crack, is what it works on: stress that does not answer to a flow must not
/// work on it, or it would for ever.
template <int Dim>
void expect_work_of_strain(Precision precision) {
  auto settings = tensor_settings(Kernel::wendland_c2, precision, true, true);
  settings.viscosity_alpha = settings.viscosity_beta = 0;
  auto p = tensor_matter<Dim>(300, 43, true, true);
  sort_in_space(p, cluster_size(precision));
  run_rates(p, settings);
  const double tolerance = precision == Precision::mixed ? 1e-4 : 1e-12;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Mat<Dim> S = deviator_of(p, true, i), L = velocity_gradient_of(p, i),
                   uncut = p.tensor(Field::uncut_gradient, i);
    const double work = S.cwiseProduct(uncut).sum() - p.column(Field::pressure)[i] * L.trace();
    const double scale = S.norm() * uncut.norm() + std::abs(p.column(Field::pressure)[i]) * L.norm();
    EXPECT_NEAR(p.column(Field::density)[i] * p.column(Field::specific_energy_rate)[i], work, tolerance * scale);
  }
}

TEST(AnisotropicPass, TheDeviatorWorksOnTheStrainThatItAnswersTo) {
  expect_work_of_strain<2>(Precision::double_precision);
  expect_work_of_strain<3>(Precision::double_precision);
}

TEST(AnisotropicPass, RatesAreTheFormulas) {
  for (const Kernel kernel : {Kernel::cubic_spline, Kernel::quintic_spline, Kernel::wendland_c2, Kernel::wendland_c4})
    for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
      expect_formulas<2>(150, tensor_settings(kernel, precision, true, false));
      expect_formulas<3>(150, tensor_settings(kernel, precision, true, false));
    }
  expect_formulas<3>(150, tensor_settings(Kernel::wendland_c2, Precision::double_precision, false, false));
}

TEST(AnisotropicPass, RatesAreTheFormulasWithCracks) {
  for (const Precision precision : {Precision::double_precision, Precision::mixed})
    for (const bool corrected : {false, true}) {
      auto settings = tensor_settings(Kernel::wendland_c2, precision, true, true);
      settings.gradient_correction = corrected;
      expect_formulas<2>(150, settings);
      expect_formulas<3>(150, settings);
    }
}

TEST(AnisotropicPass, RoundEllipsoidsGiveWhatSmoothingLengthsGive) {
  auto p = tensor_matter<3>(300, 42, true, false);
  for (std::size_t i = 0; i < p.size(); ++i)
    p.set_symmetric(Field::smoothing_metric, i, round_metric<3>(p.column(Field::smoothing_length)[i]));
  auto q = random_matter<3>(300, 42, true);
  auto tensor = tensor_settings(Kernel::wendland_c4, Precision::double_precision, true, false), plain = tensor;
  plain.asph = false;
  // The viscosities differ where h_i != h_j: one takes the mean of h, the other that of r/h.
  tensor.viscosity_alpha = tensor.viscosity_beta = plain.viscosity_alpha = plain.viscosity_beta = 0;
  run_rates(p, tensor);
  run_rates(q, plain);
  const Reference<3> reference(p, tensor);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double scale = reference.rates(i).acceleration_scale;
    EXPECT_LT((p.vector(Field::acceleration, i) - q.vector(Field::acceleration, i)).norm(), 1e-13 * scale);
  }
}

TEST(AnisotropicPass, DensityIsTheSumOverTheMassesInTheEllipsoid) {
  auto p = tensor_matter<3>(200, 44, false, false);
  const auto settings = tensor_settings(Kernel::wendland_c2, Precision::double_precision, false, false);
  PairLists<3> lists;
  lists.build(p, {2, cluster_size(settings.precision), 0, {}});
  make_pair_pass<3>(settings)->density(p, lists);
  // det(H) is taken from the smoothing length, to which the ellipsoids belong.
  const Reference<3> reference(p, settings);
  for (std::size_t i = 0; i < p.size(); ++i)
    EXPECT_NEAR(p.column(Field::density)[i] / reference.rates(i).density, 1, 1e-12);
}

TEST(AnisotropicPass, EveryThreadCountGivesTheSameBits) {
  const auto settings = tensor_settings(Kernel::wendland_c4, Precision::mixed, true, true);
  std::vector<Particles<2>> results;
  for_thread_counts([&](int) {
    auto p = tensor_matter<2>(2000, 45, true, true);
    sort_in_space(p, cluster_size(settings.precision));
    run_rates(p, settings);
    results.push_back(std::move(p));
  });
  for (const auto& other : results)
    for (const Field f :
         {Field::acceleration, Field::specific_energy_rate, Field::velocity_gradient, Field::uncut_gradient})
      for (int k = 0; k < components(info(f).shape, 2); ++k)
        EXPECT_EQ(std::memcmp(results[0].column(f, k).data(), other.column(f, k).data(), 2000 * sizeof(double)), 0);
}

TEST(CrackedStress, NoTractionAcrossAndAllAlong) {
  Mat<3> s;
  s << 1, 2, 3, 2, -4, 5, 3, 5, 3;
  const Vec<3> n = Vec<3>(1, -2, 0.5).normalized(), along = n.unitOrthogonal();
  const Mat<3> cut = transmitted<3>(s, n * n.transpose());
  EXPECT_LT((cut * n).norm(), 1e-7);  // the square root of a round-off
  EXPECT_NEAR(along.dot(cut * along), along.dot(s * along), 1e-12);
  EXPECT_LT((transmitted<3>(s, 0.3 * Mat<3>::Identity()) - 0.7 * s).norm(), 1e-13);
  EXPECT_NEAR(n.dot(transmitted<3>(s, 0.6 * n * n.transpose()) * n), 0.4 * n.dot(s * n), 1e-12);
}

}  // namespace
}  // namespace ejecta
