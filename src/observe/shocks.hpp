#pragma once
/// shock.csv and line-outs of a blast.
#include <filesystem>
#include <optional>

#include "observe/outputs.hpp"
#include "observe/schedule.hpp"
#include "output/csv.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

/// Follows the blast of a charge: a row of shock.csv whenever there is one of history.csv. At output.times and at the
/// end, of grids, lineouts/lineout_<step>.csv: the row of cells through the charge, or the middle of the box, along x.
class Shocks final : public Observer {
 public:
  Shocks(const Simulation& sim, std::filesystem::path folder, Outputs& outputs, const std::optional<Clock>& resume_at);
  double next_time() const override { return due_.next_time(); }
  void observe(Simulation& sim, bool last) override;

 private:
  void write_row(const Simulation& sim);
  void write_lineouts(const Simulation& sim) const;

  std::filesystem::path folder_;
  Outputs& outputs_;
  std::optional<CsvWriter> rows_;  ///< of shock.csv
  RowTimes due_;
  OutputTimes times_;          ///< of line-outs
};

}  // namespace ejecta
