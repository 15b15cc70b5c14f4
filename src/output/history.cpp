#include "output/history.hpp"

#include <utility>
#include <vector>

namespace ejecta {

History::History(std::filesystem::path file, std::optional<double> resume_at)
    : file_(std::move(file)), resume_at_(resume_at) {}

void History::write(const Quantities& row) {
  std::vector<CsvColumn> columns;
  std::vector<CsvCell> cells;
  for (const Quantity& q : row) {
    columns.push_back({q.name, q.unit});
    cells.push_back(q.value);
  }
  if (!writer_) {
    if (resume_at_)
      writer_.emplace(file_, columns, *resume_at_);
    else
      writer_.emplace(file_, columns);
  }
  writer_->row(cells);
}

void write_timers(const std::filesystem::path& file, std::span<const StageTimers::Entry> timers) {
  double total = 0;
  for (const StageTimers::Entry& t : timers) total += t.seconds;
  std::vector<std::vector<CsvCell>> rows;
  for (const StageTimers::Entry& t : timers)
    rows.push_back({t.name, t.seconds, t.calls, total > 0 ? t.seconds / total : 0.0});
  write_csv(file, std::vector<CsvColumn>{{"name", ""}, {"wall time", "s"}, {"calls", "1"}, {"share", "1"}}, rows);
}

}  // namespace ejecta
