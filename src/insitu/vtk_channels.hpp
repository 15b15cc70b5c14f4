#pragma once
/// Channels as VTK data sets. The columns are wrapped, not copied: a data set is valid as long as the channel it came
/// from.
#include <vtkDataSet.h>
#include <vtkSmartPointer.h>

#include <map>
#include <string>
#include <vector>

#include "model/channel.hpp"

class vtkCellArray;

namespace ejecta {

/// Keeps what can be kept from frame to frame: the vertex cells of a channel, needed so that filters and plain points
/// see the particles, depend on the number of points only.
class VtkChannels {
 public:
  /// Points become a vtkPolyData with one vertex a point, an image a vtkImageData with point-centred fields (so that a
  /// pixel's value belongs to its centre). Vectors of two components get a third one, zero.
  vtkSmartPointer<vtkDataSet> wrap(const Channel& channel);

 private:
  std::map<std::string, vtkSmartPointer<vtkCellArray>> vertices_;  ///< by channel name
  std::map<std::string, std::vector<double>> zeros_;               ///< by channel name
};

}  // namespace ejecta
