#pragma once
/// A relaxed arrangement without rows: points that have pushed one another apart until they stand evenly.
#include <vector>

#include "base/types.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// Turns points strewn over a body, about one to a volume of spacing^Dim [m], into a glass. Sweep by sweep each moves
/// along the sum of w(r) (x_i - x_j)/r, w = (1 - r/(2 spacings))^2, over its neighbours (in the manner of Diehl et al.
/// 2015, Publ. Astron. Soc. Aust. 32, e048) and over their mirror images beyond the surface, which hold the outermost
/// points about half a spacing inside. The same points give the same glass whatever the number of threads. A face of
/// the body that lies on a periodic boundary is a surface like any other.
template <int Dim>
void relax(std::vector<Vec<Dim>>& points, const Body& body, double spacing);

}  // namespace ejecta
