#pragma once
/// Which scripts draw a run, what they are told, and whether they can be run at all.
#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "model/channel.hpp"
#include "render/field_style.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// Everything a pipeline may want to know, fixed for a run so that frames do not flicker.
struct PipelineSettings {
  std::vector<std::string> channels;  ///< that the run has: by these names scripts register the sources that read them
  std::string run_folder;             ///< images go to <run_folder>/images
  std::string scene_title;
  int dimension = 3;
  int image_width = 1920, image_height = 1080;  ///< pixels, for every view
  std::array<double, 3> view_center{};          ///< m
  double view_width = 1, view_height = 1;       ///< m, that are visible at least
  double time_end = 0;                          ///< s, chooses the unit of the time stamp
  double particle_radius = 0;                   ///< m, of a drawn sphere where there is no smoothing length
  double radius_per_smoothing_length = 0.45;    ///< of a drawn sphere
  double nodes_per_h = 1.3;                     ///< node spacings per smoothing length
  double kernel_support = 2;                    ///< of the kernel, in smoothing lengths
  std::string fragment_target = "target";       ///< body that fragments are counted of
  struct DrawnBody {
    std::string name;
    bool breaks = false;  ///< its material knows damage
  };
  std::vector<DrawnBody> bodies;             ///< in the order of the scene
  std::vector<std::string> slice_fields;     ///< panels of a slice, in this order
  std::map<std::string, FieldStyle> styles;  ///< field -> how it is shown; others have a plain_style
};

/// Absolute paths of the scripts drawn by default: slice, of particles also cutaway and, where fragments are followed,
/// fragments.
std::vector<std::string> default_pipelines(const Scene& scene);

/// The pipelines of a scene: insitu.pipelines, with "default" replaced by the default ones, which are also what an
/// empty list means.
std::vector<Pipeline> pipelines_of(const Scene& scene);

/// Scripts without arguments that are run with the frames.
std::vector<Pipeline> plain_pipelines(const std::vector<std::string>& scripts);

/// Compiles each script without running it. Throws InputError naming file and line of every script that is missing or
/// has a syntax error.
void check_pipeline_scripts(const std::vector<Pipeline>& pipelines);

/// The settings, and unit and style of all fields of the channels, as one JSON text, which the scripts read. A style is
/// a label, a range [SI] or null, the name of the colour map, and the value beyond which it follows the logarithm, or
/// 0.
std::string frame_json(const PipelineSettings& settings, std::span<const Channel> channels);

}  // namespace ejecta
