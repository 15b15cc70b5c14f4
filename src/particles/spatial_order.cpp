#include "particles/spatial_order.hpp"

#include <algorithm>
#include <numeric>

#include "base/parallel.hpp"

namespace ejecta {

namespace {

template <int Dim>
struct Splitter {
  const Particles<Dim>& particles;
  std::size_t cluster_size;
  std::uint32_t* order;

  /// Splits one range in two at a multiple of the cluster size; returns the split.
  std::size_t split(Range range) const {
    std::array<double, Dim> low, high;
    for (int a = 0; a < Dim; ++a) {
      const auto x = particles.column(Field::position, a);
      low[a] = high[a] = x[order[range.begin]];
      for (std::size_t i = range.begin; i < range.end; ++i) {
        low[a] = std::min(low[a], x[order[i]]);
        high[a] = std::max(high[a], x[order[i]]);
      }
    }
    int longest = 0;
    for (int a = 1; a < Dim; ++a)
      if (high[a] - low[a] > high[longest] - low[longest]) longest = a;
    const auto x = particles.column(Field::position, longest);
    const auto id = particles.label(Label::id);
    const std::size_t clusters = (range.size() + cluster_size - 1) / cluster_size;
    const std::size_t middle = range.begin + clusters / 2 * cluster_size;
    std::nth_element(order + range.begin, order + middle, order + range.end,
                     [&](std::uint32_t p, std::uint32_t q) { return x[p] < x[q] || (x[p] == x[q] && id[p] < id[q]); });
    return middle;
  }

  void sort(Range range) const {
    if (range.size() <= cluster_size) {
      // Within a cluster the order is free: by id, so that it depends on the positions alone.
      const auto id = particles.label(Label::id);
      std::sort(order + range.begin, order + range.end, [&](auto p, auto q) { return id[p] < id[q]; });
      return;
    }
    const std::size_t middle = split(range);
    sort({range.begin, middle});
    sort({middle, range.end});
  }
};

}  // namespace

template <int Dim>
void spatial_order(const Particles<Dim>& particles, std::size_t cluster_size, std::vector<std::uint32_t>& order) {
  order.resize(particles.size());
  std::iota(order.begin(), order.end(), 0u);
  const Splitter<Dim> splitter{particles, cluster_size, order.data()};
  // A few levels one after the other give enough ranges to share among threads.
  std::vector<Range> ranges = particles.material_ranges();
  for (int level = 0; level < 5; ++level) {
    std::vector<Range> halves;
    for (Range range : ranges) {
      if (range.size() <= cluster_size) {
        halves.push_back(range);
        continue;
      }
      const std::size_t middle = splitter.split(range);
      halves.push_back({range.begin, middle});
      halves.push_back({middle, range.end});
    }
    ranges = std::move(halves);
  }
  parallel_blocks(ranges.size(), 1, [&](std::size_t r, std::size_t) { splitter.sort(ranges[r]); });
}

template void spatial_order<2>(const Particles<2>&, std::size_t, std::vector<std::uint32_t>&);
template void spatial_order<3>(const Particles<3>&, std::size_t, std::vector<std::uint32_t>&);

}  // namespace ejecta
