#pragma once
/// Measured traces and lists that figures show beside what is computed: CSV files whose header says name and SI unit.
#include <vector>

#include "output/csv.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// Masses of a measured list of fragments [kg]. Throws InputError if the file has no column "mass [kg]", or a cell of
/// it is no number.
std::vector<double> measured_masses(const std::string& file);

/// Throws InputError unless the file has a column "time [s]" and one of these, with its unit.
void check_measured_trace(const std::string& file, const std::vector<CsvColumn>& columns);

}  // namespace ejecta
