#include "render/csv_table.hpp"

#include <fstream>

#include "base/errors.hpp"

namespace ejecta {

namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (c == '"' && quoted && k + 1 < line.size() && line[k + 1] == '"')
      cells.back() += line[++k];
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  }
  return cells;
}

}  // namespace

std::size_t CsvTable::find(std::string_view name) const {
  for (std::size_t k = 0; k < columns.size(); ++k)
    if (columns[k] == name || columns[k].starts_with(std::string(name) + " [")) return k;
  return npos;
}

std::string CsvTable::unit(std::size_t column) const {
  const std::string& title = columns[column];
  const std::size_t open = title.rfind('['), close = title.rfind(']');
  return open == std::string::npos || close == std::string::npos ? "" : title.substr(open + 1, close - open - 1);
}

CsvTable read_csv(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line)) throw InputError(file.string() + ": expected a CSV file with a header, cannot read it");
  CsvTable table;
  table.columns = split(line);
  while (std::getline(in, line))
    if (std::vector<std::string> cells = split(line); cells.size() == table.columns.size())
      table.rows.push_back(std::move(cells));
  return table;
}

}  // namespace ejecta
