#pragma once
/// Images read back, and what can be asked of them.
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "insitu/catalyst_bridge.hpp"
#include "render/colour_map.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// A scene of particles that follows fragments, or not.
inline Scene scene_with(bool fragments) {
  Scene scene;
  scene.fragments.enabled = fragments;
  return scene;
}

struct Picture {
  int width = 0, height = 0;
  std::vector<std::array<unsigned char, 3>> pixels;  ///< row by row, from the bottom

  explicit Picture(const std::string& path) {
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    vtkImageData* image = reader->GetOutput();
    width = image->GetDimensions()[0];
    height = image->GetDimensions()[1];
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const auto* p = static_cast<const unsigned char*>(image->GetScalarPointer(x, y, 0));
        pixels.push_back({p[0], p[1], p[2]});
      }
  }

  const std::array<unsigned char, 3>& at(int x, int y) const { return pixels[static_cast<std::size_t>(y * width + x)]; }

  /// Number of different colours, counted with 4 bits a channel.
  std::size_t colours() const {
    std::set<int> seen;
    for (const auto& p : pixels) seen.insert((p[0] >> 4) << 8 | (p[1] >> 4) << 4 | (p[2] >> 4));
    return seen.size();
  }
  /// Share of the picture that is coloured, neither grey nor white.
  double coloured_share() const {
    std::size_t count = 0;
    for (const auto& [r, g, b] : pixels) count += std::max({r, g, b}) - std::min({r, g, b}) > 40;
    return static_cast<double>(count) / static_cast<double>(pixels.size());
  }
  /// Number of pixels of a colour, but for rounding.
  std::ptrdiff_t count(Colour colour) const {
    const std::array wanted{255 * colour.red, 255 * colour.green, 255 * colour.blue};
    return std::ranges::count_if(pixels, [&](const auto& p) {
      for (std::size_t c = 0; c < 3; ++c)
        if (std::abs(p[c] - wanted[c]) > 1.5) return false;
      return true;
    });
  }
  /// The lower corners are paper, and the edges of the band above have its colour: no matter gets there.
  bool band_and_margins_are_clean() const {
    const std::array<unsigned char, 3> white{255, 255, 255}, band = at(0, height - 1);
    bool clean = at(0, 0) == white && at(width - 1, 0) == white && band != white;
    for (int x = 0; x < width; ++x) clean = clean && at(x, height - 1) == band;
    return clean;
  }
};

/// All pipelines, because a frame is due.
inline std::vector<PipelineCall> every_frame(const CatalystBridge& bridge) {
  std::vector<PipelineCall> calls;
  for (std::size_t k = 0; k < bridge.size(); ++k) calls.push_back({k, "frame"});
  return calls;
}

/// A new empty folder for a test, below the working directory.
inline std::string fresh_folder(const std::string& name) {
  const auto folder = std::filesystem::current_path() / "insitu_test_output" / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder.string();
}

}  // namespace ejecta
