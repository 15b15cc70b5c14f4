#pragma once
/// Where porous matter has been in the plane of pressure and distension, beside its crush curve: the data of the
/// compaction plot.
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "material/material.hpp"
#include "output/checkpoint.hpp"
#include "particles/particles.hpp"

namespace ejecta {

class CompactionPlot {
 public:
  /// Adds the present state of a sample of the porous particles that have been compacted or come near to it. Those of an
  /// `extra` frame, which no schedule asks for, are not saved.
  template <int Dim>
  void collect(const Particles<Dim>& particles, std::span<const Material> materials, bool extra);
  /// To and from a checkpoint: the points so far.
  void save(CheckpointView& view) const;
  void load(const Checkpoint& checkpoint);
  /// figures/crush_curve.csv and figures/compaction.csv of the run folder. Nothing is written where nothing is porous.
  void write(const std::filesystem::path& run_folder, std::span<const Material> materials) const;

 private:
  std::vector<double> pressure_, distension_;  // Pa, 1
  std::vector<std::int32_t> loading_;          ///< 1 on the crush curve, 0 below it
  std::size_t scheduled_ = 0;                  ///< so many of them belong into a checkpoint
};

}  // namespace ejecta
