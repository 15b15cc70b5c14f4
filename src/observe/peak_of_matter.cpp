#include "observe/peak_of_matter.hpp"

#include <algorithm>
#include <functional>
#include <vector>

namespace ejecta {

template <int Dim>
double peak_of_matter(const Particles<Dim>& particles, std::int32_t body, double reach) {
  const auto label = particles.label(Label::body);
  const auto peak = particles.column(Field::pressure_peak);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (label[i] == body) order.push_back(i);
  std::ranges::sort(order, std::greater<>(), [&](std::size_t i) { return peak[i]; });
  // From the highest down, until one began beside another: seldom more than a few.
  for (std::size_t k = 1; k < order.size(); ++k) {
    const Vec<Dim> x = particles.vector(Field::initial_position, order[k]);
    for (std::size_t higher = 0; higher < k; ++higher)
      if ((particles.vector(Field::initial_position, order[higher]) - x).norm() <= reach) return peak[order[k]];
  }
  return order.empty() ? 0 : peak[order.front()];
}

template double peak_of_matter<2>(const Particles<2>&, std::int32_t, double);
template double peak_of_matter<3>(const Particles<3>&, std::int32_t, double);

}  // namespace ejecta
