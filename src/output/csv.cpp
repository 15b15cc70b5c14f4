#include "output/csv.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "base/errors.hpp"

namespace ejecta {

namespace {

std::string quoted_if_needed(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

struct CellText {
  std::string operator()(double value) const { return std::isnan(value) ? "" : fmt::format("{}", value); }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& value) const { return quoted_if_needed(value); }
};

std::string header_of(std::span<const CsvColumn> columns) {
  std::string header;
  for (const CsvColumn& c : columns)
    header += (header.empty() ? "" : ",") + quoted_if_needed(c.unit.empty() ? c.name : c.name + " [" + c.unit + "]");
  return header;
}

}  // namespace

CsvWriter::CsvWriter(std::filesystem::path file, std::span<const CsvColumn> columns)
    : file_(std::move(file)), columns_(columns.size()) {
  begin(header_of(columns), {});
}

CsvWriter::CsvWriter(std::filesystem::path file, std::span<const CsvColumn> columns, double resume_at)
    : file_(std::move(file)), columns_(columns.size()) {
  const std::string header = header_of(columns);
  std::vector<std::string> kept;
  std::ifstream old(file_);
  std::string line;
  if (std::getline(old, line) && line == header)
    while (std::getline(old, line) && !old.eof() && std::strtod(line.c_str(), nullptr) <= resume_at)
      kept.push_back(line);
  old.close();
  begin(header, kept);
}

void CsvWriter::begin(const std::string& header, const std::vector<std::string>& kept_rows) {
  out_.open(file_, std::ios::trunc);
  out_ << header << '\n';
  for (const std::string& row : kept_rows) out_ << row << '\n';
  if (!out_.flush()) throw OutputError(file_);
}

void CsvWriter::row(std::span<const CsvCell> cells) {
  assert(cells.size() == columns_);
  std::string line;
  for (std::size_t k = 0; k < cells.size(); ++k) line += (k ? "," : "") + std::visit(CellText{}, cells[k]);
  out_ << line << '\n';
  if (!out_.flush()) throw OutputError(file_);
}

void write_csv(const std::filesystem::path& file, std::span<const CsvColumn> columns,
               std::span<const std::vector<CsvCell>> rows) {
  CsvWriter writer(file, columns);
  for (const std::vector<CsvCell>& cells : rows) writer.row(cells);
}

}  // namespace ejecta
