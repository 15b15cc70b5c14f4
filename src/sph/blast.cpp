/// The front of a blast among particles.
#include <cmath>
#include <numeric>

#include "model/find_blast.hpp"
#include "scene/shape_geometry.hpp"
#include "sph/near_mean.hpp"
#include "sph/sph.hpp"

namespace ejecta {

namespace {

constexpr double weakest_front = 0.01;  ///< of the largest pressure

/// Particles by square (cube), for means near a point.
template <int Dim>
class Bins {
 public:
  Bins(const Particles<Dim>& p, double edge) : p_(p), edge_(edge) {
    for (int a = 0; a < Dim; ++a) {
      const auto [least, most] = std::ranges::minmax(p.column(Field::position, a));
      corner_[a] = least;
      counts_[static_cast<std::size_t>(a)] = static_cast<int>((most - least) / edge) + 1;
    }
    std::size_t all = 1;
    for (const int n : counts_) all *= static_cast<std::size_t>(n);
    first_.assign(all + 1, 0);
    std::vector<std::size_t> bin(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      std::size_t b = 0;
      for (int a = Dim - 1; a >= 0; --a)
        b = b * static_cast<std::size_t>(counts_[static_cast<std::size_t>(a)]) +
            static_cast<std::size_t>((p.column(Field::position, a)[i] - corner_[a]) / edge);
      bin[i] = b;
      ++first_[b + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    in_.resize(p.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < p.size(); ++i) in_[next[bin[i]]++] = static_cast<std::uint32_t>(i);
  }

  double pressure(const Vec<Dim>& x, double otherwise) const {
    NearMean<Dim> mean(p_, x);
    std::array<int, Dim> low, high, at;
    for (int a = 0; a < Dim; ++a) {
      const auto k = static_cast<std::size_t>(a);
      const int middle = static_cast<int>(std::floor((x[a] - corner_[a]) / edge_));
      low[k] = at[k] = std::clamp(middle - 1, 0, counts_[k] - 1);
      high[k] = std::clamp(middle + 1, 0, counts_[k] - 1);
    }
    for (bool more = true; more;) {
      std::size_t b = 0;
      for (std::size_t a = Dim; a-- > 0;)
        b = b * static_cast<std::size_t>(counts_[a]) + static_cast<std::size_t>(at[a]);
      for (std::uint32_t k = first_[b]; k < first_[b + 1]; ++k) mean.add(in_[k]);
      std::size_t a = 0;
      while (a < Dim && ++at[a] > high[a]) {
        at[a] = low[a];
        ++a;
      }
      more = a < Dim;
    }
    return mean.pressure(otherwise);
  }

 private:
  const Particles<Dim>& p_;
  double edge_;
  Vec<Dim> corner_;
  std::array<int, Dim> counts_;
  std::vector<std::uint32_t> first_, in_;
};

}  // namespace

template <int Dim>
std::optional<BlastFront> Sph<Dim>::blast() const {
  if (!scene.charge || !scene.gas) return std::nullopt;
  const Bins<Dim> bins(particles, 2 * scene.numerics.nodes_per_h * scene.spacing);
  const Vec<Dim> centre = first_components<Dim>(scene.charge->center);
  double farthest = 0;
  for (std::size_t a = 0; a < Dim; ++a) farthest += std::pow(scene.boundary.length(a), 2);
  // At open edges, and where particles have been shaken, gas at rest is noisy: no front is as weak as that.
  const double around =
      std::max(scene.gas->pressure, weakest_front * std::ranges::max(particles.column(Field::pressure)));
  auto blast = find_blast<Dim>(centre, scene.spacing, std::sqrt(farthest), around,
                               [&](const Vec<Dim>& x) -> std::optional<double> {
                                 for (std::size_t a = 0; a < Dim; ++a)
                                   if (!scene.boundary.within(a, x[static_cast<int>(a)])) return std::nullopt;
                                 return bins.pressure(x, around);
                               });
  if (blast) blast->peak_density = std::ranges::max(particles.column(Field::density));
  return blast;
}

template std::optional<BlastFront> Sph<2>::blast() const;
template std::optional<BlastFront> Sph<3>::blast() const;

}  // namespace ejecta
