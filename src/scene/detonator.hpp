#pragma once
/// Where and when an explosive is lit.
#include <array>
#include <string>
#include <string_view>

#include "scene/choices.hpp"

namespace ejecta {

enum class DetonatorShape { point, line, plane };
constexpr auto enum_names(DetonatorShape) { return std::to_array<std::string_view>({"point", "line", "plane"}); }

/// Lights all of the explosive that it touches at one time. In plane strain a point is a line along z, a line a strip.
struct Detonator {
  DetonatorShape shape = DetonatorShape::point;
  Triple position{unset, 0, 0};  ///< the point, an end of the line, a point of the plane [m]
  Triple end{unset, 0, 0};       ///< other end of a line [m]
  Triple normal{unset, 0, 0};    ///< of a plane
  double time = 0;               ///< s
  std::string origin;            ///< where the scene says so: "inputs/x.toml:14"
};

}  // namespace ejecta
