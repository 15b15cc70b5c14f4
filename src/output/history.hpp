#pragma once
/// history.csv: what the run as a whole does in time; timers.csv: where the wall time went.
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "output/csv.hpp"

namespace ejecta {

/// One row. Optional values must be given in every row of a run or in none: they become columns only if given.
struct HistoryRow {
  double time = 0;  ///< s
  std::int64_t step = 0;
  double dt = 0;                                   ///< s
  std::string limited_by;                          ///< winning vote of the time step
  double kinetic_energy = 0, internal_energy = 0;  ///< J (J/m in plane strain)
  std::optional<double> external_work;             ///< J (J/m in plane strain), on driven bodies
  double energy_error = 0;                         ///< (total - initial total - external work) / initial total, 1
  std::array<double, 3> momentum{0, 0, 0};         ///< kg m/s
  std::optional<std::array<double, 3>> angular_momentum;  ///< kg m^2/s, about the origin; not between faces
  std::optional<double> angular_momentum_error;           ///< change less external torque over sum |x - x_c| |m v|, 1
  double mass = 0;                                        ///< kg
  double max_pressure = 0;                                ///< Pa
  double min_density = 0, max_density = 0;                ///< kg/m^3
  std::optional<double> min_distension;                   ///< 1; porous materials
  std::optional<double> damaged_mass_fraction;            ///< 1; materials with damage
  std::optional<double>
      largest_fragment_mass_fraction;     ///< of the target over its mass; where fragments are looked for
  std::string fragment_target;            ///< name of that body
  std::optional<std::int64_t> fragments;  ///< of all bodies
};

class History {
 public:
  /// Nothing is written before the first row. After a restart rows later than `resume_at` [s] of the file are dropped.
  History(std::filesystem::path file, int dimension, std::optional<double> resume_at = {});
  /// Throws OutputError if the file cannot be written.
  void write(const HistoryRow& row);

 private:
  std::filesystem::path file_;
  int dimension_;
  std::optional<double> resume_at_;
  std::optional<CsvWriter> writer_;
};

/// Wall time of one stage or sink, summed over its calls.
struct TimerRow {
  std::string name;
  double seconds = 0;
  std::int64_t calls = 0;
};
/// Columns: name, seconds, calls, share of all seconds listed. Throws OutputError if the file cannot be written.
void write_timers(const std::filesystem::path& file, std::span<const TimerRow> timers);

}  // namespace ejecta
