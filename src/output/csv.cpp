#include "output/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "base/errors.hpp"
#include "output/atomic_file.hpp"
#include "render/csv_table.hpp"

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

std::string title_of(const CsvColumn& column) {
  return column.unit.empty() ? column.name : column.name + " [" + column.unit + "]";
}

std::string header_of(std::span<const CsvColumn> columns) {
  std::string header;
  for (const CsvColumn& c : columns) {
    if (!header.empty()) header += ',';
    header += quoted_if_needed(title_of(c));
  }
  return header;
}

/// A row of another table as one of these columns; what it does not know stays empty.
std::string line_of(const CsvTable& table, const std::vector<std::string>& row, std::span<const CsvColumn> columns) {
  std::string line;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (k > 0) line += ',';
    const auto found = std::ranges::find(table.columns, title_of(columns[k]));
    if (found != table.columns.end())
      line += quoted_if_needed(row[static_cast<std::size_t>(found - table.columns.begin())]);
  }
  return line;
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
  const auto kept = [&](const std::string& text) { return std::strtod(text.c_str(), nullptr) <= resume_at; };
  std::ifstream old(file_);
  std::string line;
  if (!std::getline(old, line)) return;
  if (line == lines_[0]) {
    while (std::getline(old, line) && !old.eof() && kept(line)) lines_.push_back(line);
    return;
  }
  const CsvTable table = read_csv(file_);
  const auto known = [&](const std::string& title) {
    return std::ranges::any_of(columns, [&](const CsvColumn& c) { return title_of(c) == title; });
  };
  old_file_has_more_ = !std::ranges::all_of(table.columns, known);
  if (table.columns[0] != title_of(columns[0])) return;
  for (const std::vector<std::string>& row : table.rows)
    if (kept(row[0])) lines_.push_back(line_of(table, row, columns));
}

void CsvWriter::keep_old_file() {
  std::filesystem::path aside = file_.string() + ".aside";
  for (int k = 2; std::filesystem::exists(aside); ++k) aside = fmt::format("{}.aside{}", file_.string(), k);
  std::error_code failure;
  std::filesystem::rename(file_, aside, failure);
  if (failure) throw OutputError(aside, failure.value());
  old_file_has_more_ = false;
}

void CsvWriter::row(std::span<const CsvCell> cells) {
  assert(cells.size() == columns_);
  lines_.push_back(line_of(cells));
  write();
}

void CsvWriter::write() {
  if (old_file_has_more_) keep_old_file();
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
