#include "output/summary.hpp"

#include <fmt/format.h>

#include "base/json.hpp"
#include "output/atomic_file.hpp"

namespace ejecta {

namespace {

std::string bodies_json(const std::vector<BodySummary>& bodies) {
  std::string text;
  for (const BodySummary& b : bodies) {
    text += fmt::format("{}    {}: {{\"mass\": {}, \"fragments\": {}, \"largest_fragment_mass_fraction\": {}, ",
                        text.empty() ? "\n" : ",\n", to_json(b.name), to_json(b.mass), to_json(b.fragments),
                        to_json(b.largest_fragment_mass_fraction));
    text += fmt::format("\"dust_mass_fraction\": {}, \"pressure_peak_max\": {}, \"pressure_peak_median\": {}}}",
                        to_json(b.dust_mass_fraction), to_json(b.pressure_peak_max), to_json(b.pressure_peak_median));
  }
  return text.empty() ? "{}" : "{" + text + "\n  }";
}

std::string pipelines_json(const std::vector<PipelineSummary>& pipelines) {
  std::string text;
  for (const PipelineSummary& p : pipelines)
    text += fmt::format("{}    {}: {{\"frames\": {}, \"failures\": {}}}", text.empty() ? "\n" : ",\n", to_json(p.name),
                        p.frames, p.failures);
  return text.empty() ? "{}" : "{" + text + "\n  }";
}

std::string quantities_json(const Quantities& quantities) {
  std::string text;
  for (const Quantity& q : quantities)
    text += fmt::format("{}    {}: {}", text.empty() ? "\n" : ",\n",
                        to_json(q.unit.empty() ? q.name : fmt::format("{} [{}]", q.name, q.unit)),
                        std::visit([](const auto& value) { return to_json(value); }, q.value));
  return text.empty() ? "{}" : "{" + text + "\n  }";
}

}  // namespace

std::string summary_json(const Summary& s) {
  std::string text;
  const auto add_text = [&](const char* key, const std::string& json) {
    text += fmt::format("{}  \"{}\": {}", text.empty() ? "{\n" : ",\n", key, json);
  };
  const auto add = [&](const char* key, const auto& value) { add_text(key, to_json(value)); };
  add("scene", s.scene);
  add("dimension", s.dimension);
  add("scheme", s.scheme);
  add("precision", s.precision);
  add("threads", s.threads);
  add("particles", s.particles);
  add("cells", s.cells);
  add("steps", s.steps);
  add("element_steps", s.element_steps);
  add("time_s", s.time_s);
  add("wall_s", s.wall_s);
  add("particle_steps_per_s", s.particle_steps_per_s);
  add("cell_steps_per_s", s.cell_steps_per_s);
  add("pair_interactions_per_s", s.pair_interactions_per_s);
  add("neighbours_mean", s.neighbours_mean);
  add("bytes_per_particle", s.bytes_per_particle);
  add("peak_rss_mb", s.peak_rss_mb);
  add("mass_error_rel", s.mass_error_rel);
  add("momentum_error_rel", s.momentum_error_rel);
  add("angular_momentum_error_rel", s.angular_momentum_error_rel);
  add("energy_error_rel", s.energy_error_rel);
  add("shape_votes", s.shape_votes);
  add("shape_few_neighbours", s.shape_few_neighbours);
  add("shape_limited_change", s.shape_limited_change);
  add("shape_largest_aspect", s.shape_largest_aspect);
  add("images", s.images);
  add("extracts", s.extracts);
  add("frames", s.frames);
  add("frames_left_out", s.frames_left_out);
  add_text("pipelines", pipelines_json(s.pipelines));
  add("insitu_share", s.insitu_share);
  add("insitu_bytes_written", s.insitu_bytes_written);
  add("full_dump_bytes_avoided", s.full_dump_bytes_avoided);
  add("fragment_target", s.fragment_target);
  add("largest_fragment_mass_fraction", s.largest_fragment_mass_fraction);
  add("fragments", s.fragments);
  add_text("bodies", bodies_json(s.bodies));
  add_text("quantities", quantities_json(s.quantities));
  add("state", s.state);
  add("reason", s.reason);
  add_text("not_written", json_list(s.not_written));
  add("exit", s.exit);
  return text + "\n}\n";
}

void write_summary(const std::filesystem::path& file, const Summary& summary) {
  write_atomically(file, summary_json(summary));
}

}  // namespace ejecta
