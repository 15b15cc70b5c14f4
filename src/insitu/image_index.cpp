#include "insitu/image_index.hpp"

#include <charconv>
#include <fstream>

#include "base/errors.hpp"

namespace ejecta {
namespace {

constexpr const char* header = "time,step,view,FILE";

std::map<std::string, std::filesystem::file_time_type> list_images(const std::filesystem::path& folder) {
  std::map<std::string, std::filesystem::file_time_type> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".png") files[entry.path().filename().string()] = entry.last_write_time();
  return files;
}

std::string view_of(const std::string& file) {
  const std::string stem = std::filesystem::path(file).stem().string();
  const std::size_t end = stem.find_last_not_of("0123456789");
  if (end == std::string::npos) return stem;
  return stem[end] == '_' && end > 0 ? stem.substr(0, end) : stem.substr(0, end + 1);
}

/// Shortest text that reads back as the same number.
std::string text_of(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

}  // namespace

ImageIndex::ImageIndex(std::filesystem::path images_folder) : folder_(std::move(images_folder)) {
  std::filesystem::create_directories(folder_);
  seen_ = list_images(folder_);
  std::ifstream in(folder_ / "data.csv");
  std::string row;
  std::getline(in, row);
  while (std::getline(in, row)) rows_[row.substr(row.rfind(',') + 1)] = row;
  if (rows_.empty()) write({}, std::ios::trunc);
}

std::vector<std::string> ImageIndex::add_new_images(std::int64_t step, double time) {
  std::vector<std::string> images, added;
  bool replaced = false;
  for (const auto& [file, written] : list_images(folder_)) {
    if (const auto known = seen_.find(file); known != seen_.end() && known->second == written) continue;
    seen_[file] = written;
    images.push_back((folder_ / file).string());
    added.push_back(text_of(time) + ',' + std::to_string(step) + ',' + view_of(file) + ',' + file);
    replaced |= !rows_.insert_or_assign(file, added.back()).second;
  }
  if (replaced) {  // a restarted run draws some frames again: keep one row an image
    added.clear();
    for (const auto& [file, row] : rows_) added.push_back(row);
    write(added, std::ios::trunc);
  } else if (!added.empty()) {
    write(added, std::ios::app);
  }
  return images;
}

void ImageIndex::write(const std::vector<std::string>& rows, std::ios::openmode mode) const {
  std::ofstream out(folder_ / "data.csv", mode);
  if (mode == std::ios::trunc) out << header << '\n';
  for (const std::string& row : rows) out << row << '\n';
  out.close();
  if (!out) throw OutputError(folder_ / "data.csv");
}

}  // namespace ejecta
