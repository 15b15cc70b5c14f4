#pragma once
/// Numbers that describe a run as a whole. History, monitor and summary take them from one list.
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace ejecta {

struct Quantity {
  std::string name, unit;  ///< as in history.csv: "max pressure", "Pa"; empty unit: a word
  std::variant<double, std::int64_t, std::string> value;  ///< SI
  std::string doc;
  bool plotted = false;  ///< on the monitor page
};
/// Always the same names in the same order during a run: the columns of history.csv.
using Quantities = std::vector<Quantity>;

}  // namespace ejecta
