#pragma once
/// Files about fragments and pore compaction: tables for people, data for the figures.
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "analysis/fragment_theory.hpp"
#include "analysis/fragments.hpp"
#include "output/csv.hpp"

namespace ejecta {

/// What the tables are told about the run.
struct FragmentContext {
  int dimension = 3;
  std::vector<std::string> bodies, materials;  ///< names by label
  std::vector<double> body_mass;               ///< kg (kg/m in plane strain), by label
  std::size_t target = 0;                      ///< label of the body that mass fractions refer to
  double smallest = 0;                         ///< lightest fragment of the target that is counted [kg, kg/m]
  double density = 0;                          ///< of the target's material at rest [kg/m^3]

  /// Share of one body's mass that a mass [kg] of its matter is.
  double share(double mass, std::size_t body) const { return mass / body_mass[body]; }
  double share(double mass) const { return share(mass, target); }
  /// What mass fractions are measured in: the bracket behind their names.
  std::string unit() const { return "mass of " + bodies[target]; }
};

/// Outcome for one body; fractions count its own matter over its own mass, wherever it is.
struct BodyFragments {
  std::string body;
  double mass = 0;                                           ///< kg (kg/m in plane strain)
  std::int64_t fragments = 0;                                ///< with matter of it
  double largest_mass_fraction = 0, dust_mass_fraction = 0;  ///< 1
};
std::vector<BodyFragments> fragments_by_body(const FragmentTable& table, const FragmentContext& context);

/// fragments.csv: one row a fragment, those with most of the target's matter first, then a row with number 0 for the
/// dust, which is everything else (mass and velocity only). "mass fraction" counts matter of the target only.
/// Throws OutputError if it cannot be written; so do the functions below.
void write_fragments(const std::filesystem::path& file, const FragmentTable& table, const FragmentContext& context);

/// fragment_theory.csv: mass m, m / mass of the target, and for each prediction the fewest and the most fragments of at
/// least m that it expects.
void write_fragment_theory(const std::filesystem::path& file, std::span<const FragmentPrediction> predictions,
                           const FragmentContext& context);

/// fragment_distribution.csv: mass m of the target's matter in a fragment, m / mass of the target, number of fragments
/// that hold at least as much; heaviest first. Fragments of other bodies are left out.
void write_fragment_distribution(const std::filesystem::path& file, const FragmentTable& table,
                                 const FragmentContext& context);

/// The same of measured masses [kg].
void write_measured_fragments(const std::filesystem::path& file, std::vector<double> masses);

/// largest_fragment.csv, one row a call: time, largest fragment of the target, fragments of all bodies, dust of the
/// target; both masses over that of the target.
class LargestFragmentHistory {
 public:
  LargestFragmentHistory(std::filesystem::path file, FragmentContext context, std::optional<double> resume_at = {});
  void write(double time, const FragmentTable& table);

 private:
  FragmentContext context_;
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
