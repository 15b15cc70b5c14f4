#include "sph/criteria.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "particles/smoothing_metric.hpp"
#include "sph/stages.hpp"

namespace ejecta {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// What a signal crosses in a step, of each particle [m].
template <int Dim>
class Crossings {
 public:
  explicit Crossings(const Sph<Dim>& sph)
      : particles_(sph.particles),
        bodies_(sph.scene.bodies),
        h_(particles_.column(Field::smoothing_length)),
        body_(particles_.label(Label::body)),
        tensor_(particles_.has(Field::smoothing_metric)),
        longest_(corrects_gradients(sph.scene, sph.materials) ? sph.scene.numerics.nodes_per_h * sph.scene.spacing
                                                              : never) {}

  double length(std::size_t i) const {
    return within(i, tensor_ ? axes_of<Dim>(particles_.symmetric(Field::smoothing_metric, i)).shortest : h_[i]);
  }

  /// The particle for which limit(i, length), which grows with the length, is smallest.
  template <class Limit>
  IndexedMin least(Limit&& limit) const {
    // Bounds on the axes tell most particles apart from the one sought, and spare them the eigenvalues.
    auto bound = [&](std::size_t i) { return limit(i, within(i, tensor_ ? shortest_bound(i) : h_[i])); };
    const IndexedMin found = parallel_min(particles_.size(), never, bound);
    if (!tensor_ || found.index == particles_.size()) return found;
    const double known = limit(found.index, length(found.index));
    return parallel_min(particles_.size(), never,
                        [&](std::size_t i) { return bound(i) > known ? never : limit(i, length(i)); });
  }

 private:
  double within(std::size_t i, double length) const {
    return std::min(length, longest_ * bodies_[static_cast<std::size_t>(body_[i])].spacing_factor);
  }
  double shortest_bound(std::size_t i) const {
    return shortest_axis_bound<Dim>(particles_.symmetric(Field::smoothing_metric, i));
  }

  const Particles<Dim>& particles_;
  const std::vector<Body>& bodies_;
  std::span<const double> h_;
  std::span<const std::int32_t> body_;
  bool tensor_;
  double longest_;
};

template <int Dim>
Vote vote_of(const Sph<Dim>& sph, std::string_view reason, const IndexedMin& least) {
  if (least.index == sph.particles.size()) return {};
  return {sph.scene.numerics.courant * least.value, reason, least.index};
}

template <int Dim>
IndexedMin courant(const Sph<Dim>& sph) {
  const Numerics& n = sph.scene.numerics;
  const auto sound = sph.particles.column(Field::sound_speed), approach = sph.particles.column(Field::largest_mu);
  return Crossings<Dim>(sph).least([&](std::size_t i, double length) {
    return length / (sound[i] + 0.6 * (n.damping_alpha() * sound[i] + 2 * n.damping_beta() * approach[i]));
  });
}

template <int Dim>
IndexedMin acceleration(const Sph<Dim>& sph) {
  return Crossings<Dim>(sph).least([&](std::size_t i, double length) {
    return std::sqrt(length / sph.particles.vector(Field::acceleration, i).norm());
  });
}

template <int Dim>
IndexedMin compression(const Sph<Dim>& sph) {
  // Matter whose pressure is that of its heat loses P/(rho e) times as large a share of this heat as of its density: up
  // to 3 in vapours. It must not lose all of it in a step.
  constexpr double steepest = 3;
  const auto& p = sph.particles;
  const auto rate = p.column(Field::compression_rate), pressure = p.column(Field::pressure),
             density = p.column(Field::density), energy = p.column(Field::specific_energy);
  return parallel_min(rate.size(), never, [&](std::size_t i) {
    const double heat = std::max(density[i] * energy[i], 0.0);
    const bool cools = rate[i] < 0 && pressure[i] > heat;
    return 1 / std::abs(rate[i] * (cools ? std::min(steepest, pressure[i] / heat) : 1.0));
  });
}

}  // namespace

template <int Dim>
std::vector<Criterion<Dim>> choose_criteria(const Scene& scene) {
  std::vector<Criterion<Dim>> criteria;
  auto add = [&](std::string_view name, IndexedMin (*least)(const Sph<Dim>&)) {
    criteria.push_back({name, [=](const Sph<Dim>& sph) { return vote_of(sph, name, least(sph)); }});
  };
  add("Courant condition", courant<Dim>);
  add("acceleration", acceleration<Dim>);
  if (scene.numerics.density == DensityMethod::continuity) add("compression", compression<Dim>);
  return criteria;
}

template std::vector<Criterion<2>> choose_criteria<2>(const Scene&);
template std::vector<Criterion<3>> choose_criteria<3>(const Scene&);

}  // namespace ejecta
