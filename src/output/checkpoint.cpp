#include "output/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>

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
  move_into_place(file);
}

fs::path write_rotating_checkpoint(const fs::path& folder, const CheckpointView& view) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  const fs::path file = folder / fmt::format("checkpoint_{:012d}.h5", view.step);
  write_checkpoint(file, view);
  constexpr std::size_t kept = 2;
  const std::vector<fs::path> files = checkpoints_in(folder);
  for (std::size_t k = 0; k + kept < files.size(); ++k) fs::remove(files[k], failure);
  return file;
}

std::optional<fs::path> latest_checkpoint(const fs::path& folder) {
  const std::vector<fs::path> files = checkpoints_in(folder);
  return files.empty() ? std::nullopt : std::optional(files.back());
}

Checkpoint read_checkpoint(const fs::path& file) {
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
