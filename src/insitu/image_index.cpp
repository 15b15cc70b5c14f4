#include "insitu/image_index.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <string_view>

#include "base/errors.hpp"

namespace ejecta {
namespace {

constexpr const char* header = "time,step,view,FILE";

std::map<std::string, std::filesystem::file_time_type> list_images(const std::filesystem::path& folder) {
  std::map<std::string, std::filesystem::file_time_type> files;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure))
    if (entry.path().extension() == ".png") files[entry.path().filename().string()] = entry.last_write_time();
  return files;
}

std::string view_of(const std::string& file) {
  const std::string stem = std::filesystem::path(file).stem().string();
  const std::size_t end = stem.find_last_not_of("0123456789");
  if (end == std::string::npos) return stem;
  return stem[end] == '_' && end > 0 ? stem.substr(0, end) : stem.substr(0, end + 1);
}

/// Whether a PNG ends as it must: a full disk cuts it short.
bool is_whole(const std::filesystem::path& png) {
  constexpr std::string_view last_chunk = "IEND\xae\x42\x60\x82";
  std::ifstream in(png, std::ios::binary | std::ios::ate);
  if (in.tellg() < std::streamoff(last_chunk.size())) return false;
  in.seekg(-std::streamoff(last_chunk.size()), std::ios::end);
  std::string end(last_chunk.size(), ' ');
  in.read(end.data(), static_cast<std::streamsize>(end.size()));
  return end == last_chunk;
}

/// Shortest text that reads back as the same number.
std::string text_of(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

}  // namespace

ImageIndex::ImageIndex(std::filesystem::path images_folder) : folder_(std::move(images_folder)) {
  std::error_code failure;
  std::filesystem::create_directories(folder_, failure);
  if (failure) throw OutputError(folder_, failure.message());
  seen_ = list_images(folder_);
  std::ifstream in(folder_ / "data.csv");
  std::string row;
  std::getline(in, row);
  bool gone = false;
  while (std::getline(in, row)) {
    const std::string file = row.substr(row.rfind(',') + 1);
    if (seen_.contains(file))
      rows_[file] = row;
    else
      gone = true;
  }
  if (rows_.empty() || gone) write_all();
}

std::vector<std::string> ImageIndex::add_new_images(std::int64_t step, double time) {
  std::vector<std::string> images, added;
  bool replaced = false;
  std::string torn;
  for (const auto& [file, written] : list_images(folder_)) {
    if (const auto known = seen_.find(file); known != seen_.end() && known->second == written) continue;
    if (!is_whole(folder_ / file)) {
      std::filesystem::remove(folder_ / file);
      torn = file;
      continue;
    }
    seen_[file] = written;
    images.push_back((folder_ / file).string());
    added.push_back(text_of(time) + ',' + std::to_string(step) + ',' + view_of(file) + ',' + file);
    replaced |= !rows_.insert_or_assign(file, added.back()).second;
  }
  // A restarted run draws some frames again: one row an image is kept.
  if (replaced || !complete_ || !std::filesystem::exists(folder_ / "data.csv"))
    write_all();
  else if (!added.empty())
    append(added);
  if (!torn.empty()) throw OutputError(folder_ / torn, "only a part of it got there");
  return images;
}

void ImageIndex::write_all() {
  complete_ = false;
  std::erase_if(rows_, [&](const auto& row) { return !std::filesystem::exists(folder_ / row.first); });
  errno = 0;
  std::ofstream out(folder_ / "data.csv");
  out << header << '\n';
  std::vector<std::string> in_time;
  for (const auto& [file, row] : rows_) in_time.push_back(row);
  std::ranges::stable_sort(in_time, {}, [](const std::string& row) { return std::strtod(row.c_str(), nullptr); });
  for (const std::string& row : in_time) out << row << '\n';
  out.close();
  if (!out) throw OutputError(folder_ / "data.csv");
  complete_ = true;
}

void ImageIndex::append(const std::vector<std::string>& rows) {
  complete_ = false;
  errno = 0;
  std::ofstream out(folder_ / "data.csv", std::ios::app);
  for (const std::string& row : rows) out << row << '\n';
  out.close();
  if (!out) throw OutputError(folder_ / "data.csv");
  complete_ = true;
}

}  // namespace ejecta
