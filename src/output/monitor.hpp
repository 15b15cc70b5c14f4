#pragma once
/// A page to watch a run by: static files in `monitor/` of the run folder, which any browser opens without a server.
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ejecta {

enum class RunState { running, finished, stopped, failed, paused };
std::string_view name_of(RunState state);

/// Something followed in time. Every series has times of its own, since not all are evaluated equally often.
struct MonitorSeries {
  std::string name, unit;            ///< as in history.csv; the page draws kinetic, internal and total energy together
  std::vector<double> time, values;  ///< s, SI
};

struct MonitorFrame {
  std::string file;  ///< relative to the run folder, such as images/slice_000120.png
  double time = 0;   ///< s
  std::int64_t step = 0;
  std::string reason;  ///< why it was drawn
};

/// A Catalyst script: how often it was run, and how often it failed.
struct MonitorPipeline {
  std::string name;
  std::int64_t frames = 0, failures = 0;
};

/// One view of the in-situ pipelines with all its images so far, the latest last; or other files that they write.
struct MonitorView {
  std::string name;
  std::vector<MonitorFrame> frames;
};

/// Values along a line, as of the last report.
struct MonitorProfile {
  std::string axis;           ///< x, y or z
  std::vector<double> place;  ///< m; empty: there is nothing to show
  struct Field {
    std::string name, unit;
    std::vector<double> values;  ///< SI
  };
  std::vector<Field> fields;
};

/// What limits the time step, report by report.
struct MonitorLimits {
  std::vector<double> time, dt;            ///< s; dt: the longest step that was allowed
  std::vector<std::string> cause;          ///< "Courant condition in ball"
  std::vector<std::vector<double>> place;  ///< m; empty where there is none
};

/// All the page shows. Values that do not apply stay empty.
struct MonitorStatus {
  std::string scene;
  RunState state = RunState::running;
  std::optional<int> exit;  ///< exit code, once the run is over
  std::int64_t step = 0;
  double time = 0, time_end = 0, dt = 0;  ///< s
  std::string limited_by;                 ///< winning vote of the time step
  MonitorLimits limits;
  std::string element = "particle";  ///< what there are so many of
  std::int64_t particles = 0;
  std::optional<double> particle_steps_per_s;
  std::optional<double> eta_s;                   ///< wall time still needed
  double wall_s = 0;                             ///< wall time used
  double insitu_share = 0;                       ///< of it, for pictures and fragments
  double memory = 0, memory_peak = 0;            ///< bytes
  std::optional<double> energy_error;            ///< relative, 1
  std::optional<double> angular_momentum_error;  ///< relative, 1
  std::vector<MonitorView> views;                ///< see read_views()
  std::vector<MonitorPipeline> pipelines;        ///< none without Catalyst
  std::vector<MonitorSeries> history;            ///< whole runs are welcome: the page gets at most 300 points of each
  MonitorProfile profile;
  bool draws = true;                             ///< false: there will be no images
  std::string fragment_target;                   ///< name of the body that the next two refer to
  std::vector<double> fragment_masses;      ///< its matter in a fragment / its mass, heaviest first, without the dust
  std::optional<double> smallest_fragment;  ///< the same of the lightest fragment that is counted
  std::vector<std::string> warnings;
  std::vector<std::string> control;  ///< what was asked of the run while it went on, and what became of it
  std::vector<std::string> log;      ///< its last lines
  std::vector<std::string> files;    ///< worth a link, relative to the run folder

  /// Adds a point [s, SI] to the series of that name, which is made if there is none.
  void record(std::string_view name, std::string_view unit, double at, double value);
};

/// The views listed in images/data.csv of a run folder, in the order of their first image; empty if there is no list.
std::vector<MonitorView> read_views(const std::filesystem::path& run_folder);

/// The last lines of run.log, at most `most`.
std::vector<std::string> read_log_tail(const std::filesystem::path& run_folder, std::size_t most);
/// Tables, figures, movies and logs in a run folder that a person opens, in this order.
std::vector<std::string> find_files(const std::filesystem::path& run_folder);

/// Rows of a long series that keep its shape: the first, the last, and least and greatest value of equal blocks
/// between. All rows if there are no more than `most` (at least 4).
std::vector<std::size_t> telling_rows(const std::vector<double>& values, std::size_t most);

/// One JSON object. `updated`: seconds since 1970, by which the page sees that a run has fallen silent.
std::string monitor_json(const MonitorStatus& status, std::int64_t updated);

/// Text of the page.
std::string_view monitor_page();

/// Keeps the files of `monitor/`: index.html; status.json; status.js, the same for the page, which may
/// load scripts but not data when it is opened from disk.
class Monitor {
 public:
  explicit Monitor(const std::filesystem::path& run_folder,
                   std::chrono::milliseconds interval = std::chrono::seconds(1));

  /// True if update() would write: nothing need be gathered before.
  bool due() const;
  /// Replaces the status atomically, at most once an interval unless forced (the last word of a run). Makes folder and
  /// page where they are not there. Throws OutputError if they cannot be written.
  void update(const MonitorStatus& status, bool force = false);
  /// The last word of a run whose files cannot be written: tries as well as it can, by writing over the status that is
  /// there, and never throws.
  void write_over(const MonitorStatus& status) noexcept;

 private:
  using Write = void (*)(const std::filesystem::path& file, std::string_view text);
  void write(const MonitorStatus& status, Write write_file) const;

  std::filesystem::path folder_;
  std::chrono::steady_clock::duration interval_;
  std::optional<std::chrono::steady_clock::time_point> written_;
};

}  // namespace ejecta
