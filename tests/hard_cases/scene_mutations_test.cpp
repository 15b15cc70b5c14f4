/// The shipped scenes and materials with random damage: cut, doubled, swapped, words and numbers replaced. Each is read
/// or refused with an InputError; nothing else may happen. The seed is fixed, so a failure comes back. tests/fuzz
/// searches further, guided by the code it reaches.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "base/errors.hpp"
#include "material/material_reader.hpp"
#include "scene/scene_reader.hpp"

namespace ejecta {
namespace {

namespace fs = std::filesystem;
const std::string root = EJECTA_SOURCE_DIR, library = root + "/inputs/materials";

/// The file without its comments, which would take most of the damage.
std::string read_text(const fs::path& path) {
  std::ifstream file(path);
  std::string text;
  for (std::string line; std::getline(file, line);) {
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(' ') != std::string::npos) text += line + '\n';
  }
  return text;
}

std::vector<std::string> texts_in(const std::vector<std::string>& folders) {
  std::vector<fs::path> paths;
  for (const std::string& folder : folders)
    for (const auto& entry : fs::directory_iterator(root + folder))
      if (entry.is_regular_file()) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> texts;
  for (const fs::path& path : paths) texts.push_back(read_text(path));
  return texts;
}

class Mutator {
 public:
  explicit Mutator(const std::vector<std::string>& texts) : texts_(texts) {
    for (const std::string& text : texts) {
      std::istringstream stream(text);
      for (std::string word; stream >> word;) words_.push_back(word);
    }
    for (const char* odd : {"nan",
                            "inf",
                            "-1",
                            "0",
                            "1e308",
                            "1e-320",
                            "9223372036854775808",
                            "\"\"",
                            "[]",
                            "[[",
                            "{}",
                            "\"1 mm\"",
                            "\"-1e300 km/s\"",
                            "\"\xff\"",
                            "\xef\xbb\xbf",
                            "\"\\u0000\"",
                            "2020-01-01",
                            "[bodies.profile]",
                            "velocity = [\"1/x\", \"(\"]",
                            "a.b.c.d = 1",
                            "'''",
                            "\"\"\""})
      words_.emplace_back(odd);
  }

  std::string next() {
    std::string text = texts_[pick(texts_.size())];
    for (std::size_t k = 1 + pick(4); k > 0 && !text.empty(); --k) damage(text);
    return text;
  }

 private:
  std::size_t pick(std::size_t n) { return random_() % n; }  // the standard distributions differ between libraries

  void damage(std::string& text) {
    const std::size_t at = pick(text.size()), length = 1 + pick(std::min<std::size_t>(40, text.size() - at));
    const std::size_t word = text.find_first_not_of(" \n", at), end = text.find_first_of(" \n", word);
    const std::size_t digit = text.find_first_of("0123456789", at);
    switch (pick(10)) {
      case 0:
        return void(text.erase(at, length));
      case 1:
        return void(text.insert(pick(text.size()), text.substr(at, length)));
      case 2:
        return void(text[at] = static_cast<char>(pick(256)));
      case 3:
        return void(text[at] ^= static_cast<char>(1 << pick(8)));
      case 4:
        return void(text.resize(at));
      case 5:
        return void(text.insert(at, words_[pick(words_.size())]));
      case 6:
        if (word != std::string::npos) text.replace(word, end - word, words_[pick(words_.size())]);
        return;
      default:  // often enough for some scenes to stay valid
        if (digit != std::string::npos) text[digit] = static_cast<char>('0' + pick(10));
    }
  }

  const std::vector<std::string>& texts_;
  std::vector<std::string> words_;
  std::mt19937_64 random_{1};
};

/// "" if it is read and its echo is the same scene again; the refusal otherwise.
std::string read_as_scene(const std::string& text) {
  try {
    const Scene scene = parse_scene(text, "scene.toml");
    const std::string echo = resolved_toml(scene, read_materials(scene, library));
    const Scene again = parse_scene(echo, "resolved.toml");
    EXPECT_EQ(resolved_toml(again, read_materials(again, "nowhere")), echo);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SceneMutations, TwentyThousandAreReadOrRefused) {
  const std::vector<std::string> texts = texts_in({"/inputs", "/tests/fuzz/seeds"});
  ASSERT_GE(texts.size(), 6u);
  Mutator mutator(texts);
  int accepted = 0;
  for (int k = 0; k < 16000; ++k) {
    const std::string text = mutator.next();
    try {
      const std::string refusal = read_as_scene(text);
      accepted += refusal.empty();
      ASSERT_FALSE(refusal.starts_with("resolved.toml")) << "its echo is refused: " << refusal << '\n' << text;
    } catch (const std::exception& error) {
      FAIL() << error.what() << " from\n" << text;
    }
  }
  const std::vector<std::string> materials = texts_in({"/inputs/materials"});
  Mutator of_materials(materials);
  for (int k = 0; k < 4000; ++k) {
    const std::string text = of_materials.next();
    try {
      read_material("basalt", {library}, parse_document(text, "material.toml"));
      ++accepted;
    } catch (const InputError&) {
    } catch (const std::exception& error) {
      FAIL() << error.what() << " from\n" << text;
    }
  }
  std::printf("[ mutations ] %d of 20000 are still accepted\n", accepted);
  EXPECT_GT(accepted, 500);
  EXPECT_LT(accepted, 15000);
}

/// A file of any size and nesting is refused before it can exhaust the stack of the TOML reader.
TEST(SceneMutations, EndlessNestingIsRefused) {
  for (const int depth : {1000, 30000, 1000000}) {
    std::string dots = "a", arrays = "x = ", tables = "x = ";
    for (int k = 0; k < depth; ++k) dots += ".a";
    arrays += std::string(static_cast<std::size_t>(depth), '[');
    for (int k = 0; k < depth; ++k) tables += "{a=";
    for (const std::string& text : {dots + " = 1\n", "[" + dots + "]\n", arrays, tables})
      EXPECT_NE(read_as_scene(text), "") << depth;
  }
}

}  // namespace
}  // namespace ejecta
