#include "observe/measured.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/errors.hpp"
#include "render/csv_table.hpp"

namespace ejecta {

namespace {

std::string header(const CsvColumn& column) { return fmt::format("{} [{}]", column.name, column.unit); }

bool has(const CsvTable& table, const CsvColumn& column) {
  return std::ranges::find(table.columns, header(column)) != table.columns.end();
}

void refuse(const std::string& file, const std::string& expected, const CsvTable& table) {
  throw InputError(fmt::format("{}:1: expected {}, got {}", file, expected, fmt::join(table.columns, ", ")));
}

/// A cell as a number; none if it is not one.
std::optional<double> number(const std::string& cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

struct Trace {
  std::vector<double> time, value;
};

/// Rows in which both time and value are numbers.
Trace trace_of(const CsvTable& table, const CsvColumn& column) {
  Trace trace;
  const std::size_t t = table.find(header({"time", "s"})), v = table.find(header(column));
  for (const std::vector<std::string>& row : table.rows)
    if (const auto time = number(row[t]), value = number(row[v]); time && value) {
      trace.time.push_back(*time);
      trace.value.push_back(*value);
    }
  return trace;
}

}  // namespace

std::vector<double> measured_masses(const std::string& file) {
  const CsvTable table = read_csv(file);
  const CsvColumn mass{"mass", "kg"};
  if (!has(table, mass)) refuse(file, "a column " + header(mass), table);
  std::vector<double> masses;
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const std::string& cell = table.rows[k][table.find(header(mass))];
    const auto value = number(cell);
    if (!value || !(*value > 0))
      throw InputError(fmt::format("{}:{}: mass: expected a number > 0, got \"{}\"", file, k + 2, cell));
    masses.push_back(*value);
  }
  return masses;
}

void check_measured_trace(const std::string& file, const std::vector<CsvColumn>& columns) {
  const CsvTable table = read_csv(file);
  if (!has(table, {"time", "s"})) refuse(file, "a column time [s]", table);
  std::vector<std::string> known;
  for (const CsvColumn& column : columns)
    if (column.name != "time") known.push_back(header(column));
  if (std::ranges::none_of(columns, [&](const CsvColumn& c) { return c.name != "time" && has(table, c); }))
    refuse(file, fmt::format("one of the columns {}", fmt::join(known, ", ")), table);
}

std::vector<Misfit> compare_traces(const std::filesystem::path& computed, const std::filesystem::path& measured,
                                   double delay) {
  const CsvTable ours = read_csv(computed), theirs = read_csv(measured);
  std::vector<Misfit> list;
  for (const std::string& name : theirs.columns) {
    if (name == header({"time", "s"}) || std::ranges::find(ours.columns, name) == ours.columns.end()) continue;
    const std::size_t bracket = name.rfind(" [");
    Misfit misfit{{name.substr(0, bracket), name.substr(bracket + 2, name.size() - bracket - 3)}};
    const Trace here = trace_of(ours, misfit.column), there = trace_of(theirs, misfit.column);
    for (std::size_t k = 0; k < there.time.size(); ++k) {
      const double time = there.time[k] + delay;
      const auto after = std::ranges::lower_bound(here.time, time);
      if (after == here.time.end() || (after == here.time.begin() && *after > time)) continue;
      const auto j = static_cast<std::size_t>(after - here.time.begin()), i = j == 0 ? 0 : j - 1;
      const double share = i == j ? 0 : (time - here.time[i]) / (here.time[j] - here.time[i]);
      const double difference = std::lerp(here.value[i], here.value[j], share) - there.value[k];
      misfit.mean += difference;
      misfit.rms += difference * difference;
      ++misfit.points;
    }
    if (misfit.points == 0) continue;
    misfit.mean /= static_cast<double>(misfit.points);
    misfit.rms = std::sqrt(misfit.rms / static_cast<double>(misfit.points));
    list.push_back(misfit);
  }
  return list;
}

}  // namespace ejecta
