#include "sph/detonation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/errors.hpp"
#include "sph/assemble.hpp"
#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

/// Of the shipped explosives [m/s].
constexpr double slow = 7600, fast = 8820;

std::string scene_with(const std::string& spacing, int dimension, const std::string& rest) {
  return "[scene]\nname = \"lit\"\ndimension = " + std::to_string(dimension) + "\n[resolution]\nspacing = \"" +
         spacing + "\"\n[time]\nend = \"1 us\"\n" + rest;
}
std::string rectangle(const std::string& name, const std::string& material, const std::string& center,
                      const std::string& size) {
  return "[[bodies]]\nname = \"" + name + "\"\nmaterial = \"" + material +
         "\"\nshape = \"rectangle\"\ncenter = " + center + "\nsize = " + size + "\n";
}

template <int Dim>
struct Lit {
  std::vector<Placement<Dim>> particles;
  std::vector<double> times;
};
template <int Dim>
Lit<Dim> light(const std::string& text) {
  const Scene scene = parse_scene(text, "test.toml");
  const auto materials = read_materials(scene, EJECTA_SOURCE_DIR "/inputs/materials").list;
  Lit<Dim> lit;
  lit.particles = place_bodies<Dim>(scene, materials, number_materials(scene, materials));
  lit.times = lighting_times<Dim>(scene, materials, lit.particles);
  return lit;
}
/// Largest error of lit times in lengths of the slower explosive [m].
template <int Dim, class Exact>
double largest_error(const Lit<Dim>& lit, const Exact& exact) {
  double worst = 0;
  for (std::size_t i = 0; i < lit.times.size(); ++i)
    worst = std::max(worst, slow * std::abs(lit.times[i] - exact(lit.particles[i].x)));
  return worst;
}

TEST(Detonation, RunsStraightWhereNothingIsInTheWay) {
  const std::string block = rectangle("block", "lx_17", "[0, 0]", "[\"20 mm\", \"10 mm\"]");
  const auto point = light<2>(scene_with("0.5 mm", 2,
                                         block + "[[detonators]]\nposition = [\"-10 mm\", \"1 mm\"]\n"
                                                 "time = \"2 us\"\n"));
  EXPECT_LT(largest_error(point, [](const Vec<2>& x) { return 2e-6 + (x - Vec<2>(-0.01, 0.001)).norm() / slow; }),
            1e-12);
  const auto plane = light<2>(scene_with("0.5 mm", 2,
                                         block + "[[detonators]]\nshape = \"plane\"\nposition = [\"-10 mm\", 0]\n"
                                                 "normal = [2, 0]\n"));
  EXPECT_LT(largest_error(plane, [](const Vec<2>& x) { return (x[0] + 0.01) / slow; }), 1e-12);
  const auto line = light<2>(scene_with("0.5 mm", 2,
                                        block + "[[detonators]]\nshape = \"line\"\nposition = [0, 0]\n"
                                                "end = [\"4 mm\", 0]\n"));
  EXPECT_LT(
      largest_error(line, [](const Vec<2>& x) { return (x - Vec<2>(std::clamp(x[0], 0.0, 0.004), 0)).norm() / slow; }),
      1e-12);
}

TEST(Detonation, RunsStraightInThreeDimensionsFromTheNearestOfTwo) {
  const auto lit = light<3>(scene_with("1 mm", 3,
                                       "[[bodies]]\nname = \"stick\"\nmaterial = \"lx_17\"\nshape = \"cylinder\"\n"
                                       "radius = \"4 mm\"\nlength = \"12 mm\"\naxis = [1, 0, 0]\n"
                                       "[[detonators]]\nposition = [\"-6 mm\", 0, 0]\n"
                                       "[[detonators]]\nposition = [\"6 mm\", \"1 mm\", 0]\ntime = \"0.3 us\"\n"));
  EXPECT_GT(lit.times.size(), 500u);
  EXPECT_LT(largest_error(lit,
                          [](const Vec<3>& x) {
                            return std::min((x - Vec<3>(-0.006, 0, 0)).norm() / slow,
                                            0.3e-6 + (x - Vec<3>(0.006, 0.001, 0)).norm() / slow);
                          }),
            1e-12);
}

/// An L: from the end of one arm the detonation turns at the inner corner (0, 0).
double error_behind_a_corner(const std::string& spacing) {
  const auto lit =
      light<2>(scene_with(spacing, 2,
                          rectangle("low", "lx_17", "[0, \"-2 mm\"]", "[\"24 mm\", \"4 mm\"]") +
                              rectangle("high", "lx_17", "[\"6 mm\", \"6 mm\"]", "[\"12 mm\", \"12 mm\"]") +
                              "[[detonators]]\nposition = [\"-12 mm\", \"-2 mm\"]\n"));
  const Vec<2> start(-0.012, -0.002);
  int shadowed = 0;
  const double error = largest_error(lit, [&](const Vec<2>& x) {
    const bool seen = x[1] <= 0 || x[1] / x[0] <= 0.002 / 0.012;
    shadowed += !seen;
    return (seen ? (x - start).norm() : start.norm() + x.norm()) / slow;
  });
  EXPECT_GT(shadowed, static_cast<int>(lit.times.size()) / 3);
  return error;
}

TEST(Detonation, TurnsAtCorners) {
  const double coarse = error_behind_a_corner("0.5 mm"), fine = error_behind_a_corner("0.25 mm");
  EXPECT_LT(coarse, 0.5 * 0.5e-3);
  EXPECT_LT(fine, 0.5 * 0.25e-3);
  EXPECT_LT(fine, 0.7 * coarse);
}

/// Half of a ring, lit at one end: tangents to the hole, then along its edge.
TEST(Detonation, RunsRoundAHole) {
  const auto error = [](const std::string& spacing) {
    const auto lit = light<2>(scene_with(spacing, 2,
                                         "[[bodies]]\nname = \"ring\"\nmaterial = \"lx_17\"\nshape = \"disc\"\n"
                                         "radius = \"10 mm\"\ninner_radius = \"5 mm\"\n"
                                         "[[detonators]]\nposition = [\"-10 mm\", 0]\n"));
    constexpr double hole = 0.005, far = 0.010;
    return largest_error(lit, [&](const Vec<2>& x) {
      const double turned = std::numbers::pi - std::abs(std::atan2(x[1], x[0]));
      const double hidden = std::acos(hole / far), r = std::max(x.norm(), hole), own = std::acos(hole / r);
      if (turned <= hidden + own) return (x - Vec<2>(-far, 0)).norm() / slow;
      const double tangents = std::sqrt(far * far - hole * hole) + std::sqrt(r * r - hole * hole);
      return (tangents + hole * (turned - hidden - own)) / slow;
    });
  };
  const double coarse = error("0.5 mm"), fine = error("0.25 mm");
  EXPECT_LT(coarse, 1.0 * 0.5e-3);
  EXPECT_LT(fine, 1.0 * 0.25e-3);  // every turn along the hole is at a particle, half a spacing out
}

/// Time from (0, 0) to x by Fermat, the explosive below y = 4 mm being the faster one.
double refracted(const Vec<2>& x) {
  constexpr double face = 0.004;
  if (x[1] <= face) return x.norm() / fast;
  const auto time = [&](double s) { return std::hypot(s, face) / fast + std::hypot(x[0] - s, x[1] - face) / slow; };
  double low = std::min(0.0, x[0]), high = std::max(0.0, x[0]);
  for (int k = 0; k < 200; ++k) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (time(a) < time(b) ? high : low) = time(a) < time(b) ? b : a;
  }
  return time(0.5 * (low + high));
}

TEST(Detonation, PassesFromABoosterToTheMainChargeByFermat) {
  const auto error = [](const std::string& spacing) {
    return largest_error(light<2>(scene_with(spacing, 2,
                                             rectangle("booster", "lx_10", "[0, \"2 mm\"]", "[\"24 mm\", \"4 mm\"]") +
                                                 rectangle("main", "lx_17", "[0, \"8 mm\"]", "[\"24 mm\", \"8 mm\"]") +
                                                 "[[detonators]]\nposition = [0, 0]\n")),
                         refracted);
  };
  const double coarse = error("0.5 mm"), fine = error("0.25 mm");
  EXPECT_LT(coarse, 0.1 * 0.5e-3);
  EXPECT_LT(fine, 0.6 * coarse);
}

TEST(Detonation, DoesNotReachWhatIsApart) {
  const auto lit = light<2>(scene_with("0.5 mm", 2,
                                       rectangle("lit", "lx_17", "[0, 0]", "[\"8 mm\", \"4 mm\"]") +
                                           rectangle("apart", "lx_17", "[\"10 mm\", 0]", "[\"8 mm\", \"4 mm\"]") +
                                           rectangle("inert", "copper", "[\"5 mm\", 0]", "[\"2 mm\", \"4 mm\"]") +
                                           "[[detonators]]\nposition = [\"-4 mm\", 0]\n"));
  for (std::size_t i = 0; i < lit.times.size(); ++i) {
    const double x = lit.particles[i].x[0];
    if (lit.particles[i].body == 2)
      EXPECT_EQ(lit.times[i], 0);
    else
      EXPECT_EQ(std::isinf(lit.times[i]), x > 0.005);
  }
}

std::vector<std::string> refused(const std::string& text) {
  try {
    start<2>(text);
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}

TEST(Detonation, RefusesDetonatorsThatLightNothing) {
  const std::string block = rectangle("block", "lx_17", "[0, 0]", "[\"20 mm\", \"10 mm\"]");
  using One = std::vector<std::string>;
  EXPECT_EQ(
      refused(scene_with("0.5 mm", 2, block + "[[detonators]]\nposition = [0, \"9 mm\"]\n")),
      One{"test.toml:14: detonators: expected one that touches an explosive, got one 4.257 mm from the nearest of "
          "its particles"});
  EXPECT_EQ(refused(scene_with("0.5 mm", 2,
                               rectangle("block", "copper", "[0, 0]", "[\"20 mm\", \"10 mm\"]") +
                                   "[[detonators]]\nposition = [0, 0]\n")),
            One{"test.toml:14: detonators: no body is of an explosive"});
}

TEST(Detonation, SaysWhatIsNeverLit) {
  const auto sph = start<2>(scene_with("0.5 mm", 2,
                                       rectangle("lit", "lx_17", "[0, 0]", "[\"8 mm\", \"4 mm\"]") +
                                           rectangle("apart", "lx_17", "[\"10 mm\", 0]", "[\"8 mm\", \"4 mm\"]") +
                                           "[[detonators]]\nposition = [\"-4 mm\", 0]\n"));
  const auto remarks = sph->remarks_at_start();
  ASSERT_EQ(remarks.size(), 2u);
  EXPECT_NE(remarks[0].text.find("the run ends at 1 us, before all of it has been lit at"), std::string::npos);
  EXPECT_EQ(remarks[1].text,
            "apart: no way leads from a detonator to 128 of its 128 particles (lx_17): only what "
            "compresses them will burn them");
  EXPECT_TRUE(remarks[1].worrying);
}

}  // namespace
}  // namespace ejecta
