#pragma once
/// images/data.csv, a Cinema database of specification D: one row an image.
#include <cstdint>
#include <filesystem>
#include <ios>
#include <map>
#include <string>
#include <vector>

namespace ejecta {

class ImageIndex {
 public:
  /// Takes over the rows of an earlier part of the run.
  explicit ImageIndex(std::filesystem::path images_folder);

  /// Adds a row for every PNG of the folder that is new or was written again since the last call, and returns their
  /// paths in alphabetical order. The view is the file name up to its number: `slice_000120.png` belongs to `slice`.
  /// The rows are on disk when this returns. Throws OutputError if they cannot be written.
  std::vector<std::string> add_new_images(std::int64_t step, double time);

 private:
  /// Anew with the header (trunc), or after the rows that are there (app).
  void write(const std::vector<std::string>& rows, std::ios::openmode mode) const;

  std::filesystem::path folder_;
  std::map<std::string, std::filesystem::file_time_type> seen_;  ///< file name -> when it was written
  std::map<std::string, std::string> rows_;                      ///< file name -> row
};

}  // namespace ejecta
