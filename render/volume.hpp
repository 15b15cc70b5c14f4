#pragma once
/// How full of matter space is, at the points of a lattice: the true kernel and the true h or H of every particle. Its
/// level surface at one half is where bodies end.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/sampling.hpp"

namespace ejecta {

struct Lattice3 {
  std::array<int, 3> count{1, 1, 1};
  std::array<double, 3> first{0, 0, 0};  ///< m
  double step = 1;                       ///< m

  std::size_t size() const {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
  }
};
/// The points from `low` to `high` [m], `step` apart or so much farther that there are no more than `most` of them.
Lattice3 lattice_within(std::array<double, 3> low, std::array<double, 3> high, double step, double most);

struct SampledVolume {
  Lattice3 lattice;
  /// x fastest. Filling [1]: sum_j V_j W_j with V = m/rho, 1 within matter. Body: that of the particle with most weight
  /// there, -1 where there is none.
  std::vector<double> filling, body;

  /// Kind `image`. Valid while this lives.
  Channel channel(std::string name) const;
};

/// Bit for bit the same for every number of threads.
SampledVolume sample_volume(const ParticleView& particles, std::span<const std::int32_t> body,
                            const KernelShape& kernel, const Lattice3& lattice);

}  // namespace ejecta
