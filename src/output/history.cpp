#include "output/history.hpp"

#include <utility>
#include <vector>

namespace ejecta {

namespace {

struct Table {
  std::vector<CsvColumn> columns;
  std::vector<CsvCell> cells;
  template <class T>
  void add(const char* name, std::string unit, T value) {
    columns.push_back({name, std::move(unit)});
    cells.emplace_back(std::move(value));
  }
  template <class T>
  void add_if(const char* name, const std::string& unit, const std::optional<T>& value) {
    if (value) add(name, unit, *value);
  }
};

Table table_of(const HistoryRow& r, int dimension) {
  // Plane strain counts per metre of depth.
  const std::string per = dimension == 2 ? "/m" : "";
  Table t;
  t.add("time", "s", r.time);
  t.add("step", "1", r.step);
  t.add("dt", "s", r.dt);
  t.add("limited by", "", r.limited_by);
  t.add("kinetic energy", "J" + per, r.kinetic_energy);
  t.add("internal energy", "J" + per, r.internal_energy);
  t.add("total energy", "J" + per, r.kinetic_energy + r.internal_energy);
  t.add_if("external work", "J" + per, r.external_work);
  t.add("energy error", "1", r.energy_error);
  const std::string momentum = dimension == 2 ? "kg/s" : "kg m/s";
  t.add("momentum x", momentum, r.momentum[0]);
  t.add("momentum y", momentum, r.momentum[1]);
  if (dimension == 3) t.add("momentum z", momentum, r.momentum[2]);
  const std::string angular = dimension == 2 ? "kg m/s" : "kg m^2/s";
  if (r.angular_momentum) {
    if (dimension == 3) t.add("angular momentum x", angular, (*r.angular_momentum)[0]);
    if (dimension == 3) t.add("angular momentum y", angular, (*r.angular_momentum)[1]);
    t.add("angular momentum z", angular, (*r.angular_momentum)[2]);
  }
  t.add_if("angular momentum error", "1", r.angular_momentum_error);
  t.add("mass", "kg" + per, r.mass);
  t.add("max pressure", "Pa", r.max_pressure);
  t.add("min density", "kg/m^3", r.min_density);
  t.add("max density", "kg/m^3", r.max_density);
  t.add_if("min distension", "1", r.min_distension);
  t.add_if("damaged mass fraction", "1", r.damaged_mass_fraction);
  t.add_if("largest fragment mass fraction", "mass of " + r.fragment_target, r.largest_fragment_mass_fraction);
  t.add_if("fragments", "1", r.fragments);
  return t;
}

}  // namespace

History::History(std::filesystem::path file, int dimension, std::optional<double> resume_at)
    : file_(std::move(file)), dimension_(dimension), resume_at_(resume_at) {}

void History::write(const HistoryRow& row) {
  const Table table = table_of(row, dimension_);
  if (!writer_) {
    if (resume_at_)
      writer_.emplace(file_, table.columns, *resume_at_);
    else
      writer_.emplace(file_, table.columns);
  }
  writer_->row(table.cells);
}

void write_timers(const std::filesystem::path& file, std::span<const TimerRow> timers) {
  double total = 0;
  for (const TimerRow& t : timers) total += t.seconds;
  std::vector<std::vector<CsvCell>> rows;
  for (const TimerRow& t : timers) rows.push_back({t.name, t.seconds, t.calls, total > 0 ? t.seconds / total : 0.0});
  write_csv(file, std::vector<CsvColumn>{{"name", ""}, {"wall time", "s"}, {"calls", "1"}, {"share", "1"}}, rows);
}

}  // namespace ejecta
