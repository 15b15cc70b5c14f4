/// The stage table says what each stage reads and writes: `ejecta check` prints it, columns exist because of it. Seen
/// from outside, by what a stage does to columns that it does not name: whatever stands there must not matter and must
/// stay.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "material/material_reader.hpp"
#include "scene/scene_reader.hpp"
#include "sph/stages.hpp"

namespace ejecta {
namespace {

constexpr double poison = 1.2345e300;

/// Every column of a field, one after the other.
template <int Dim>
std::vector<double> content(const Particles<Dim>& p, Field f) {
  std::vector<double> values;
  for (int k = 0; k < components(info(f).shape, Dim); ++k)
    values.insert(values.end(), p.column(f, k).begin(), p.column(f, k).end());
  return values;
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

bool contains(const std::vector<Field>& list, Field f) { return std::ranges::find(list, f) != list.end(); }

/// "density reads mass": what a table does not say and should, what it says, and what of that was seen to matter.
struct Findings {
  std::set<std::string> wrong, said, mattered;
};

template <int Dim>
void compare(Sph<Dim>& sph, Findings& findings) {
  auto& [wrong, said, mattered] = findings;
  for (const Stage<Dim>& stage : sph.stages) {
    const Particles<Dim> before = sph.particles;
    const PairLists<Dim> lists = sph.lists;
    const double built_at = sph.lists_built_at;
    const auto begin_again = [&] {
      sph.particles = before;
      sph.lists = lists;
      sph.lists_built_at = built_at;
    };
    stage.run(sph);
    const Particles<Dim> after = sph.particles;
    for (const Field f : before.fields())
      if (!same(content(before, f), content(after, f))) {
        mattered.insert(stage.name + " writes " + std::string(info(f).name));
        if (!contains(stage.writes, f)) wrong.insert(stage.name + " writes " + std::string(info(f).name));
      }
    for (const Field hidden : before.fields()) {
      if (contains(stage.reads, hidden) || contains(stage.writes, hidden)) continue;
      begin_again();
      for (int k = 0; k < components(info(hidden).shape, Dim); ++k)
        std::ranges::fill(sph.particles.column(hidden, k), poison);
      try {
        stage.run(sph);
      } catch (const std::exception&) {
        wrong.insert(stage.name + " reads " + std::string(info(hidden).name));
      }
      for (const Field f : before.fields())
        if (f != hidden && !same(content(sph.particles, f), content(after, f)))
          wrong.insert(stage.name + " reads " + std::string(info(hidden).name));
    }
    for (const Field f : stage.writes) said.insert(stage.name + " writes " + std::string(info(f).name));
    // What is said to be read must matter somewhere.
    for (const Field f : stage.reads) {
      const std::string name = stage.name + " reads " + std::string(info(f).name);
      said.insert(name);
      if (contains(stage.writes, f)) mattered.insert(name);
      for (const double factor : {0.7, 0.0}) {
        if (mattered.contains(name)) break;
        begin_again();
        for (int k = 0; k < components(info(f).shape, Dim); ++k)
          for (double& value : sph.particles.column(f, k)) value *= factor;
        try {
          stage.run(sph);
        } catch (const std::exception&) {
          mattered.insert(name);
        }
        for (const Field g : before.fields())
          if (g != f && !same(content(sph.particles, g), content(after, g))) mattered.insert(name);
      }
    }
    // A column that is written but not read must be filled, or left alone, whatever stood there.
    for (const Field f : stage.writes) {
      if (contains(stage.reads, f)) continue;
      begin_again();
      for (int k = 0; k < components(info(f).shape, Dim); ++k) std::ranges::fill(sph.particles.column(f, k), poison);
      stage.run(sph);
      for (const Field g : before.fields()) {
        if (g == f) {
          const std::vector<double> now = content(sph.particles, f), first = content(after, f);
          for (std::size_t i = 0; i < now.size(); ++i)
            if (now[i] != first[i] && now[i] != poison) {
              wrong.insert(stage.name + " reads " + std::string(info(f).name));
              break;
            }
        } else if (!same(content(sph.particles, g), content(after, g))) {
          wrong.insert(stage.name + " reads " + std::string(info(f).name));
        }
      }
    }
    begin_again();
    stage.run(sph);
  }
}

template <int Dim>
void follow(const Scene& scene, Findings& findings) {
  const auto sph = set_up<Dim>(scene, read_materials(scene, EJECTA_SOURCE_DIR "/inputs/materials").list);
  for (int k = 0; k < 20; ++k) sph->advance(sph->vote().dt);  // into the impact; here shapes of H are voted on
  compare(*sph, findings);
}

/// A few hundred to a few thousand particles.
std::vector<std::string> coarse(const std::string& name) {
  const std::map<std::string, std::string> spacings{
      {"basalt_impact", "3 mm"},    {"expanding_ring", "1 mm"},   {"pumice_impact", "4 mm"},
      {"pumice_impact_2d", "3 mm"}, {"he_shell", "4 mm"},         {"cylinder_test_3d", "10.16 mm"},
      {"gasgun_tube", "3 mm"},      {"he_tube", "6 mm"},          {"he_tube_2d", "2 mm"},
      {"rubber_balls_3d", "4 mm"},  {"tensile_rod_2d", "0.5 mm"}, {"tensile_rod_3d", "0.7 mm"}};
  const auto found = spacings.find(name);
  return found == spacings.end() ? std::vector<std::string>{} : std::vector{"resolution.spacing=" + found->second};
}

/// Said, but for what a few steps of these scenes do not bring about.
const std::set<std::string> seldom{"neighbours reads smoothing_length",
                                   "neighbours reads smoothing_metric",  // go into the lists, which are no columns
                                   "neighbours writes position",
                                   "neighbours writes velocity",  // of what crosses a face
                                   "burn reads density",          // nothing is compressed before it is lit
                                   "driven bodies reads mass",
                                   "driven bodies reads position",
                                   "driven bodies reads velocity",  // for the ledger
                                   "bonds reads density",
                                   "bonds reads stretch",
                                   "bonds reads plastic_strain",
                                   "bonds writes bond",
                                   "pair rates writes stretch",  // nothing has torn
                                   "shapes reads mass",
                                   "shapes writes zeroth_moment",
                                   "shapes writes smoothing_length",  // at the start only
                                   "strain rates writes density"};    // held where neighbours change places

TEST(StageTable, SaysWhatEachStageReadsAndWritesInEveryShippedScene) {
  int scenes = 0;
  Findings all;
  for (const auto& entry : std::filesystem::directory_iterator(EJECTA_SOURCE_DIR "/inputs")) {
    if (entry.path().extension() != ".toml") continue;
    const std::string name = entry.path().stem();
    SCOPED_TRACE(name);
    all.wrong.clear();
    // No particles, or some that a grid leads; what grids are asked is not known here.
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    if (text.str().find("scheme = \"fvm\"") != std::string::npos ||
        text.str().find("scheme = \"hybrid\"") != std::string::npos)
      continue;
    const Scene scene = read_scene(entry.path(), coarse(name));
    if (scene.dimension == 2)
      follow<2>(scene, all);
    else
      follow<3>(scene, all);
    for (const std::string& what : all.wrong) ADD_FAILURE() << what << ", says nothing of it";
    ++scenes;
  }
  EXPECT_GE(scenes, 9);
  for (const std::string& what : all.said)
    if (!all.mattered.contains(what) && !seldom.contains(what))
      ADD_FAILURE() << what << ": said, and never seen to matter";
}

}  // namespace
}  // namespace ejecta
