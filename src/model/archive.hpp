#pragma once
/// What persists: one list, gone through to write a checkpoint and again to read it.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "model/clock.hpp"
#include "model/conserved.hpp"

namespace ejecta {

/// Writes what it is shown, or fills it in. Names are unique within a package.
class Archive {
 public:
  virtual ~Archive() = default;

  /// Whether what it is shown is filled in.
  virtual bool reads() const = 0;
  /// Whether a number or column is there; false only of checkpoints written before it was.
  virtual bool has(const std::string& name) const = 0;
  /// Number of elements of all columns and labels that follow: the one given, or the one that was saved.
  virtual std::size_t size(std::size_t present) = 0;
  virtual void number(const std::string& name, double& value) = 0;
  /// `unit`: SI symbol, "1" if dimensionless.
  virtual void column(const std::string& name, std::string_view unit, std::span<double> values) = 0;
  virtual void labels(const std::string& name, std::span<std::int32_t> values) = 0;

  void integer(const std::string& name, std::int64_t& value) {  // exact up to 2^53
    double number_of = static_cast<double>(value);
    number(name, number_of);
    value = static_cast<std::int64_t>(number_of);
  }
};

/// What every package has.
void persist(Archive& archive, Clock& clock, Totals& initial, ExternalLoad& external);

}  // namespace ejecta
