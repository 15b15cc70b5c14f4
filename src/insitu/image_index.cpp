#include "insitu/image_index.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <utility>

#include "base/errors.hpp"
#include "render/csv_table.hpp"

namespace ejecta {
namespace {

constexpr const char* header = "time,step,view,reason,FILE";
constexpr std::string_view digits = "0123456789";

std::map<std::string, std::filesystem::file_time_type> list_files(const std::filesystem::path& folder) {
  std::map<std::string, std::filesystem::file_time_type> files;
  std::error_code failure;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, failure))
    if (entry.is_regular_file() && entry.path().filename() != "data.csv")
      files[entry.path().lexically_relative(folder).string()] = entry.last_write_time();
  return files;
}

/// Names of files may hold commas.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

/// A name without the number of the step, or where that is not in it without the number at its end. Of several numbers
/// that are the step one after an underscore is meant, and the longest.
std::string without_step(std::string name, std::int64_t step) {
  std::size_t begin = name.find_last_not_of("0123456789.") + 1, end = name.size();
  std::pair<bool, std::size_t> best{false, 0};
  for (std::size_t at = name.find_first_of(digits); at != std::string::npos;) {
    const std::size_t after = std::min(name.find_first_not_of(digits, at), name.size());
    std::int64_t number = -1;
    std::from_chars(name.data() + at, name.data() + after, number);
    const std::pair rank{at > 0 && name[at - 1] == '_', after - at};
    if (number == step && rank > best) best = rank, begin = at, end = after;
    at = name.find_first_of(digits, after);
  }
  if (begin > 0 && name[begin - 1] == '_') --begin;
  return name.erase(begin, end - begin);
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

std::string view_of(const std::filesystem::path& file, std::int64_t step) {
  const std::filesystem::path name = file.parent_path() / file.stem();
  std::string view;
  for (const std::filesystem::path& part : name) view += (view.empty() ? "" : "_") + without_step(part.string(), step);
  return view.empty() ? file.stem().string() : view;
}

ImageIndex::ImageIndex(std::filesystem::path images_folder) : folder_(std::move(images_folder)) {
  std::error_code failure;
  std::filesystem::create_directories(folder_, failure);
  if (failure) throw OutputError(folder_, failure.message());
  seen_ = list_files(folder_);
  bool gone = false;
  if (std::filesystem::exists(folder_ / "data.csv")) {
    const CsvTable table = read_csv(folder_ / "data.csv");
    const auto value = [&](const std::vector<std::string>& row, const char* column) {
      const std::size_t k = table.find(column);
      return k == CsvTable::npos ? std::string() : cell(row[k]);  // tables of earlier versions have no reason
    };
    if (const std::size_t file = table.find("FILE"); file != CsvTable::npos)
      for (const std::vector<std::string>& row : table.rows)
        if (seen_.contains(row[file]))
          rows_.emplace_back(row[file], value(row, "time") + ',' + value(row, "step") + ',' + value(row, "view") + ',' +
                             value(row, "reason") + ',' + value(row, "FILE"));
        else
          gone = true;
  }
  if (rows_.empty() || gone) write_all();
}

std::vector<std::string> ImageIndex::add_new_files(std::int64_t step, double time, const std::string& reason) {
  std::vector<std::string> files, added;
  bool replaced = false;
  std::string torn;
  for (const auto& [file, written] : list_files(folder_)) {
    if (const auto known = seen_.find(file); known != seen_.end() && known->second == written) continue;
    if (file.ends_with(".png") && !is_whole(folder_ / file)) {
      std::filesystem::remove(folder_ / file);
      torn = file;
      continue;
    }
    seen_[file] = written;
    files.push_back((folder_ / file).string());
    added.push_back(text_of(time) + ',' + std::to_string(step) + ',' + cell(view_of(file, step)) + ',' + cell(reason) +
                    ',' + cell(file));
    const auto listed = std::ranges::find(rows_, file, &std::pair<std::string, std::string>::first);
    replaced |= listed != rows_.end();
    if (listed != rows_.end())
      listed->second = added.back();
    else
      rows_.emplace_back(file, added.back());
  }
  // A restarted run draws some frames again: one row a file is kept.
  if (replaced || !complete_ || !std::filesystem::exists(folder_ / "data.csv"))
    write_all();
  else if (!added.empty())
    append(added);
  if (!torn.empty()) throw OutputError(folder_ / torn, "only a part of it got there");
  return files;
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
