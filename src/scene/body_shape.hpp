#pragma once
/// The shapes that a body may have. Their geometry is in scene/shape_geometry.hpp.
#include <array>
#include <cstddef>
#include <string_view>

namespace ejecta {

enum class BodyShape { sphere, box, cylinder, disc, rectangle };

/// What a scene has to say of a shape: its word, in how many dimensions there is one, and the lengths that it has.
struct ShapeInfo {
  std::string_view word;
  int dimension;
  bool radius = false, size = false, length = false;
};
/// In the order of the enumeration.
inline constexpr std::array<ShapeInfo, 5> body_shapes{
    {{.word = "sphere", .dimension = 3, .radius = true},
     {.word = "box", .dimension = 3, .size = true},
     {.word = "cylinder", .dimension = 3, .radius = true, .length = true},
     {.word = "disc", .dimension = 2, .radius = true},
     {.word = "rectangle", .dimension = 2, .size = true}}};
constexpr const ShapeInfo& info(BodyShape shape) { return body_shapes[static_cast<std::size_t>(shape)]; }

constexpr auto enum_names(BodyShape) {
  std::array<std::string_view, body_shapes.size()> words;
  for (std::size_t k = 0; k < words.size(); ++k) words[k] = body_shapes[k].word;
  return words;
}

}  // namespace ejecta
