#include "observe/measured.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

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

}  // namespace

std::vector<double> measured_masses(const std::string& file) {
  const CsvTable table = read_csv(file);
  const CsvColumn mass{"mass", "kg"};
  if (!has(table, mass)) refuse(file, "a column " + header(mass), table);
  std::vector<double> masses;
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const std::string& cell = table.rows[k][table.find(header(mass))];
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !(value > 0))
      throw InputError(fmt::format("{}:{}: mass: expected a number > 0, got \"{}\"", file, k + 2, cell));
    masses.push_back(value);
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

}  // namespace ejecta
