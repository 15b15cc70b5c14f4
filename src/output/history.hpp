#pragma once
/// history.csv: what the run as a whole does in time; timers.csv: where the wall time went.
#include <filesystem>
#include <optional>
#include <span>

#include "base/timers.hpp"
#include "model/quantity.hpp"
#include "output/csv.hpp"

namespace ejecta {

class History {
 public:
  /// Nothing is written before the first row. After a restart rows later than `resume_at` [s] of the file are dropped.
  explicit History(std::filesystem::path file, std::optional<double> resume_at = {});
  /// A row, with a column for each quantity: the same ones every time, the first of them the time. Throws OutputError if
  /// the file cannot be written.
  void write(const Quantities& row);

 private:
  std::filesystem::path file_;
  std::optional<double> resume_at_;
  std::optional<CsvWriter> writer_;
};

/// Columns: name, seconds, calls, share of all seconds listed. Throws OutputError if the file cannot be written.
void write_timers(const std::filesystem::path& file, std::span<const StageTimers::Entry> timers);

}  // namespace ejecta
