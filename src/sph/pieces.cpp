#include "sph/pieces.hpp"

#include <algorithm>

namespace ejecta {

std::vector<int> pieces_of(const Scene& scene, const std::vector<Material>& materials,
                           const std::vector<int>& body_material) {
  const std::size_t bodies = scene.bodies.size();
  const auto solid = [&](std::size_t b) { return materials[static_cast<std::size_t>(body_material[b])].solid(); };
  const auto gas = [&](std::size_t b) { return materials[static_cast<std::size_t>(body_material[b])].gas(); };
  constexpr int fluid = 1;
  std::vector<int> piece(bodies);
  for (std::size_t b = 0; b < bodies; ++b) piece[b] = gas(b) ? 0 : solid(b) ? static_cast<int>(b) + 1 + fluid : fluid;
  const auto weld = [&](std::size_t a, std::size_t b) {
    if (!solid(a) || !solid(b)) return;
    const int from = std::max(piece[a], piece[b]), to = std::min(piece[a], piece[b]);
    std::replace(piece.begin(), piece.end(), from, to);
  };
  for (std::size_t a = 0; a < bodies; ++a)
    for (std::size_t b = 0; b < bodies; ++b) {
      const Body& body = scene.bodies[a];
      const bool holds = body.weld == "auto" && body.driven && body_material[a] == body_material[b];
      if (a != b && (holds || body.weld == scene.bodies[b].name)) weld(a, b);
    }
  return piece;
}

bool anything_touches(const Scene& scene, const std::vector<int>& pieces) {
  const bool wall = scene.boundary.any([](BoundaryKind kind) { return kind == BoundaryKind::reflecting; });
  return std::any_of(pieces.begin(), pieces.end(),
                     [&](int piece) { return piece != pieces.front() || (wall && piece != 0); });
}

}  // namespace ejecta
