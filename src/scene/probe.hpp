#pragma once
/// [[probes]]: where a run is listened to.
#include <string>

#include "scene/choices.hpp"

namespace ejecta {

enum class ProbeKind {
  point,       ///< fixed in space: the matter that comes by
  tracer,      ///< rides on the matter that was there at the start
  surface,     ///< rides on the matter that a beam meets first at the start
  velocimeter  ///< a beam: the first surface that it meets
};

struct Probe {
  std::string name;
  ProbeKind kind = ProbeKind::point;
  Triple at{unset, unset, unset};  ///< m; of a beam: where it begins
  std::string body;                ///< it reads that one alone; empty: whatever is there
  Triple direction{0, 0, 0};       ///< of the beam; of strain and velocity of the others; zero: none
  double spot = unset;             ///< m; radius of the beam; default: resolution.spacing
  double range = unset;            ///< m; how far the beam sees; default: without end
  double window = 0;               ///< s; values are means over so long before a row
  double interval = unset;         ///< s between rows; default: that of history.csv
  std::string measured;            ///< CSV file of a measured trace, for the figure; absolute once read
  double measured_delay = 0;       ///< s; what is added to its times

  std::string origin;  ///< where the scene says so: "inputs/x.toml:14"

  bool beam() const { return kind == ProbeKind::velocimeter || kind == ProbeKind::surface; }
  bool rides() const { return kind == ProbeKind::tracer || kind == ProbeKind::surface; }
  bool directed() const { return direction != Triple{0, 0, 0}; }
};

}  // namespace ejecta
