#include "insitu/pipelines.hpp"

#include <vtkCPPythonPipeline.h>
#include <vtkPythonInterpreter.h>

#include <filesystem>
#include <sstream>

#include "base/data_folder.hpp"
#include "base/errors.hpp"
#include "base/json.hpp"
#include "base/si_prefixes.hpp"
#include "insitu/insitu_log.hpp"
#include "insitu/paint_module.hpp"

namespace ejecta {
namespace {

std::map<std::string, std::string> units_of(std::span<const Channel> channels) {
  std::map<std::string, std::string> units;
  for (const Channel& channel : channels)
    for (const FieldView& field : channel.fields) units[field.name] = field.unit;
  return units;
}

std::string field_json(const std::string& unit, const FieldStyle& style) {
  return "{\"unit\":" + to_json(unit) + ",\"label\":" + to_json(style.label) +
         ",\"range\":" + (style.range ? json_list(std::array{style.range->min, style.range->max}) : "null") +
         ",\"map\":" + to_json(name_of(style.map)) + ",\"linear_to\":" + to_json(style.linear_to) + '}';
}

/// The message of the compiler for `path`, as file:line: text; empty if it compiles.
std::string syntax_problem(const std::string& path) {
  LogRedirection redirection("");
  offer_paint_module();
  vtkPythonInterpreter::Initialize(0);
  const std::string name = to_json(path);
  const std::string check =
      "try:\n"
      "    with open(" +
      name + ", 'rb') as source: compile(source.read(), " + name +
      ", 'exec', dont_inherit=True)\n"
      "except SyntaxError as error: print(f'{error.filename}:{error.lineno}: {error.msg}')\n"
      "except Exception as error: print(" +
      name + " + f': {error}')\n";
  vtkPythonInterpreter::RunSimpleString(check.c_str());
  std::string problem = redirection.log().text();
  while (!problem.empty() && problem.back() == '\n') problem.pop_back();
  return problem;
}

}  // namespace

std::vector<std::string> default_pipelines(const Scene& scene) {
  const std::filesystem::path folder = data_folder() / "catalyst_scripts";
  std::vector<std::string> scripts{folder / "slice.py"};
  if (!scene.numerics.on_grid()) scripts.push_back(folder / "cutaway.py");
  if (!scene.numerics.on_grid() && scene.dimension == 3) scripts.push_back(folder / "surface.py");
  if (scene.fragments.enabled) scripts.push_back(folder / "fragments.py");
  return scripts;
}

std::vector<Pipeline> plain_pipelines(const std::vector<std::string>& scripts) {
  std::vector<Pipeline> pipelines;
  for (const std::string& script : scripts) pipelines.push_back({script, {}, ""});
  return pipelines;
}

std::vector<Pipeline> pipelines_of(const Scene& scene) {
  if (scene.insitu.pipelines.empty()) return plain_pipelines(default_pipelines(scene));
  std::vector<Pipeline> pipelines;
  for (const Pipeline& pipeline : scene.insitu.pipelines) {
    if (pipeline.script != default_pipelines_name) {
      pipelines.push_back(pipeline);
      continue;
    }
    for (const std::string& script : default_pipelines(scene))
      pipelines.push_back({script, pipeline.args, pipeline.every});
  }
  return pipelines;
}

void check_pipeline_scripts(const std::vector<Pipeline>& pipelines) {
  std::vector<std::string> problems;
  for (const Pipeline& pipeline : pipelines) {
    const std::string& path = pipeline.script;
    if (!std::filesystem::is_regular_file(path)) {
      problems.push_back(path + ": expected a Catalyst script, found no such file");
    } else if (std::string problem = syntax_problem(path); !problem.empty()) {
      problems.push_back(std::move(problem));
    } else if (vtkCPPythonPipeline::DetectScriptVersion(path.c_str()) != 2) {
      problems.push_back(path + ":1: expected the line `# script-version: 2.0` of a Catalyst script");
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

std::string frame_json(const PipelineSettings& s, std::span<const Channel> channels) {
  std::ostringstream out;
  out << "{\"run_folder\":" << to_json(s.run_folder) << ",\"scene_title\":" << to_json(s.scene_title)
      << ",\"dimension\":" << s.dimension << ",\"image_size\":[" << s.image_width << ',' << s.image_height << ']'
      << ",\"view_center\":[" << to_json(s.view_center[0]) << ',' << to_json(s.view_center[1]) << ','
      << to_json(s.view_center[2]) << "],\"view_width\":" << to_json(s.view_width)
      << ",\"view_height\":" << to_json(s.view_height) << ",\"time_end\":" << to_json(s.time_end)
      << ",\"particle_radius\":" << to_json(s.particle_radius)
      << ",\"radius_per_smoothing_length\":" << to_json(s.radius_per_smoothing_length)
      << ",\"nodes_per_h\":" << to_json(s.nodes_per_h) << ",\"kernel_support\":" << to_json(s.kernel_support)
      << ",\"fragment_target\":" << to_json(s.fragment_target) << ",\"prefixes\":" << json_list(si_prefixes)
      << ",\"channels\":" << json_list(s.channels) << ",\"slice_fields\":" << json_list(s.slice_fields)
      << ",\"bodies\":[";
  const char* between = "";
  for (const PipelineSettings::DrawnBody& body : s.bodies) {
    out << between << "{\"name\":" << to_json(body.name) << ",\"breaks\":" << (body.breaks ? "true" : "false") << '}';
    between = ",";
  }
  out << "],\"fields\":{";
  const char* separator = "";
  for (const auto& [name, unit] : units_of(channels)) {
    const auto style = s.styles.find(name);
    out << separator << to_json(name) << ':'
        << field_json(unit, style == s.styles.end() ? plain_style(name) : style->second);
    separator = ",";
  }
  out << "}}";
  return out.str();
}

}  // namespace ejecta
