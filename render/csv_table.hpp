#pragma once
/// Reading back the CSV files of a run: one header row, then rows of equal length.
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ejecta {

struct CsvTable {
  static constexpr std::size_t npos = static_cast<std::size_t>(-1);
  std::vector<std::string> columns;            ///< as in the header: "time [s]"
  std::vector<std::vector<std::string>> rows;  ///< shorter rows (a run cut off while writing) are left out

  /// Index of the column with this name, with or without its unit; npos if there is none.
  std::size_t find(std::string_view name) const;
  /// What stands in brackets after the name; empty if nothing does.
  std::string unit(std::size_t column) const;
};

/// Cells may be quoted as in "a, b". Throws InputError if the file cannot be read.
CsvTable read_csv(const std::filesystem::path& file);

}  // namespace ejecta
