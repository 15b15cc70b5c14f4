#pragma once
/// summary.json: the machine-readable end result of a run. The keys are the member names and never change.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/quantity.hpp"

namespace ejecta {

/// What became of one body: its own matter over its own mass, wherever that matter is now.
struct BodySummary {
  std::string name;
  double mass = 0;  ///< kg (kg/m in plane strain)
  std::optional<std::int64_t> fragments;
  std::optional<double> largest_fragment_mass_fraction, dust_mass_fraction;
  std::optional<double> pressure_peak_max,
      pressure_peak_median;  ///< Pa; half of its mass has seen more than the median
};

/// How often a Catalyst script was run, and how often it failed.
struct PipelineSummary {
  std::string name;
  std::int64_t frames = 0, failures = 0;
};

/// Values that do not apply stay empty and are written as null, like numbers that are not finite.
struct Summary {
  std::string scene;
  int dimension = 3;
  std::string scheme, precision;
  int threads = 1;
  std::int64_t particles = 0;
  std::optional<std::int64_t> cells;  ///< of a grid
  std::int64_t steps = 0;
  double element_steps = 0;  ///< of single particles and cells, all added
  double time_s = 0, wall_s = 0;
  std::optional<double> particle_steps_per_s, cell_steps_per_s, pair_interactions_per_s, neighbours_mean;
  std::optional<double> bytes_per_particle, peak_rss_mb;
  std::optional<double> mass_error_rel, energy_error_rel;
  std::optional<double> momentum_error_rel;          ///< not with reflecting faces, which take momentum away
  std::optional<double> angular_momentum_error_rel;  ///< not with faces of either kind
  /// ASPH: particles times votes on the shape of H, and in how many of them a limit acted.
  std::optional<std::int64_t> shape_votes, shape_few_neighbours, shape_limited_change, shape_largest_aspect;
  std::optional<std::int64_t> images, extracts;         ///< pictures, and other files of pipelines
  std::optional<std::int64_t> frames, frames_left_out;  ///< drawn, and passed over to hold insitu.max_share
  std::vector<PipelineSummary> pipelines;               ///< an object by name
  std::optional<double> insitu_share;
  std::optional<std::int64_t> insitu_bytes_written, full_dump_bytes_avoided;
  std::optional<std::string> fragment_target;            ///< the body struck, or named by fragments.target
  std::optional<double> largest_fragment_mass_fraction;  ///< of the target, over its mass
  std::optional<std::int64_t> fragments;                 ///< of all bodies
  std::vector<BodySummary> bodies;                       ///< an object by name
  Quantities quantities;                                 ///< the last row of history.csv, an object by name and unit
  std::string state = "finished";                        ///< finished, stopped or failed
  std::optional<std::string> reason;                     ///< why it is not finished
  std::vector<std::string> not_written;                  ///< a sentence for each kind of file that is not all there
  int exit = 0;                                          ///< exit code of the run: 0 done, 3 failed, 4 stopped
};

/// One JSON object, one key a line, in the order of the members.
std::string summary_json(const Summary& summary);

/// Replaces the file atomically. Throws OutputError if it cannot be written.
void write_summary(const std::filesystem::path& file, const Summary& summary);

}  // namespace ejecta
