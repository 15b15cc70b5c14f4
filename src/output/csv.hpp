#pragma once
/// CSV files with the unit of every column in the header, complete up to the last row at any moment.
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace ejecta {

struct CsvColumn {
  std::string name, unit;  ///< header "name [unit]"; no unit for text
};
using CsvCell = std::variant<double, std::int64_t, std::string>;

/// A table that grows. All rows stay in memory: what could not be written comes with the next row that can, and a file
/// that somebody has removed is written again as a whole.
class CsvWriter {
 public:
  /// A new file, replacing an old one with the first row.
  CsvWriter(std::filesystem::path file, std::span<const CsvColumn> columns);
  /// Goes on with an existing file after a restart: rows whose first column exceeds `resume_at` are dropped.
  /// Of a file with other columns rows keep what the new one has too; if that is not all, the old file is kept as
  /// *.aside.
  CsvWriter(std::filesystem::path file, std::span<const CsvColumn> columns, double resume_at);

  /// Appends one row, one cell a column, and hands it to the system at once. NaN is written as an empty cell. Throws
  /// OutputError if the file cannot be written; it then ends with the last row that it has taken as a whole.
  void row(std::span<const CsvCell> cells);

 private:
  void write();
  void keep_old_file();

  std::filesystem::path file_;
  std::size_t columns_;
  std::vector<std::string> lines_;  ///< header and rows
  std::size_t written_ = 0;         ///< so many of them are in the file
  bool old_file_has_more_ = false;  ///< than what has been taken from it
};

/// A whole table at once. Throws OutputError if it cannot be written.
void write_csv(const std::filesystem::path& file, std::span<const CsvColumn> columns,
               std::span<const std::vector<CsvCell>> rows);

}  // namespace ejecta
