#pragma once
/// images/data.csv, a Cinema database of specification D: one row an image.
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ejecta {

class ImageIndex {
 public:
  /// Takes over the rows of an earlier part of the run, of images that are still there.
  explicit ImageIndex(std::filesystem::path images_folder);

  /// Adds a row for every PNG of the folder that is new or was written again since the last call, and returns their
  /// paths in alphabetical order. The view is the file name up to its number: `slice_000120.png` belongs to `slice`.
  /// The rows are on disk when this returns. Throws OutputError if they cannot be written, which is tried again next
  /// time, or if an image is only half there, which is removed.
  std::vector<std::string> add_new_images(std::int64_t step, double time);

 private:
  void write_all();
  void append(const std::vector<std::string>& rows);

  std::filesystem::path folder_;
  std::map<std::string, std::filesystem::file_time_type> seen_;  ///< file name -> when it was written
  std::map<std::string, std::string> rows_;                      ///< file name -> row
  bool complete_ = true;                                         ///< whether the file has all rows
};

}  // namespace ejecta
