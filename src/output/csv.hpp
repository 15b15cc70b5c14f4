#pragma once
/// CSV files with the unit of every column in the header, complete up to the last row at any moment.
#include <cstdint>
#include <filesystem>
#include <fstream>
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

/// Throws OutputError if the file cannot be opened or a row cannot be written.
class CsvWriter {
 public:
  /// A new file, replacing an old one.
  CsvWriter(std::filesystem::path file, std::span<const CsvColumn> columns);
  /// Goes on with an existing file after a restart: rows whose first column exceeds `resume_at` are dropped.
  /// A file that is not there, or has other columns, is begun anew.
  CsvWriter(std::filesystem::path file, std::span<const CsvColumn> columns, double resume_at);

  /// Appends one row, one cell a column, and hands it to the system at once. NaN is written as an empty cell.
  void row(std::span<const CsvCell> cells);

 private:
  void begin(const std::string& header, const std::vector<std::string>& kept_rows);

  std::filesystem::path file_;
  std::size_t columns_;
  std::ofstream out_;
};

/// A whole table at once.
void write_csv(const std::filesystem::path& file, std::span<const CsvColumn> columns,
               std::span<const std::vector<CsvCell>> rows);

}  // namespace ejecta
