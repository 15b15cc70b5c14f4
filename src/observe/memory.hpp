#pragma once
/// Memory of this process, with all libraries in it.

namespace ejecta {

double memory_now();   ///< bytes
double memory_peak();  ///< bytes, the most so far

}  // namespace ejecta
