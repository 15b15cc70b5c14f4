#include "observe/compaction.hpp"

#include <algorithm>
#include <cmath>

#include "output/fragment_files.hpp"

namespace ejecta {

template <int Dim>
void CompactionPlot::collect(const Particles<Dim>& p, std::span<const Material> materials, bool extra) {
  constexpr std::size_t samples_per_frame = 400;  // particles of each material
  for (std::size_t m = 0; m < materials.size(); ++m) {
    if (!materials[m].porosity) continue;
    const CrushCurve& curve = materials[m].porosity->curve;
    const Range range = p.material_ranges()[m];
    const std::size_t stride = std::max<std::size_t>(1, range.size() / samples_per_frame);
    for (std::size_t i = range.begin; i < range.end; i += stride) {
      const double pressure = p.column(Field::pressure)[i], alpha = p.column(Field::distension)[i];
      if (alpha >= curve.initial_distension && pressure < curve.elastic_pressure) continue;  // untouched so far
      pressure_.push_back(pressure);
      distension_.push_back(alpha);
      loading_.push_back(std::abs(alpha - curve.alpha(pressure)) < 1e-6 ? 1 : 0);
    }
  }
  if (!extra) scheduled_ = pressure_.size();
}

void CompactionPlot::save(CheckpointView& view) const {
  if (scheduled_ == 0) return;
  view.columns.push_back({"compaction.pressure", "Pa", std::span(pressure_).first(scheduled_)});
  view.columns.push_back({"compaction.distension", "1", std::span(distension_).first(scheduled_)});
  view.labels.push_back({"compaction.loading", "1", std::span(loading_).first(scheduled_)});
}

void CompactionPlot::load(const Checkpoint& checkpoint) {
  if (!checkpoint.columns.contains("compaction.pressure")) return;  // of an earlier version
  pressure_ = checkpoint.column("compaction.pressure");
  distension_ = checkpoint.column("compaction.distension");
  loading_ = checkpoint.label("compaction.loading");
  scheduled_ = pressure_.size();
}

void CompactionPlot::write(const std::filesystem::path& run_folder, std::span<const Material> materials) const {
  const auto porous = std::ranges::find_if(materials, [](const Material& m) { return m.porosity.has_value(); });
  if (porous == materials.end()) return;
  const CrushCurve& curve = porous->porosity->curve;  // one porous material is what the plot is for
  std::vector<double> pressure, distension;
  constexpr int points = 400;
  const double first = 0.1 * curve.elastic_pressure, last = 2 * curve.solid_pressure;
  for (int k = 0; k <= points; ++k) {
    pressure.push_back(first * std::pow(last / first, static_cast<double>(k) / points));
    distension.push_back(curve.alpha(pressure.back()));
  }
  write_crush_curve(run_folder / "figures/crush_curve.csv", pressure, distension);
  write_compaction(run_folder / "figures/compaction.csv", pressure_, distension_, loading_);
}

template void CompactionPlot::collect<2>(const Particles<2>&, std::span<const Material>, bool);
template void CompactionPlot::collect<3>(const Particles<3>&, std::span<const Material>, bool);

}  // namespace ejecta
