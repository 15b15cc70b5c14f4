#include "output/csv.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "base/errors.hpp"
#include "output/atomic_file.hpp"

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
  for (const CsvColumn& c : columns) {
    if (!header.empty()) header += ',';
    header += quoted_if_needed(c.unit.empty() ? c.name : c.name + " [" + c.unit + "]");
  }
  return header;
}

std::string line_of(std::span<const CsvCell> cells) {
  std::string line;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k > 0) line += ',';
    line += std::visit(CellText{}, cells[k]);
  }
  return line;
}

std::string joined(std::span<const std::string> lines) {
  std::string text;
  for (const std::string& line : lines) {
    text += line;
    text += '\n';
  }
  return text;
}

}  // namespace

CsvWriter::CsvWriter(std::filesystem::path file, std::span<const CsvColumn> columns)
    : file_(std::move(file)), columns_(columns.size()), lines_{header_of(columns)} {}

CsvWriter::CsvWriter(std::filesystem::path file, std::span<const CsvColumn> columns, double resume_at)
    : CsvWriter(std::move(file), columns) {
  std::ifstream old(file_);
  std::string line;
  if (std::getline(old, line) && line == lines_[0])
    while (std::getline(old, line) && !old.eof() && std::strtod(line.c_str(), nullptr) <= resume_at)
      lines_.push_back(line);
}

void CsvWriter::row(std::span<const CsvCell> cells) {
  assert(cells.size() == columns_);
  lines_.push_back(line_of(cells));
  write();
}

void CsvWriter::write() {
  std::error_code gone;
  const std::uintmax_t size = std::filesystem::file_size(file_, gone);
  if (gone || written_ == 0) {
    write_atomically(file_, joined(lines_));
  } else {
    errno = 0;
    std::ofstream out(file_, std::ios::app);
    out << joined(std::span(lines_).subspan(written_));
    out.close();
    if (!out) {
      const int reason = errno;
      std::filesystem::resize_file(file_, size, gone);  // no half of a row
      throw OutputError(file_, reason);
    }
  }
  written_ = lines_.size();
}

void write_csv(const std::filesystem::path& file, std::span<const CsvColumn> columns,
               std::span<const std::vector<CsvCell>> rows) {
  std::vector<std::string> lines{header_of(columns)};
  for (const std::vector<CsvCell>& cells : rows) lines.push_back(line_of(cells));
  write_atomically(file, joined(lines));
}

}  // namespace ejecta
