/// The highest pressure of matter.
#include <algorithm>

#include "schemes/kernels.hpp"
#include "sph/pieces.hpp"
#include "sph/sph.hpp"

namespace ejecta {

namespace {

/// Whether a particle has neighbours of its own piece on its sides, within half of its support.
template <int Dim>
class InMatter {
 public:
  explicit InMatter(const Sph<Dim>& sph)
      : sph_(sph),
        pieces_(pieces_of(sph.scene, sph.materials, sph.body_material)),
        reach_(0.5 * kernel_support(sph.scene.numerics.kernel)) {}

  bool operator()(std::size_t cluster, std::size_t i) const {
    const Particles<Dim>& p = sph_.particles;
    const Vec<Dim> x = p.vector(Field::position, i);
    const double reach = reach_ * p.column(Field::smoothing_length)[i];
    const int piece = piece_of(p, i);
    int left = Dim + 1;  // itself among them
    for (const std::uint32_t j : sph_.lists.candidates(cluster)) {
      const bool near = j < p.size() ? piece_of(p, j) == piece && (p.vector(Field::position, j) - x).norm() < reach
                                     : near_ghost(sph_.lists.ghosts().ghosts[j - p.size()], x, reach, piece);
      if (near && --left == 0) return true;
    }
    return false;
  }

 private:
  int piece_of(const Particles<Dim>& p, std::size_t i) const {
    return pieces_[static_cast<std::size_t>(p.label(Label::body)[i])];
  }
  bool near_ghost(const Ghost& ghost, const Vec<Dim>& x, double reach, int piece) const {
    const Particles<Dim>& owner = sph_.lists.ghosts().owner(ghost, sph_.particles);
    if (piece_of(owner, ghost.source) != piece) return false;
    Vec<Dim> y = owner.vector(Field::position, ghost.source);
    for (int a = 0; a < Dim; ++a) y[a] = sph_.lists.ghosts().transform(ghost).position(a, y[a]);
    return (y - x).norm() < reach;
  }

  const Sph<Dim>& sph_;
  std::vector<int> pieces_;
  double reach_;
};

}  // namespace

template <int Dim>
double highest_pressure(const Sph<Dim>& sph) {
  const auto pressure = sph.particles.column(Field::pressure);
  constexpr double none = -std::numeric_limits<double>::infinity();
  double highest = none;
  if (sph.lists.built()) {
    const InMatter<Dim> in_matter(sph);
    const std::vector<Cluster>& clusters = sph.lists.clusters();
    for (std::size_t c = 0; c < clusters.size(); ++c)
      for (std::size_t i = clusters[c].begin; i < clusters[c].end; ++i)
        if (pressure[i] > highest && in_matter(c, i)) highest = pressure[i];
  }
  if (highest > none) return highest;
  return pressure.empty() ? 0 : std::ranges::max(pressure);
}

template double highest_pressure<2>(const Sph<2>&);
template double highest_pressure<3>(const Sph<3>&);

}  // namespace ejecta
