#pragma once
/// images/data.csv, a Cinema database of specification D: one row a file that a pipeline has written.
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ejecta {

class ImageIndex {
 public:
  /// Takes over the rows of an earlier part of the run, of files that are still there.
  explicit ImageIndex(std::filesystem::path images_folder);

  /// Adds a row for every file in the folder, or in one inside it, that is new or was written again since the last
  /// call, and returns their paths in alphabetical order. `reason`: why they were written. The rows are on disk when
  /// this returns. Throws OutputError if they cannot be written, which is tried again next time, or if an image is only
  /// half there, which is removed.
  std::vector<std::string> add_new_files(std::int64_t step, double time, const std::string& reason);

 private:
  void write_all();
  void append(const std::vector<std::string>& rows);

  std::filesystem::path folder_;
  std::map<std::string, std::filesystem::file_time_type> seen_;  ///< file, relative to the folder -> written when
  std::vector<std::pair<std::string, std::string>> rows_;        ///< file and its row, in the order of writing
  bool complete_ = true;                                         ///< whether the table has all rows
};

/// Of which view a file is: its name without ending and without the number of the step, or where that is not in it
/// without the number at its end. slice_000120.png is of `slice`; of a camera that sweeps each place is a view.
std::string view_of(const std::filesystem::path& file, std::int64_t step);

}  // namespace ejecta
