#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <new>
#include <sstream>
#include <system_error>

#include "app/log.hpp"
#include "app/options.hpp"
#include "base/errors.hpp"
#include "insitu/gl_probe.hpp"
#include "material/material_reader.hpp"
#include "model/package_kind.hpp"
#include "scene/scene_reader.hpp"
#include "scene/units.hpp"

namespace {

void print_problems(const ejecta::InputError& error) {
  for (const std::string& problem : error.problems()) fmt::print(stderr, "ejecta: {}\n", problem);
}

/// The OpenMP runtime reads its settings before main() begins, and by default lets waiting threads spin for so long
/// that a run slows down several times when it shares its cores with others. Start again with a short spin instead.
void limit_spinning(char** argv) {
  if (std::getenv("GOMP_SPINCOUNT") || std::getenv("OMP_WAIT_POLICY")) return;
  setenv("GOMP_SPINCOUNT", "20000", 1);
  execv("/proc/self/exe", argv);
}

/// Commands of the script in the source tree, which names them in EJECTA_LAUNCHER: lines that begin with two spaces,
/// the command and what it does.
std::string launcher_help() {
  const char* lines = std::getenv("EJECTA_LAUNCHER");
  return lines ? fmt::format("\n\nIn the source tree also:\n{}", lines) : "";
}

/// What to say if the first word is no command; empty if it is one.
std::string mistyped(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return "";
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    commands.push_back(command->get_name());
  std::istringstream lines(launcher_help());
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  ")) commands.push_back(line.substr(2, line.find(' ', 2) - 2));
  if (std::ranges::find(commands, argv[1]) != commands.end()) return "";
  const std::string near = ejecta::nearest_word(argv[1], commands);
  return fmt::format("expected a command, got \"{}\"{}", argv[1],
                     near.empty() ? "; --help lists them" : ", did you mean " + near + "?");
}

}  // namespace

int main(int argc, char** argv) {
  using namespace ejecta;
  limit_spinning(argv);
  std::signal(SIGPIPE, SIG_IGN);  // so is a Catalyst Live client that has gone
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of the write
  if (argc == 2 && std::string_view(argv[1]) == "gl-probe") return run_gl_probe();
  log_to_terminal();

  CLI::App app{"Ejecta: impact, porous crushing and fragmentation by smoothed particles, seen while it runs."};
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done; 2 something in the input is wrong (nothing was written); 3 the simulation failed or a file\n"
      "could not be written (results so far are kept); 4 stopped by a signal or by control (results are complete up "
      "to\n"
      "there, and --restart goes on)." +
      launcher_help());
  app.set_version_flag("--version", fmt::format("ejecta {}", EJECTA_VERSION));
  RunOptions options;
  int threads = 0, frames_per_second = 0;
  std::string folder, section;
  auto overrides = [&](CLI::App* command) {
    command
        ->add_option("--set", options.overrides, "replace a value of the scene, e.g. --set time.end=20us (repeatable)")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command->add_option("--threads", threads, "threads (same as --set run.threads=N)")->check(CLI::Range(1, 4096));
  };
  CLI::App* run = app.add_subcommand("run", "run a scene; images, tables and movies go to the run folder");
  run->add_option("scene", options.scene_file, "scene file (TOML)")->required();
  run->add_option("--out", options.out, "run folder (default: runs/<scene.name>)");
  run->add_flag("--restart", options.restart,
                "go on from the last checkpoint in the run folder, with the same scene but for scene.title, time.*,\n"
                "run.threads, [insitu] and [output] without peaks");
  run->add_option(
      "--from", options.from,
      "with --restart: the checkpoint, failed_*.h5 or snapshot to go on from; later ones are kept as *.aside");
  run->add_flag("--accept-changes", options.accept_changes,
                "with --restart: go on though the scene differs, and say in what");
  run->add_flag("--overwrite", options.overwrite,
                "replace an earlier run in the run folder; files that no run has written stay");
  overrides(run);
  CLI::App* check =
      app.add_subcommand("check",
                         "validate a scene by setting it up as a run does (as long as a few steps, and its\n"
                         "memory); print stages, columns, memory and time");
  check->add_option("scene", options.scene_file, "scene file (TOML)")->required();
  overrides(check);
  ReferenceOptions reference_options;
  CLI::App* reference_app = app.add_subcommand(
      "reference",
      "solve the scene in one dimension, finely: what runs of it are compared with, and how well it has converged");
  reference_app->add_option("scene", options.scene_file, "scene file (TOML)")->required();
  reference_app->add_option("--spacing", reference_options.spacing,
                            "width of a cell, e.g. 5mm (default: charge radius / 100, else resolution.spacing / 4)");
  reference_app->add_option("--geometry", reference_options.geometry,
                            "planar, cylindrical or spherical (default: that of the charge, else planar along x)");
  reference_app->add_option("--out", options.out, "folder (default: runs/<scene.name>_reference)");
  overrides(reference_app);
  CLI::App* describe =
      app.add_subcommand("describe", "every key of a scene or material: unit, range, default, meaning");
  describe->add_option("section", section, "one section, e.g. numerics or materials");
  std::vector<std::string> words;
  CLI::App* control = app.add_subcommand("control", "ask something of the run that goes on in a folder");
  control->add_option("folder", folder, "run folder")->required();
  control
      ->add_option("line", words,
                   "stop; pause; resume; checkpoint: write one now; frame: draw one now; end=TIME: of the run;\n"
                   "every=TIME: between frames")
      ->required();
  ServeOptions serve_options;
  CLI::App* serve = app.add_subcommand(
      "serve", "show the monitor page and all files of a run folder over HTTP, to this machine alone");
  serve->add_option("folder", serve_options.folder, "run folder")->required();
  serve->add_option("--port", serve_options.port, "port (default: the first free one from 8080 on)")
      ->check(CLI::Range(1, 65535));
  serve->add_flag("--control", serve_options.control,
                  "buttons for what control does, for those who have the address that is printed");
  CLI::App* movie = app.add_subcommand("movie", "make the movies of a run folder again");
  movie->add_option("folder", folder, "run folder")->required();
  movie->add_option("--fps", frames_per_second, "frames per second (default: 24, fewer for short movies)");
  std::vector<std::string> folders;
  std::string fragments_out = "runs/fragments";
  CLI::App* fragments = app.add_subcommand(
      "fragments",
      "draw the fragments of several runs of a scene as a band, beside what was caught and what theory expects");
  fragments->add_option("folders", folders, "run folders")->required();
  fragments->add_option("--out", fragments_out, "folder")->capture_default_str();
  CLI::App* replay = app.add_subcommand("replay", "show checkpoints and snapshots of a run folder to pipelines again");
  ReplayOptions replay_options;
  ExportOptions export_options;
  std::string at;
  const auto states = [&](CLI::App* command, StateChoice& choice) {
    CLI::Option* time = command->add_option("--at", at, "the state nearest to this time, e.g. 20us");
    command->add_flag("--all", choice.all, "all checkpoints and snapshots (default: the last one)")->excludes(time);
  };
  replay->add_option("folder", replay_options.folder, "run folder")->required();
  replay->add_option("--out", replay_options.out, "where the images go (default: <folder>/replay)");
  replay->add_option("--pipeline", replay_options.pipelines, "script in place of those of the run (repeatable)")
      ->allow_extra_args(false);
  replay->add_option("--set", replay_options.overrides, "replace a value of [insitu], e.g. --set insitu.view_size=8cm")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  states(replay, replay_options.states);
  CLI::App* export_app =
      app.add_subcommand("export", "checkpoints and snapshots of a run folder as files that ParaView opens");
  export_app->add_option("folder", export_options.folder, "run folder")->required();
  export_app->add_option("--format", export_options.format, "vtp (grids: vti; with a .pvd of all times) or xdmf")
      ->check(CLI::IsMember({"vtp", "xdmf"}));
  export_app->add_option("--out", export_options.out, "where they go (default: <folder>/export)");
  states(export_app, export_options.states);
  CLI::App* info = app.add_subcommand("info", "version, compiler, vector width");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (const std::string words_of_help = mistyped(app, argc, argv); !words_of_help.empty()) {
      fmt::print(stderr, "ejecta: {}\n", words_of_help);
      return exit_code::wrong_input;
    }
    const int code = app.exit(error);
    return code == 0 ? exit_code::done : exit_code::wrong_input;
  }
  if (threads > 0) options.overrides.push_back(fmt::format("run.threads={}", threads));

  try {
    if (*run) return run_command(options);
    if (*reference_app) {
      reference_options.scene_file = options.scene_file;
      reference_options.out = options.out;
      reference_options.overrides = options.overrides;
      return reference_command(reference_options);
    }
    if (*check) return check_command(options.scene_file, options.overrides);
    if (*control) return control_command(folder, words);
    if (*serve) return serve_command(serve_options);
    if (*fragments) return fragments_command(folders, fragments_out);
    if (*movie) return movie_command(folder, frames_per_second);
    if (!at.empty()) replay_options.states.at = export_options.states.at = parse_quantity(at, "s");
    if (*replay) return replay_command(replay_options);
    if (*export_app) return export_command(export_options);
    if (*describe) fmt::print("{}", reference(section, package_sections()));
    if (*info) return info_command();
    return exit_code::done;
  } catch (const InputError& error) {
    print_problems(error);
    return exit_code::wrong_input;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "ejecta: out of memory\n");
  } catch (const std::runtime_error& error) {  // of the simulation, its output, or the file system
    fmt::print(stderr, "ejecta: {}\n", error.what());
  }
  return exit_code::failed;
}
