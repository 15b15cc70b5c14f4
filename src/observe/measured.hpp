#pragma once
/// Measured traces and lists that figures show beside what is computed: CSV files whose header says name and SI unit.
#include <filesystem>
#include <vector>

#include "output/csv.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// Masses of a measured list of fragments [kg]. Throws InputError if the file has no column "mass [kg]", or a cell of
/// it is no number.
std::vector<double> measured_masses(const std::string& file);

/// Throws InputError unless the file has a column "time [s]" and one of these, with its unit.
void check_measured_trace(const std::string& file, const std::vector<CsvColumn>& columns);

/// What is computed less what was measured, of one column.
struct Misfit {
  CsvColumn column;
  double rms = 0, mean = 0;  ///< SI
  std::size_t points = 0;    ///< of the measured trace, as far as the computed one reaches
};

/// Of every column that the table of a probe and a measured trace have in common, the computed values interpolated to the
/// times of the trace plus `delay` [s]. Throws InputError if one of the files cannot be read.
std::vector<Misfit> compare_traces(const std::filesystem::path& computed, const std::filesystem::path& measured,
                                   double delay);

}  // namespace ejecta
