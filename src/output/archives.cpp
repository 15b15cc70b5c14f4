#include "output/archives.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"

namespace ejecta {

namespace {

std::string prefix_of(const Package& package) {
  return package.name() == "particles" ? "" : std::string(package.name()) + ".";
}

class Writer final : public Archive {
 public:
  Writer(CheckpointView& view, std::string prefix) : view_(view), prefix_(std::move(prefix)) {}

  bool reads() const override { return false; }
  bool has(const std::string&) const override { return true; }
  std::size_t size(std::size_t present) override { return present; }
  void number(const std::string& name, double& value) override { view_.scalars[prefix_ + name] = value; }
  void column(const std::string& name, std::string_view unit, std::span<double> values) override {
    view_.columns.push_back({prefix_ + name, std::string(unit), values});
  }
  void labels(const std::string& name, std::span<std::int32_t> values) override {
    view_.labels.push_back({prefix_ + name, "1", values});
  }

 private:
  CheckpointView& view_;
  std::string prefix_;
};

class Reader final : public Archive {
 public:
  Reader(const Checkpoint& checkpoint, std::string prefix) : checkpoint_(checkpoint), prefix_(std::move(prefix)) {}

  bool reads() const override { return true; }
  bool has(const std::string& name) const override {
    return checkpoint_.scalars.contains(prefix_ + name) || checkpoint_.columns.contains(prefix_ + name);
  }
  std::size_t size(std::size_t) override { return checkpoint_.size(prefix_); }
  void number(const std::string& name, double& value) override { value = checkpoint_.scalar(prefix_ + name); }
  void column(const std::string& name, std::string_view, std::span<double> values) override {
    fill(name, checkpoint_.column(prefix_ + name), values);
  }
  void labels(const std::string& name, std::span<std::int32_t> values) override {
    fill(name, checkpoint_.label(prefix_ + name), values);
  }

 private:
  template <class T>
  void fill(const std::string& name, const std::vector<T>& saved, std::span<T> values) const {
    if (saved.size() != values.size())
      throw InputError(fmt::format("{}: \"{}{}\": expected {} values, got {}: it belongs to another scene",
                                   checkpoint_.file.string(), prefix_, name, values.size(), saved.size()));
    std::ranges::copy(saved, values.begin());
  }

  const Checkpoint& checkpoint_;
  std::string prefix_;
};

/// The particles of a hybrid had the name of all particles until November 2026.
std::string prefix_in(const Checkpoint& checkpoint, const Package& package) {
  const std::string prefix = prefix_of(package);
  return package.name() == "gas" && !checkpoint.columns.contains(prefix + "mass") ? "" : prefix;
}

void go_through(Archive& archive, Package& package) {
  persist(archive, package.clock, package.initial, package.external);
  package.persist(archive);
}

}  // namespace

void save(Package& package, CheckpointView& view) {
  for (Package* part : package.parts()) save(*part, view);
  Writer writer(view, prefix_of(package));
  go_through(writer, package);
}

void load(Package& package, const Checkpoint& checkpoint) {
  for (Package* part : package.parts()) load(*part, checkpoint);
  package.clock = {checkpoint.time, checkpoint.dt, checkpoint.step};  // of checkpoints that hold no clock of a package
  Reader reader(checkpoint, prefix_in(checkpoint, package));
  go_through(reader, package);
}

}  // namespace ejecta
