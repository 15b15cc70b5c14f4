/// Lists and maps of things in a section that belongs to somebody else than the scene: all that it takes is a
/// description.
#include <gtest/gtest.h>

#include <algorithm>

#include "scene/describer.hpp"
#include "unit/scene/scene_text.hpp"

namespace ejecta {
namespace {

struct Wheel {
  double radius = unset;
};
struct Cart {
  std::string name, origin;
  double mass = 1;
  Triple colour{0, 0, 1};
  std::vector<Wheel> wheels;
};
struct Track {
  double length = 2;
};
struct Train final : SectionSettings {
  double speed = 3;
  std::vector<Cart> carts;
  std::map<std::string, Track> tracks;
  void describe(Describer& d) override {
    d.list("carts", carts, true, "one cart", [&](Cart& cart) {
      d.text("name", cart.name, "of it").required = true;
      d.section("paint", "its look", [&] { d.triple("colour", cart.colour, "1", "red, green, blue"); });
      d.list("wheels", cart.wheels, false, "one wheel of it",
             [&](Wheel& wheel) { d.number("radius", wheel.radius, "m", positive, "of it").required = true; });
      d.number("mass", cart.mass, "kg", positive, "of it");
      d.origin(cart.origin);
    });
    d.map("tracks", tracks, "<track>", "where it goes", [&](const std::string& name, Track& track) {
      d.section(name, "one track", [&] { d.number("length", track.length, "m", positive, "of it"); });
    });
    d.number("speed", speed, "m/s", positive, "of all");  // after the lists, yet of [train]
  }
};

const std::vector<SceneSection> sections{{"train", "carts on tracks", [] { return std::make_shared<Train>(); }}};

const std::string train = valid_scene + R"(
[train]
speed = "1 m/s"
[[train.carts]]
name = "first"
[[train.carts.wheels]]
radius = "10 cm"
[[train.carts.wheels]]
radius = "20 cm"
[[train.carts]]
name = "second"
mass = "2 g"
[train.carts.paint]
colour = [1, 0, 0]
[train.tracks.north]
length = "1 km"
[train.tracks.south]
)";

Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "s.toml", overrides, {sections, {}});
}
const Train& train_of(const Scene& scene) { return dynamic_cast<const Train&>(*scene.sections.at("train")); }

std::vector<std::string> refused(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read(text, overrides);
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}

TEST(Lists, AreAsLongAsTheDocumentSays) {
  const Scene scene = read(train);
  const Train& t = train_of(scene);
  EXPECT_EQ(t.speed, 1);
  ASSERT_EQ(t.carts.size(), 2u);
  EXPECT_EQ(t.carts[0].name, "first");
  EXPECT_EQ(t.carts[0].mass, 1);
  EXPECT_EQ(t.carts[1].mass, 2e-3);
  EXPECT_EQ(t.carts[1].colour, (Triple{1, 0, 0}));
  EXPECT_EQ(t.carts[1].origin, "s.toml:26");
  ASSERT_EQ(t.carts[0].wheels.size(), 2u);
  EXPECT_EQ(t.carts[0].wheels[1].radius, 0.2);
  EXPECT_TRUE(t.carts[1].wheels.empty());
  ASSERT_EQ(t.tracks.size(), 2u);
  EXPECT_EQ(t.tracks.at("north").length, 1e3);
  EXPECT_EQ(t.tracks.at("south").length, 2);
}

TEST(Lists, AreEchoedSoThatTheyReadBack) {
  const std::string echo = scene_toml(read(train));
  EXPECT_NE(echo.find("\n[[train.carts.wheels]]"), std::string::npos) << echo;
  const Scene again = read(echo);
  EXPECT_EQ(scene_toml(again), echo);
  EXPECT_EQ(train_of(again).carts[0].wheels[1].radius, 0.2);
  EXPECT_EQ(train_of(again).tracks.at("north").length, 1e3);
}

TEST(Lists, AreInTheReferenceWithOneThingEach) {
  const std::string reference = scene_reference("train", sections);
  for (const char* text : {"\n[train]  carts on tracks\n", "\n  speed  ", "\n[[train.carts]]  one cart\n",
                           "\n[train.carts.paint]  its look\n", "\n[[train.carts.wheels]]  one wheel of it\n",
                           "\n[train.tracks.<track>]  one track\n", "\n  length  "})
    EXPECT_NE(reference.find(text), std::string::npos) << text << reference;
}

TEST(Lists, RefuseWhatIsWrongInThem) {
  using Problems = std::vector<std::string>;
  EXPECT_EQ(refused(train, {"train.carts[1].mas=1 kg"}),
            Problems{"--set train.carts[1].mas: unknown key, did you mean train.carts[1].mass?"});
  EXPECT_EQ(refused(train + "[train.tracks.west]\nwidth = 1\n"),
            Problems{"s.toml:35: train.tracks.west.width: unknown key"});
  EXPECT_EQ(refused(train + "[[train.carts]]\n"), Problems{"s.toml:34: train.carts[2].name: missing: of it"});
  EXPECT_EQ(refused(valid_scene + "[train]\n"),
            Problems{"s.toml:17: train.carts: expected at least one, each written under [[train.carts]]"});
  EXPECT_EQ(refused(valid_scene + "[train.carts]\nname = \"x\"\n[train.carts.paint]\ncolour = 1\n"),
            Problems{"s.toml:17: train.carts: expected at least one, each written under [[train.carts]]"});
  EXPECT_EQ(refused(valid_scene + "[[train.carts]]\nname = \"x\"\nwheels = 4\n"),
            Problems{"s.toml:19: train.carts[0].wheels: expected any number of them, each written under "
                     "[[train.carts.wheels]]"});
}

TEST(Lists, OverridesFindThingsByIndexAndName) {
  const Scene scene = read(train, {"train.carts.second.mass=3 kg", "train.carts.first.wheels[0].radius=1 m",
                                   "train.tracks.north.length=5 m"});
  EXPECT_EQ(train_of(scene).carts[1].mass, 3);
  EXPECT_EQ(train_of(scene).carts[0].wheels[0].radius, 1);
  EXPECT_EQ(train_of(scene).tracks.at("north").length, 5);
  EXPECT_EQ(
      refused(train, {"train.carts.third.mass=3 kg"}),
      std::vector<std::string>{"--set train.carts.third.mass: expected one of the train.carts \"first\", \"second\""});
}

TEST(Lists, ThingsAreCalledByTheirNames) {
  const Document document = parse_document(train, "s.toml");
  EXPECT_EQ(with_names(document, "train.carts[0].wheels[1].radius"), "train.carts.first.wheels[1].radius");
  EXPECT_EQ(with_names(document, "bodies[1].velocity"), "bodies.projectile.velocity");
  EXPECT_EQ(with_names(document, "time.end"), "time.end");
}

}  // namespace
}  // namespace ejecta
