#pragma once
/// Where porous matter has been in the plane of pressure and distension, beside its crush curve: the data of the
/// compaction plot.
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "material/material.hpp"
#include "particles/particles.hpp"

namespace ejecta {

class CompactionPlot {
 public:
  /// Adds the present state of a sample of the porous particles that have been compacted or come near to it.
  template <int Dim>
  void collect(const Particles<Dim>& particles, std::span<const Material> materials);
  /// figures/crush_curve.csv and figures/compaction.csv of the run folder. Nothing is written where nothing is porous.
  void write(const std::filesystem::path& run_folder, std::span<const Material> materials) const;

 private:
  std::vector<double> pressure_, distension_;  // Pa, 1
  std::vector<std::int32_t> loading_;          ///< 1 on the crush curve, 0 below it
};

}  // namespace ejecta
