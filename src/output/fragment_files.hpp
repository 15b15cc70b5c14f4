#pragma once
/// Files about fragments and pore compaction: tables for people, data for the figures.
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "output/csv.hpp"
#include "simulation/fragments.hpp"

namespace ejecta {

/// What the tables are told about the run.
struct FragmentContext {
  int dimension = 3;
  double target_mass = 0;                      ///< kg (kg/m in plane strain); mass fractions refer to it
  std::vector<std::string> bodies, materials;  ///< names by label
};

/// fragments.csv: one row a fragment, heaviest first, then a row with number 0 for the dust (mass and velocity only).
/// Throws InputError if it cannot be written; so do the functions below.
void write_fragments(const std::filesystem::path& file, const FragmentTable& table, const FragmentContext& context);

/// fragment_distribution.csv: mass m, m / target mass, number of fragments at least as heavy as m; heaviest first.
void write_fragment_distribution(const std::filesystem::path& file, const FragmentTable& table,
                                 const FragmentContext& context);

/// largest_fragment.csv, one row a call: time, mass fraction of the largest fragment, fragments, dust fraction.
class LargestFragmentHistory {
 public:
  LargestFragmentHistory(std::filesystem::path file, std::optional<double> resume_at = {});
  void write(double time, const FragmentTable& table, const FragmentContext& context);

 private:
  CsvWriter writer_;
};

/// Particles for the compaction plot, spans of equal length: pressure [Pa], distension [1], and whether the particle is
/// on the crush curve at this moment (not 0) or holds its distension.
void write_compaction(const std::filesystem::path& file, std::span<const double> pressure,
                      std::span<const double> distension, std::span<const std::int32_t> loading);
/// The curve to compare with: pressure [Pa], distension [1], in the order to be drawn.
void write_crush_curve(const std::filesystem::path& file, std::span<const double> pressure,
                       std::span<const double> distension);

}  // namespace ejecta
