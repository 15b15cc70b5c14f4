#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <optional>

#include "analysis/fragments.hpp"
#include "app/log.hpp"
#include "app/options.hpp"
#include "app/saved_states.hpp"
#include "base/errors.hpp"
#include "insitu/vtk_files.hpp"
#include "observe/channels.hpp"
#include "observe/columns.hpp"
#include "observe/solvers.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;

/// Calls write(channel) for the particles, with the numbers of their fragments, and for what other packages show.
template <class Write>
void for_each_channel(const Simulation& sim, Write&& write) {
  with_particles(sim, [&]<int Dim>(const Sph<Dim>& sph) {
    std::optional<FragmentTable> fragments;
    if (sim.scene.fragments.enabled) fragments = FragmentTracker().update(fragment_input(sph), sim.scene.fragments);
    FrameChannels<Dim> channels;
    write(channels.particles(sph.particles, fragments));
  });
  for (const auto& package : sim.packages)
    for (const Channel& channel : package->channels([](const char*) { return true; })) write(channel);
}

}  // namespace

int export_command(const ExportOptions& options) {
  const fs::path run = options.folder, out = options.out.empty() ? run / "export" : fs::path(options.out);
  const VtkFormat format = options.format == "xdmf" ? VtkFormat::xdmf : VtkFormat::xml;
  const std::vector<SavedState> states = saved_states(run, options.states);
  SavedRun saved(states.front(), {"insitu.enabled=false", "insitu.pipelines=[]"});
  std::error_code failure;
  fs::create_directories(out, failure);
  if (failure) throw OutputError(out, failure.message());
  std::map<std::string, std::vector<TimedFile>> series;  // channel -> files
  for (const SavedState& state : states) {
    if (&state != &states.front()) saved.go_to(state);
    for_each_channel(saved.simulation(), [&](const Channel& channel) {
      spdlog::info("{} at t = {}", channel.name, format_quantity(state.time, "s"));
      const fs::path file = write_vtk(out / fmt::format("{}_{:06d}", channel.name, state.step), channel, format);
      series[channel.name].push_back({file, state.time});
    });
  }
  if (series.empty()) throw InputError(run.string() + ": nothing to export: no solver of this run shows its state");
  for (const auto& [channel, files] : series)
    spdlog::info("{} shows {} in time", write_collection(out / channel, files, format).string(), channel);
  return exit_code::done;
}

}  // namespace ejecta
