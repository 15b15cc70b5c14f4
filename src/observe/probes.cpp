#include "observe/probes.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.hpp"
#include "observe/measured.hpp"
#include "scene/names.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;

/// Numbers of a probe that checkpoints keep.
class Memory {
 public:
  Memory(std::map<std::string, double>& notes, const Probe& probe)
      : notes_(notes), name_("probe " + probe.name + " ") {}
  double& operator[](const std::string& what) { return notes_[name_ + what]; }

 private:
  std::map<std::string, double>& notes_;
  std::string name_;
};

constexpr const char* particle = "particle";

std::int32_t particle_of(const Simulation& sim, const Probe& probe) {
  const auto note = sim.notes.find(fmt::format("probe {} {}", probe.name, particle));
  return note == sim.notes.end() ? -1 : static_cast<std::int32_t>(note->second);
}

bool strains(const Probe& probe) { return probe.kind == ProbeKind::tracer && probe.directed(); }

Vec<3> direction(const Probe& probe) { return Vec<3>(probe.direction.data()).normalized(); }

/// Reading, and what follows from a direction: the columns after the time, but for the strain.
std::vector<double> values_of(const Simulation& sim, const Probe& probe, const ProbeReading& reading) {
  std::vector<double> values = reading.values;
  if (probe.kind == ProbeKind::velocimeter || !probe.directed()) return values;
  double along = 0;
  for (int a = 0; a < sim.scene.dimension; ++a)
    along += direction(probe)[a] * reading.values[static_cast<std::size_t>(2 + a)];
  values.push_back(probe.beam() ? -along : along);
  return values;
}

std::vector<CsvColumn> columns_of(const Simulation& sim, const Probe& probe) {
  std::vector<CsvColumn> columns = reading_columns(sim, probe);
  columns.insert(columns.begin(), {"time", "s"});
  if (probe.kind != ProbeKind::velocimeter && probe.directed()) columns.push_back({"velocity", "m/s"});
  if (strains(probe)) columns.push_back({"strain", "1"});
  return columns;
}

/// Carries the deformation F of a tracer's matter on: dF/dt = L F by the midpoint rule, with the mean of the velocity
/// gradients L at both ends of the step. Returns the strain along the probe's direction.
double strain(Memory memory, const Probe& probe, const Mat<3>& gradient, double dt) {
  Mat<3> deformation, mean = gradient;
  const bool begun = memory["deforms"] != 0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      double& before = memory[fmt::format("gradient {}{}", a, b)];
      if (begun) mean(a, b) = 0.5 * (before + gradient(a, b));
      before = gradient(a, b);
      deformation(a, b) = begun ? memory[fmt::format("deformation {}{}", a, b)] : a == b;
    }
  const Mat<3> half = 0.5 * dt * mean, one = Mat<3>::Identity();
  if (begun) deformation = ((one - half).inverse() * (one + half) * deformation).eval();
  memory["deforms"] = 1;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) memory[fmt::format("deformation {}{}", a, b)] = deformation(a, b);
  return (deformation * direction(probe)).norm() - 1;
}

}  // namespace

std::vector<std::string> place_probes(Simulation& sim) {
  std::vector<std::string> problems, odd;
  for (const Probe& probe : sim.scene.probes) {
    if (!probe.measured.empty()) check_measured_trace(probe.measured, columns_of(sim, probe));
    const std::string key = fmt::format("{}: probes.{}.at", probe.origin, probe.name);
    const auto nearest = mount(sim, probe);
    const std::string where =
        !nearest ? "no particles"
                 : fmt::format("the nearest particle{} {} away", probe.body.empty() ? "" : " of " + probe.body,
                               format_quantity(nearest->distance, "m"));
    if (probe.rides()) {
      if (particle_of(sim, probe) >= 0) continue;
      if (probe.kind == ProbeKind::surface && !nearest)
        problems.push_back(fmt::format("{}: expected a beam that meets matter{}, got one that meets nothing", key,
                                       probe.body.empty() ? "" : " of " + probe.body));
      else if (!nearest || (probe.kind == ProbeKind::tracer && nearest->distance > 2 * sim.scene.spacing))
        problems.push_back(fmt::format("{}: expected a place within matter, got {}", key, where));
      else
        Memory(sim.notes, probe)[particle] = nearest->id;
    } else if (std::isnan(read_probe(sim, probe, -1).values[0])) {
      odd.push_back(fmt::format("{}: the {} sees nothing at t = {}: {}", key, name_of(probe.kind),
                                format_quantity(sim.clock.time, "s"), where));
    }
  }
  if (!problems.empty()) throw InputError(problems);
  return odd;
}

Quantities quantities_of_probes(const Simulation& sim) {
  Quantities list;
  for (const Probe& probe : sim.scene.probes) {
    const ProbeReading reading = read_probe(sim, probe, particle_of(sim, probe));
    const std::string name = "probe " + probe.name;
    if (probe.directed())
      list.push_back({name + " velocity", "m/s",
                      probe.kind == ProbeKind::velocimeter ? reading.values[0] : values_of(sim, probe, reading).back(),
                      "along its direction", true});
    if (probe.kind != ProbeKind::velocimeter)
      list.push_back({name + " pressure", "Pa", reading.values[1], "where it is", true});
  }
  return list;
}

Probes::Probes(const Simulation& sim, fs::path folder, Outputs& outputs, const std::optional<Clock>& resume_at)
    : folder_(std::move(folder)), outputs_(outputs) {
  for (const Probe& probe : sim.scene.probes) {
    const double interval = is_set(probe.interval) ? probe.interval : sim.scene.row_interval();
    tables_.push_back({probe, columns_of(sim, probe), RowTimes(interval, sim.scene.output.times, resume_at), {}});
    if (!probe.measured.empty())
      outputs_.write("probe_" + probe.name + "_measured.csv", Outputs::Loss::for_good, [&] {
        fs::copy_file(probe.measured, folder_ / ("probe_" + probe.name + "_measured.csv"),
                      fs::copy_options::overwrite_existing);
      });
  }
}

void Probes::observe(Simulation& sim, bool last) {
  for (Table& table : tables_) sim.timers.time("probes", [&] { read(sim, table, last); });
}

void Probes::read(Simulation& sim, Table& table, bool last) {
  const Probe& probe = table.probe;
  Memory memory(sim.notes, probe);
  // A restart looks again at the step of its checkpoint.
  const auto steps = static_cast<double>(sim.clock.step + 1);
  if (std::exchange(memory["steps"], steps) == steps) return;
  const bool in_window = sim.clock.time > table.due.next_row() - probe.window;
  const bool due = table.due.pass(sim.clock.time), row = due || last;
  if (!row && !in_window && !strains(probe)) return;
  const ProbeReading reading = read_probe(sim, probe, particle_of(sim, probe));
  std::vector<double> values = values_of(sim, probe, reading);
  if (strains(probe)) values.push_back(strain(memory, probe, reading.gradient, sim.clock.dt));
  if (in_window && probe.window > 0) {
    double& weight = memory["weight"];
    weight += sim.clock.dt;
    for (std::size_t k = 0; k < values.size(); ++k) {
      double& sum = memory[fmt::format("sum {}", k)];
      sum += sim.clock.dt * values[k];
      if (row && weight > 0) values[k] = sum / weight;
      if (due) sum = 0;
    }
    if (due) weight = 0;
  }
  if (!row) return;
  values.insert(values.begin(), sim.clock.time);
  outputs_.write("probe_" + probe.name + ".csv", Outputs::Loss::until_next, [&] { write(table, values); });
}

void Probes::write(Table& table, const std::vector<double>& row) {
  if (!table.rows) {
    const fs::path file = folder_ / ("probe_" + table.probe.name + ".csv");
    if (const auto until = table.due.kept_until())
      table.rows.emplace(file, table.columns, *until);
    else
      table.rows.emplace(file, table.columns);
  }
  table.rows->row(std::vector<CsvCell>(row.begin(), row.end()));
}

}  // namespace ejecta
