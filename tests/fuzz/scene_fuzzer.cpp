/// A text is a scene, a material or an InputError; everything else - another exception, a crash, a sanitizer report, a
/// hang, a scene whose echo reads back as something else - ends the fuzzer. How to run it: README.md beside this file.
#include <cstdint>
#include <cstdlib>
#include <iostream>

#include "base/errors.hpp"
#include "material/material_reader.hpp"
#include "scene/scene_reader.hpp"

namespace {

using namespace ejecta;

const std::string library = EJECTA_SOURCE_DIR "/inputs/materials";

/// What a run does before it makes particles; the echo of a scene must be a scene again, and say the same.
void read_as_scene(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    const Scene scene = parse_scene(text, "scene.toml", overrides);
    const std::string echo = resolved_toml(scene, read_materials(scene, library));
    try {
      const Scene again = parse_scene(echo, "resolved.toml");
      if (resolved_toml(again, read_materials(again, "")) == echo) return;
      std::cerr << "the echo reads back as another scene:\n" << echo;
    } catch (const InputError& error) {
      std::cerr << "the echo of a scene is refused: " << error.what() << '\n' << echo;
    }
    std::abort();
  } catch (const InputError&) {
  }
}

void read_as_material(const std::string& text) {
  try {
    read_material("basalt", {library}, parse_document(text, "material.toml"));
  } catch (const InputError&) {
  }
}

constexpr const char* small_scene =
    "[scene]\nname=\"a\"\n[resolution]\nspacing=\"1 mm\"\n[time]\nend=\"1 us\"\n[[bodies]]\nname=\"a\"\n"
    "material=\"basalt\"\nradius=\"1 cm\"\n";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  read_as_scene(text);
  read_as_material(text);
  if (text.find('\n') == std::string::npos) read_as_scene(small_scene, {text});  // as after --set
  return 0;
}
