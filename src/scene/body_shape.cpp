#include "scene/scene.hpp"

namespace ejecta {

std::vector<double> widths(const Body& body, int dimension) {
  const ShapeInfo& shape = info(body.shape);
  std::vector<double> list;
  if (shape.radius) list.push_back(2 * body.radius);
  if (shape.size) list.insert(list.end(), body.size.begin(), body.size.begin() + dimension);
  if (shape.length) list.push_back(body.length);
  return list;
}

}  // namespace ejecta
