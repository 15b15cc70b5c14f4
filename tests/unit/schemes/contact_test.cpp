#include <gtest/gtest.h>

#include "unit/schemes/reference_pass.hpp"

namespace ejecta {
namespace {

PairPassSettings solid_settings(Precision precision = Precision::double_precision) {
  return settings_of(Kernel::wendland_c2, precision, true, true);
}

template <int Dim>
void expect_formulas(PairPassSettings settings, double h_share) {
  std::vector<Field> more;
  if (settings.asph) more.push_back(Field::smoothing_metric);
  auto p = random_matter<Dim>(300, 51, true, 1.5, more);
  for (double& h : p.column(Field::smoothing_length)) h *= h_share;
  if (settings.asph) random_ellipsoids(p, 3, 52);
  split_in_two(p, settings);
  sort_in_space(p, cluster_size(settings.precision));
  const Reference<Dim> reference(p, settings);
  run_rates(p, settings);
  // Contact sets in over a fiftieth of what fills the support, so that round-off there counts fifty times.
  const double tolerance = settings.precision == Precision::mixed ? 5e-5 : 5e-13;
  std::size_t pressed = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Sums<Dim> sums = reference.rates(i);
    pressed += !reference.press(i).isZero(0);
    EXPECT_LE((p.vector(Field::acceleration, i) - sums.acceleration).norm(), tolerance * sums.acceleration_scale);
    EXPECT_LE(std::abs(p.column(Field::specific_energy_rate)[i] - sums.heating), tolerance * sums.heating_scale);
    EXPECT_LE((velocity_gradient_of(p, i) - sums.gradient).norm(), 10 * tolerance * sums.gradient_scale);
  }
  EXPECT_GT(pressed, 10u);
}

TEST(Contact, RatesAreTheFormulas) {
  for (const Precision precision : {Precision::double_precision, Precision::mixed})
    for (const bool asph : {false, true})
      for (const double friction : {0.0, 0.5})
        for (const double share : {1.0, 0.5}) {
          auto settings = solid_settings(precision);
          settings.asph = asph;
          settings.friction = friction;
          SCOPED_TRACE(testing::Message() << "asph " << asph << ", friction " << friction << ", precision "
                                          << static_cast<int>(precision) << ", supports of " << share);
          expect_formulas<2>(settings, share);
          expect_formulas<3>(settings, share);
        }
}

/// Else a run that is restarted, and makes its lists anew, would go another way.
TEST(Contact, NoBitDependsOnHowFarTheListsReach) {
  for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
    auto settings = solid_settings(precision);
    settings.friction = 0.3;
    std::vector<Particles<2>> results;
    for (const double horizon : {0.0, 0.02 * spacing}) {  // at 100 m/s: two spacings further
      auto p = random_matter<2>(2000, 55, true);
      split_in_two(p, settings);
      sort_in_space(p, cluster_size(precision));
      PairLists<2> lists;
      lists.build(p, {kernel_support(settings.kernel), cluster_size(precision), horizon, {}});
      make_pair_pass<2>(settings)->rates(p, lists);
      results.push_back(std::move(p));
    }
    for (const Field f :
         {Field::acceleration, Field::specific_energy_rate, Field::velocity_gradient, Field::zeroth_moment})
      for (int k = 0; k < components(info(f).shape, 2); ++k)
        EXPECT_TRUE(std::ranges::equal(results[0].column(f, k), results[1].column(f, k))) << info(f).name;
  }
}

TEST(Contact, APairOfTwoPiecesNeverPulls) {
  Uniform uniform(53);
  std::size_t pushed = 0, let_go = 0;
  for (unsigned trial = 0; trial < 1000; ++trial) {
    auto settings = solid_settings();
    settings.asph = trial % 2;
    std::vector<Field> more;
    if (settings.asph) more.push_back(Field::smoothing_metric);
    auto p = random_matter<3>(2, trial, true, 2, more);
    if (settings.asph) random_ellipsoids(p, 2, trial);
    split_in_two(p, settings);
    for (std::size_t i = 0; i < 2; ++i) {
      p.label(Label::body)[i] = static_cast<std::int32_t>(i);
      p.column(Field::density)[i] *= 0.2;  // voluminous enough for a contact at all
      p.column(Field::pressure)[i] = uniform(-1e9, 1e9);
    }
    run_rates(p, settings);
    const Vec<3> x = p.vector(Field::position, 1) - p.vector(Field::position, 0), a = p.vector(Field::acceleration, 0);
    EXPECT_LE(a.dot(x), 1e-12 * a.norm() * x.norm());
    ++(a.isZero(0) ? let_go : pushed);
  }
  EXPECT_GT(pushed, 100u);
  EXPECT_GT(let_go, 100u);
}

constexpr double overlap = 0.05 * spacing;  ///< presses the faces well into contact

/// Two layers of a square lattice, 8 thick and without end along y, face to face near x = 0 with `gap` between their
/// surfaces, at rest under the pressures given. Body 0 is to the left.
Particles<2> layers(double left_pressure, double right_pressure, double gap = -overlap) {
  constexpr int wide = 16, high = 12;
  auto p = random_matter<2>(wide * high, 54, true);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const int column = static_cast<int>(i) / high, row = static_cast<int>(i) % high;
    const bool right = column >= wide / 2;
    p.label(Label::body)[i] = right;
    p.label(Label::material)[i] = 0;
    p.set_vector(Field::position, i,
                 spacing * Vec<2>(column + 0.5 - wide / 2, row + 0.5 - high / 2) + Vec<2>(right ? gap : 0, 0));
    p.set_vector(Field::velocity, i, Vec<2>::Zero());
    p.column(Field::smoothing_length)[i] = 1.5 * spacing;
    p.column(Field::density)[i] = 2000;
    p.column(Field::mass)[i] = 2000 * spacing * spacing;
    p.column(Field::sound_speed)[i] = 2000;
    p.column(Field::viscosity_factor)[i] = 1;
    p.column(Field::pressure)[i] = right ? right_pressure : left_pressure;
    for (int k = 0; k < 3; ++k) p.column(Field::deviatoric_stress, k)[i] = 0;
  }
  return p;
}
PairPassSettings layer_settings() {
  auto settings = solid_settings();
  settings.rules.sizes = {spacing, spacing};
  settings.rules.pieces = {2, 3};
  settings.contacts = true;
  return settings;
}
/// Open along x, periodic along y.
Boundary layer_boundary() {
  Boundary boundary;
  boundary.lower[1] = boundary.upper[1] = BoundaryKind::periodic;
  boundary.min = {-1, -6 * spacing, 0};
  boundary.max = {1, 6 * spacing, 0};
  return boundary;
}
Vec<2> force_on_left(const Particles<2>& p) {
  Vec<2> force = Vec<2>::Zero();
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.label(Label::body)[i] == 0) force += p.column(Field::mass)[i] * p.vector(Field::acceleration, i);
  return force;
}
constexpr double face = 12 * spacing;  // per metre of depth

TEST(Contact, PressedBodiesPushWithTheirPressureAndStretchedOnesLetGo) {
  auto pressed = layers(1e9, 1e9), stretched = layers(-1e9, -1e9), apart = layers(1e9, 1e9, 0.2 * spacing);
  for (auto* p : {&pressed, &stretched, &apart}) run_rates(*p, layer_settings(), layer_boundary());
  EXPECT_NEAR(force_on_left(pressed)[0] / (-1e9 * face), 1, 0.1);
  EXPECT_LT(std::abs(force_on_left(stretched)[0]), 1e-12 * 1e9 * face);
  EXPECT_LT(std::abs(force_on_left(apart)[0]), 1e-12 * 1e9 * face) << "a fifth of a spacing is no contact";
  // As one piece they hold together.
  auto one = layer_settings();
  one.rules.pieces = {2, 2};
  auto held = layers(-1e9, -1e9, 0);
  run_rates(held, one, layer_boundary());
  EXPECT_NEAR(force_on_left(held)[0] / (1e9 * face), 1, 0.1);
}

TEST(Contact, SlidingBodiesAreNeitherBrakedNorShearedWithoutFriction) {
  const auto slide = [](double friction, double speed) {
    auto p = layers(1e9, 1e9);
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p.label(Label::body)[i] == 1) p.column(Field::velocity, 1)[i] = speed;
    auto settings = layer_settings();
    settings.friction = friction;
    run_rates(p, settings, layer_boundary());
    return p;
  };
  const auto power = [](const Particles<2>& p) {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
      sum += p.column(Field::mass)[i] * p.column(Field::specific_energy_rate)[i];
    return sum;
  };
  const auto smooth = slide(0, 1000);
  const Vec<2> push = force_on_left(smooth);
  EXPECT_LT(std::abs(push[1]), 1e-9 * std::abs(push[0]));
  EXPECT_LT(std::abs(power(smooth)), 1e-9 * std::abs(push[0]) * 1000);
  for (std::size_t i = 0; i < smooth.size(); ++i)
    EXPECT_LT(velocity_gradient_of(smooth, i).norm(), 1e-9 * 1000 / spacing);
  // Friction drags the left body along with the right one, with a share of what presses, and heats by what it takes.
  for (const double speed : {1000.0, -1000.0}) {
    const auto rough = slide(0.3, speed);
    const Vec<2> drag = force_on_left(rough);
    EXPECT_NEAR(drag[1] / (-0.3 * drag[0]), speed > 0 ? 1 : -1, 0.01);
    EXPECT_NEAR(power(rough) / (drag[1] * speed), 1, 1e-9);
  }
  // Slowly it fades instead of turning about from step to step.
  const Vec<2> slow = force_on_left(slide(0.3, 1e-3));
  EXPECT_GT(slow[1], 0);
  EXPECT_LT(slow[1], 1e-3 * 0.3 * -slow[0]);
}

/// Its force is along the pair, whose ends may part by sliding where the gap closes.
TEST(Contact, ViscosityBetweenPiecesHeatsHoweverTheySlide) {
  for (const bool asph : {false, true}) {
    auto settings = solid_settings();
    settings.asph = asph;
    std::vector<Field> more;
    if (asph) more.push_back(Field::smoothing_metric);
    auto p = random_matter<3>(600, 57, true, 1.5, more);
    if (asph) random_ellipsoids(p, 2, 58);
    split_in_two(p, settings);
    std::ranges::fill(p.column(Field::pressure), 0);
    for (int k = 0; k < components(info(Field::deviatoric_stress).shape, 3); ++k)
      std::ranges::fill(p.column(Field::deviatoric_stress, k), 0);
    for (std::size_t i = 0; i < p.size(); ++i)
      p.set_vector(Field::velocity, i, p.label(Label::body)[i] == 0 ? Vec<3>(0, 0, 0) : Vec<3>(-30, 80, 50));
    run_rates(p, settings);
    const auto heating = p.column(Field::specific_energy_rate);
    const double most = std::ranges::max(heating);
    EXPECT_GT(most, 0);
    for (const double h : heating) EXPECT_GE(h, -1e-13 * most);
  }
}

TEST(Contact, TheSofterSideDecidesTheStressOfTheContact) {
  // A solid of impedance 4e6 against a gas of 600.
  const auto force = [](double solid, double gas) {
    auto p = layers(solid, gas);
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (p.label(Label::body)[i] == 0) continue;
      p.column(Field::density)[i] = 2;
      p.column(Field::mass)[i] = 2 * spacing * spacing;
      p.column(Field::sound_speed)[i] = 300;
    }
    run_rates(p, layer_settings(), layer_boundary());
    return -force_on_left(p)[0];
  };
  const double even = force(1e6, 1e6);
  EXPECT_NEAR((force(1e6, 2e6) - even) / even, 1, 1e-3) << "what the gas presses is all felt";
  EXPECT_NEAR((force(2e6, 1e6) - even) / even, 0, 1e-3) << "what the solid has too much is not";
}

TEST(Contact, AWallHoldsWhatPressesAndASymmetryPlaneAlsoWhatPulls) {
  const auto force = [](BoundaryKind kind, double pressure) {
    auto p = layers(pressure, pressure, 0);
    auto settings = layer_settings();
    settings.rules.pieces = {2, 2};
    Boundary boundary = layer_boundary();
    boundary.lower[0] = kind;  // the face opposite stays open
    boundary.min[0] = -8 * spacing + (kind == BoundaryKind::reflecting ? overlap : 0);
    run_rates(p, settings, boundary);
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += p.column(Field::mass)[i] * p.column(Field::acceleration)[i];
    return sum;
  };
  using enum BoundaryKind;
  EXPECT_NEAR(force(reflecting, 1e9) / (1e9 * face), 1, 0.1);
  EXPECT_LT(std::abs(force(reflecting, -1e9)), 1e-12 * 1e9 * face);
  EXPECT_NEAR(force(symmetry, 1e9) / (1e9 * face), 1, 0.1);
  EXPECT_NEAR(force(symmetry, -1e9) / (-1e9 * face), 1, 0.1);
}

}  // namespace
}  // namespace ejecta
