#pragma once
#include <optional>
#include <string>
#include <vector>

namespace ejecta {

/// How the program ends.
namespace exit_code {
inline constexpr int done = 0;
inline constexpr int wrong_input = 2;  ///< nothing has been written
inline constexpr int failed = 3;       ///< the simulation, or the writing of its results; what there is so far is kept
inline constexpr int stopped = 4;      ///< by a signal or control; results so far are complete and --restart goes on
}  // namespace exit_code

/// What the command line of `ejecta run` says.
struct RunOptions {
  std::string scene_file;
  std::string out;                     ///< run folder; empty: runs/<scene.name>
  std::vector<std::string> overrides;  ///< key=value
  bool restart = false;                ///< go on from the last checkpoint in the run folder
  std::string from;                    ///< the checkpoint to go on from instead
  bool accept_changes = false;         ///< go on even if the scene differs from that of the checkpoint
  bool overwrite = false;              ///< replace an earlier run in the run folder
};

/// What the command line of `ejecta reference` says.
struct ReferenceOptions {
  std::string scene_file;
  std::string out;                     ///< folder; empty: runs/<scene.name>_reference
  std::string spacing;                 ///< a length; empty: that which the problem suggests
  std::string geometry;                ///< a word; empty: that of the scene
  std::vector<std::string> overrides;  ///< key=value
};

/// Which states of a run are meant: the one nearest to a time, all, or else the last.
struct StateChoice {
  std::optional<double> at;  ///< s
  bool all = false;
};

/// What the command line of `ejecta replay` says.
struct ReplayOptions {
  std::string folder;                  ///< of the run
  std::string out;                     ///< where images/ goes; empty: <folder>/replay
  std::vector<std::string> pipelines;  ///< scripts in place of those of the run
  std::vector<std::string> overrides;  ///< key=value, of [insitu]
  StateChoice states;
};

/// What the command line of `ejecta export` says.
struct ExportOptions {
  std::string folder;          ///< of the run
  std::string out;             ///< empty: <folder>/export
  std::string format = "vtp";  ///< or xdmf
  StateChoice states;
};

/// What the command line of `ejecta serve` says.
struct ServeOptions {
  std::string folder;
  int port = 0;          ///< 0: the first free one from 8080 on
  bool control = false;  ///< offer buttons for what `ejecta control` does to those who know the token
};

int run_command(const RunOptions& options);
/// The one-dimensional solution that runs of a scene are compared with, and how well it has converged.
int reference_command(const ReferenceOptions& options);
/// Sets the scene up as a run does, so that whatever refuses a run before its first step refuses the check.
int check_command(const std::string& scene_file, const std::vector<std::string>& overrides);
int movie_command(const std::string& folder, int frames_per_second);
/// Writes fragment_runs.csv and figures/fragment_runs.png into a folder: the fragments of several runs as a band,
/// beside what was caught and what theories expect. Prints a line for each run. Throws InputError if a folder has no
/// fragments.
int fragments_command(const std::vector<std::string>& folders, const std::string& out);
int replay_command(const ReplayOptions& options);
int export_command(const ExportOptions& options);
int info_command();
/// With version and commit.
std::string program_name();
/// Leaves a line of control for the run that goes on in the folder.
int control_command(const std::string& folder, const std::vector<std::string>& words);
/// Serves a run folder to this machine until it is interrupted. Throws InputError if it is none or the port is taken.
int serve_command(const ServeOptions& options);

/// The folder of shipped material files.
std::string material_library();

}  // namespace ejecta
