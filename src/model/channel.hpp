#pragma once
/// The seam to the outside: named, unit-carrying views of live fields. No VTK on this side, no solver type beyond it.
/// Views are valid only during the call they are handed to.
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace ejecta {

/// One field, one span per component (columns are stored component by component, so handing them over copies nothing).
struct FieldView {
  std::string name;
  std::string unit;                                 ///< SI symbol, "1" if dimensionless
  std::vector<std::span<const double>> components;  ///< 1, 2, 3, ... spans of equal length
};
/// A field that owns its columns.
struct OwnedField {
  std::string name, unit;
  std::vector<std::vector<double>> components;

  FieldView view() const { return {name, unit, {components.begin(), components.end()}}; }
};
struct IndexView {
  std::string name;
  std::span<const std::int32_t> values;
};

enum class ChannelKind { points, image };

struct Channel {
  std::string name;  ///< particles | slice | ellipsoids | volume | fragments
  ChannelKind kind = ChannelKind::points;
  std::size_t count = 0;                            ///< points, or pixels of the image
  std::array<std::span<const double>, 3> position;  ///< points: x, y, z [m] (z: zeros in 2D)
  std::array<int, 3> extent{1, 1, 1};               ///< image: pixels along x, y, z
  std::array<double, 3> origin{0, 0, 0};            ///< image: centre of the first pixel [m]
  std::array<double, 3> spacing{1, 1, 1};           ///< image: pixel size [m]
  std::vector<FieldView> fields;
  std::vector<IndexView> indices;  ///< integer labels (id, body, fragment)
};

}  // namespace ejecta
