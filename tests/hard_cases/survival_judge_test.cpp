/// The measure that the survival table (tests/report) puts beside the density: mass over spacing^Dim of near
/// neighbours.

#include "report/survival_judge.hpp"

#include <gtest/gtest.h>

#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

template <int Dim>
std::unique_ptr<Sph<Dim>> block(const std::vector<std::string>& settings) {
  std::string text = R"([scene]
name = "block"
dimension = )" + std::to_string(Dim) +
                     R"(
[resolution]
spacing = "1 mm"
[time]
end = "1 us"
[[bodies]]
name = "block"
material = "basalt"
)" +
                     (Dim == 2 ? "shape = \"rectangle\"\nsize = [\"11 mm\", \"11 mm\"]\n"
                               : "shape = \"box\"\nsize = [\"9 mm\", \"9 mm\", \"9 mm\"]\n");
  return start<Dim>(text, settings);
}

/// On the lattice 1 everywhere; a thinned particle is found where it has neighbours on all sides, and not at the face.
template <int Dim>
void finds_a_thin_particle(const std::vector<std::string>& settings) {
  const auto sim = block<Dim>(settings);
  auto& p = sim->particles;
  std::size_t centre = 0, face = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.vector(Field::position, i).norm() < p.vector(Field::position, centre).norm()) centre = i;
    if (p.column(Field::position, 0)[i] > p.column(Field::position, 0)[face]) face = i;
  }
  for (const double ratio : survival::density_ratios(p, sim->scene.numerics.nodes_per_h)) EXPECT_NEAR(ratio, 1, 1e-6);
  p.column(Field::density)[centre] *= 0.2;
  p.column(Field::density)[face] *= 0.2;
  const std::vector<double> ratios = survival::density_ratios(p, sim->scene.numerics.nodes_per_h);
  EXPECT_NEAR(ratios[centre], 0.2, 1e-6);
  EXPECT_EQ(ratios[face], 1);
  EXPECT_EQ(std::ranges::count_if(ratios, [](double r) { return std::abs(r - 1) > 1e-6; }), 1);
}

TEST(SurvivalJudge, FindsAThinParticleOnTheSquareLattice) { finds_a_thin_particle<2>({}); }
TEST(SurvivalJudge, FindsAThinParticleOnTheCubicLattice) { finds_a_thin_particle<3>({}); }
TEST(SurvivalJudge, FindsAThinParticleWithEllipsoids) { finds_a_thin_particle<2>({"numerics.scheme=asph"}); }

/// A block compressed to half its width, density left as it was: half of mass over spacing^2.
TEST(SurvivalJudge, SeesADensityThatDoesNotFollow) {
  const auto sim = block<2>({});
  auto& p = sim->particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (int a = 0; a < 2; ++a) p.column(Field::position, a)[i] *= std::sqrt(0.5);
  for (double& h : p.column(Field::smoothing_length)) h *= std::sqrt(0.5);
  EXPECT_NEAR(std::ranges::min(survival::density_ratios(p, sim->scene.numerics.nodes_per_h)), 0.5, 1e-6);
}

}  // namespace
}  // namespace ejecta
