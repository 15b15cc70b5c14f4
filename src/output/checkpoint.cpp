#include "output/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <cerrno>
#include <cstdlib>
#include <fstream>

#include "base/errors.hpp"
#include "output/atomic_file.hpp"
#include "output/hdf5_file.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;
constexpr std::int64_t format_version = 1;

template <class Map>
const typename Map::mapped_type& found(const Map& map, const std::string& name, const Checkpoint& checkpoint) {
  const auto entry = map.find(name);
  if (entry == map.end())
    throw InputError(fmt::format("{}: expected a checkpoint with \"{}\", which this one does not hold",
                                 checkpoint.file.string(), name));
  return entry->second;
}

/// "grid." of "grid.pressure"; empty without a dot.
std::string prefix_of(const std::string& name) { return name.substr(0, name.find('.') + 1); }

/// Checkpoints of a folder, oldest first: the zero-padded step sorts by name.
std::vector<fs::path> checkpoints_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("checkpoint_") && name.ends_with(".h5")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// "checkpoint_000000000042.h5" -> 42
std::int64_t step_of(const fs::path& file) {
  return std::atoll(file.filename().string().substr(std::string_view("checkpoint_").size()).c_str());
}

constexpr std::string_view seal_words = "Ejecta checkpoint; CRC-32 of all that follows the first 512 bytes: ";

/// The checksum of everything behind the user block, as it stands in the file now.
std::string checksum(std::ifstream& in) {
  boost::crc_32_type crc;
  std::vector<char> block(1 << 20);
  in.clear();
  in.seekg(hdf5_user_block);
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0)
    crc.process_bytes(block.data(), static_cast<std::size_t>(in.gcount()));
  return fmt::format("{:08x}", crc.checksum());
}

/// Writes the checksum into the user block.
void seal(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string header = std::string(seal_words) + checksum(in) + '\n';
  header.resize(hdf5_user_block, ' ');
  errno = 0;
  std::ofstream out(file, std::ios::binary | std::ios::in | std::ios::out);
  out << header;
  out.close();
  if (!out) throw OutputError(file);
}

/// Files of earlier versions have no seal, and pass.
void check_seal(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string header(hdf5_user_block, '\0');
  in.read(header.data(), static_cast<std::streamsize>(header.size()));
  if (!header.starts_with(seal_words)) return;
  if (header.compare(seal_words.size(), 8, checksum(in)) != 0)
    throw InputError(
        file.string() +
        ": expected the contents that were written, got others: its checksum differs (truncated or damaged)");
}

}  // namespace

const std::vector<double>& Checkpoint::column(const std::string& name) const { return found(columns, name, *this); }
const std::vector<std::int32_t>& Checkpoint::label(const std::string& name) const { return found(labels, name, *this); }
double Checkpoint::scalar(const std::string& name) const { return found(scalars, name, *this); }
std::size_t Checkpoint::size(const std::string& prefix) const {
  for (const auto& [name, values] : columns)
    if (prefix_of(name) == prefix) return values.size();
  for (const auto& [name, values] : labels)
    if (prefix_of(name) == prefix) return values.size();
  return 0;
}

void write_checkpoint(const fs::path& file, const CheckpointView& view) {
  ensure_folder(file.parent_path());
  const PartGuard guard(file);
  {
    Hdf5File out(part_name(file), Hdf5File::Mode::create);
    out.write_attribute("format", format_version);
    out.write_attribute("time", view.time);
    out.write_attribute("dt", view.dt);
    out.write_attribute("step", view.step);
    out.write_text("/scene", view.scene);
    for (const auto& [name, value] : view.scalars) out.write("/scalars/" + name, "SI", std::span(&value, 1));
    for (const auto& column : view.columns) out.write("/columns/" + column.name, column.unit, column.values);
    for (const auto& label : view.labels) out.write("/labels/" + label.name, label.unit, label.values);
    out.close();
  }
  seal(part_name(file));
  sync_to_disk(part_name(file));
  move_into_place(file);
  sync_to_disk(file.parent_path());
}

fs::path write_rotating_checkpoint(const fs::path& folder, const CheckpointView& view, int kept) {
  const fs::path file = folder / fmt::format("checkpoint_{:012d}.h5", view.step);
  write_checkpoint(file, view);
  const std::vector<fs::path> files = checkpoints_in(folder);
  std::error_code stays;
  for (std::size_t k = 0; k + static_cast<std::size_t>(kept) < files.size(); ++k) fs::remove(files[k], stays);
  return file;
}

std::optional<fs::path> latest_checkpoint(const fs::path& folder) {
  const std::vector<fs::path> files = checkpoints_in(folder);
  return files.empty() ? std::nullopt : std::optional(files.back());
}

Checkpoint read_latest_checkpoint(const fs::path& folder, std::vector<std::string>& problems) {
  std::vector<fs::path> files = checkpoints_in(folder);
  for (; !files.empty(); files.pop_back()) try {
      return read_checkpoint(files.back());
    } catch (const InputError& error) {
      problems.emplace_back(error.what());
    }
  if (problems.empty()) problems.push_back(folder.string() + ": expected a checkpoint, found none");
  throw InputError(problems);
}

std::vector<std::string> set_later_checkpoints_aside(const fs::path& folder, std::int64_t step) {
  std::vector<std::string> names;
  for (const fs::path& file : checkpoints_in(folder)) {
    if (step_of(file) <= step) continue;
    std::error_code failure;
    fs::rename(file, file.string() + ".aside", failure);
    if (failure) throw OutputError(file, failure.message());
    names.push_back(file.filename().string());
  }
  return names;
}

CheckpointClock read_checkpoint_clock(const fs::path& file) {
  const Hdf5File in(file, Hdf5File::Mode::read);
  return {in.real_attribute("time"), in.integer_attribute("step")};
}

Checkpoint read_checkpoint(const fs::path& file) {
  check_seal(file);
  const Hdf5File in(file, Hdf5File::Mode::read);
  if (const std::int64_t version = in.integer_attribute("format"); version != format_version)
    throw InputError(fmt::format("{}: expected checkpoint format {}, got {}", file.string(), format_version, version));
  Checkpoint checkpoint;
  checkpoint.file = file;
  checkpoint.time = in.real_attribute("time");
  checkpoint.dt = in.real_attribute("dt");
  checkpoint.step = in.integer_attribute("step");
  checkpoint.scene = in.read_text("/scene");
  for (const std::string& name : in.names("/scalars"))
    checkpoint.scalars[name] = in.read_doubles("/scalars/" + name).at(0);
  for (const std::string& name : in.names("/columns")) checkpoint.columns[name] = in.read_doubles("/columns/" + name);
  for (const std::string& name : in.names("/labels")) checkpoint.labels[name] = in.read_integers("/labels/" + name);

  std::map<std::string, std::size_t> lengths;
  const auto check = [&](const std::string& name, std::size_t size) {
    const std::size_t length = lengths.try_emplace(prefix_of(name), size).first->second;
    if (length != size)
      throw InputError(
          fmt::format("{}: \"{}\" holds {} values where other columns hold {}", file.string(), name, size, length));
  };
  for (const auto& [name, values] : checkpoint.columns) check(name, values.size());
  for (const auto& [name, values] : checkpoint.labels) check(name, values.size());
  return checkpoint;
}

}  // namespace ejecta
