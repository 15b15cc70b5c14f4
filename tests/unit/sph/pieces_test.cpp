#include "sph/pieces.hpp"

#include <gtest/gtest.h>

#include "unit/sph/small_scenes.hpp"

namespace ejecta {
namespace {

/// One particle of each kind of matter in a row; `more` is put behind the body of that number.
const std::string row = R"([scene]
name = "row"
[resolution]
spacing = "1 mm"
[time]
end = "1 us"
)";
std::string body(const std::string& name, const std::string& material, int place, const std::string& more = "") {
  return "[[bodies]]\nname = \"" + name + "\"\nmaterial = \"" + material +
         "\"\nshape = \"box\"\nsize = [\"1 mm\", \"1 mm\", \"1 mm\"]\ncenter = [\"" + std::to_string(2 * place) +
         " mm\", 0, 0]\n" + more;
}

std::vector<int> pieces(const std::string& bodies, bool* touches = nullptr, const std::string& boundary = "") {
  const auto sim = start<3>(row + bodies + boundary);
  const auto pieces = pieces_of(sim->scene, sim->materials, sim->body_material);
  if (touches) *touches = anything_touches(sim->scene, pieces);
  return pieces;
}

TEST(Pieces, SolidBodiesAreTheirOwnAndFluidsAreShared) {
  bool touches = false;
  const auto p = pieces(body("rock", "pumice", 0) + body("ball", "nylon", 1) + body("stone", "pumice", 2) +
                            body("breeze", "air", 3, "pressure = \"1e5 Pa\"\n") +
                            body("gale", "air", 4, "pressure = \"2e5 Pa\"\n") + body("pond", "water", 5) +
                            body("lake", "water", 6),
                        &touches);
  EXPECT_NE(p[0], p[1]);
  EXPECT_NE(p[0], p[2]) << "of one material, but two bodies";
  EXPECT_EQ(p[3], p[4]);
  EXPECT_EQ(p[3], 0) << "the number that the images behind a wall go by";
  EXPECT_EQ(p[5], p[6]);
  EXPECT_NE(p[5], p[3]);
  for (const int solid : {0, 1, 2}) EXPECT_TRUE(p[solid] != p[3] && p[solid] != p[5]);
  EXPECT_TRUE(touches);
}

TEST(Pieces, WeldsAndGripsHold) {
  const auto welded = pieces(body("rock", "pumice", 0) + body("ball", "nylon", 1, "weld = \"rock\"\n") +
                             body("shell", "nylon", 2, "weld = \"ball\"\n") + body("far", "nylon", 3));
  EXPECT_EQ(welded[0], welded[1]);
  EXPECT_EQ(welded[1], welded[2]) << "one after the other";
  EXPECT_NE(welded[2], welded[3]);
  const auto driven = pieces(body("rod", "nylon", 0) + body("grip", "nylon", 1, "driven = true\n") +
                             body("anvil", "pumice", 2, "driven = true\n"));
  EXPECT_EQ(driven[0], driven[1]) << "a grip holds what is of its material";
  EXPECT_NE(driven[0], driven[2]) << "an anvil does not";
  const auto loose = pieces(body("rod", "nylon", 0) + body("grip", "nylon", 1, "driven = true\nweld = \"none\"\n"));
  EXPECT_NE(loose[0], loose[1]);
}

TEST(Pieces, OneSolidTouchesOnlyWalls) {
  const auto touches = [](const std::string& bodies, const std::string& kind) {
    bool any = false;
    pieces(bodies, &any, "[boundary]\nx = \"" + kind + "\"\nmin = [\"-20 mm\", 0, 0]\nmax = [\"20 mm\", 0, 0]\n");
    return any;
  };
  const std::string rock = body("rock", "nylon", 0), gas = body("gas", "air", 0, "pressure = \"1e5 Pa\"\n");
  EXPECT_FALSE(touches(rock, "symmetry"));
  EXPECT_TRUE(touches(rock, "reflecting"));
  EXPECT_FALSE(touches(gas, "reflecting"));
}

}  // namespace
}  // namespace ejecta
