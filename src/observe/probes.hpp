#pragma once
/// The probes of a scene: their tables while the run goes on.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "observe/outputs.hpp"
#include "observe/probe_reading.hpp"
#include "observe/schedule.hpp"
#include "output/csv.hpp"
#include "simulation/simulation.hpp"

namespace ejecta {

/// Tracers get the particles that they ride on, unless a checkpoint has brought them. Returns what is odd about other
/// probes, a sentence each: nothing to read now. Throws InputError for a tracer that begins outside of matter.
std::vector<std::string> place_probes(Simulation& sim);

/// Of history, monitor and summary: what each probe reads at this moment.
Quantities quantities_of_probes(const Simulation& sim);

/// probe_<name>.csv: time, the columns of probe_reading.hpp, with a direction the velocity along it, and of a tracer
/// the strain, length over length at the start minus 1 of a line of matter along it. Steps do not end for a row: it is
/// taken at the first step from when it is due.
class Probes final : public Observer {
 public:
  /// Of probes that have been placed. Copies of measured traces are put beside the tables.
  Probes(const Simulation& sim, std::filesystem::path folder, Outputs& outputs, const std::optional<Clock>& resume_at);
  void observe(Simulation& sim, bool last) override;

 private:
  struct Table {
    Probe probe;
    std::vector<CsvColumn> columns;  ///< time first
    RowTimes due;
    std::optional<CsvWriter> rows;
  };
  void read(Simulation& sim, Table& table, bool last);
  void write(Table& table, const std::vector<double>& row);

  std::filesystem::path folder_;
  Outputs& outputs_;
  std::vector<Table> tables_;
};

}  // namespace ejecta
