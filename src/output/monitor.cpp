#include "output/monitor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "base/json.hpp"
#include "base/si_prefixes.hpp"
#include "output/atomic_file.hpp"
#include "render/csv_table.hpp"

namespace ejecta {

namespace {

constexpr std::size_t most_points = 300;
constexpr std::array state_names{"running", "finished", "stopped", "failed", "paused"};

/// Enough digits for a plot, and few bytes.
std::string short_json(double value) { return std::isfinite(value) ? fmt::format("{:.7g}", value) : "null"; }

std::string series_json(const MonitorSeries& s) {
  const std::vector<std::size_t> rows = telling_rows(s.values, most_points);
  return fmt::format(R"({{"name":{},"unit":{},"time":{},"values":{}}})", to_json(s.name), to_json(s.unit),
                     json_list(rows, [&](std::size_t i) { return short_json(s.time[i]); }),
                     json_list(rows, [&](std::size_t i) { return short_json(s.values[i]); }));
}

std::string profile_json(const MonitorProfile& profile) {
  const auto numbers = [](const std::vector<double>& values) { return json_list(values, short_json); };
  return fmt::format(R"({{"axis":{},"place":{},"fields":{}}})", to_json(profile.axis), numbers(profile.place),
                     json_list(profile.fields, [&](const MonitorProfile::Field& f) {
                       return fmt::format(R"({{"name":{},"unit":{},"values":{}}})", to_json(f.name), to_json(f.unit),
                                          numbers(f.values));
                     }));
}

/// Causes by name, most frequent first, with their shares of all reports; rows name a cause by its place in that list.
std::string limits_json(const MonitorLimits& limits) {
  std::vector<std::pair<std::string, double>> causes;
  for (const std::string& cause : limits.cause) {
    auto known = std::ranges::find(causes, cause, [](const auto& c) { return c.first; });
    if (known == causes.end()) known = causes.insert(known, {cause, 0.0});
    known->second += 1 / static_cast<double>(limits.cause.size());
  }
  std::ranges::stable_sort(causes, std::greater<>(), [](const auto& c) { return c.second; });
  const auto row = [&](std::size_t i) {
    const auto cause = std::ranges::find(causes, limits.cause[i], [](const auto& c) { return c.first; });
    return fmt::format("[{},{},{},{}]", short_json(limits.time[i]), short_json(limits.dt[i]), cause - causes.begin(),
                       json_list(limits.place[i], short_json));
  };
  return fmt::format(R"({{"causes":{},"rows":{}}})",
                     json_list(causes,
                               [](const auto& cause) {
                                 return fmt::format("[{},{}]", to_json(cause.first), short_json(cause.second));
                               }),
                     json_list(telling_rows(limits.dt, most_points), row));
}

std::string view_json(const MonitorView& view) {
  const auto frame = [](const MonitorFrame& f) {
    return fmt::format("[{},{},{},{}]", to_json("../" + f.file), short_json(f.time), f.step, to_json(f.reason));
  };
  return fmt::format("{{\"name\":{},\"latest\":{},\"frames\":{}}}", to_json(view.name),
                     view.frames.empty() ? "null" : to_json("../" + view.frames.back().file),
                     json_list(view.frames, frame));
}

std::string pipeline_json(const MonitorPipeline& p) {
  return fmt::format("{{\"name\":{},\"frames\":{},\"failures\":{}}}", to_json(p.name), p.frames, p.failures);
}

bool is_picture(const MonitorView& view) {
  const std::filesystem::path file = view.frames.back().file;
  return file.extension() == ".png" || file.extension() == ".jpg";
}

/// Files that are no pictures, as their name, how many there are, and the latest.
std::string extract_json(const MonitorView& view) {
  return fmt::format("{{\"name\":{},\"files\":{},\"latest\":{}}}", to_json(view.name), view.frames.size(),
                     to_json("../" + view.frames.back().file));
}

/// Points (m/M, N) where N fragments are at least as heavy as m; of many, ranks that are evenly spaced on a log axis.
std::string distribution_json(const std::vector<double>& masses) {
  std::vector<std::size_t> ranks;
  const double n = static_cast<double>(masses.size());
  for (std::size_t k = 0; k < std::min(masses.size(), most_points); ++k) {
    const double exponent = static_cast<double>(k) / static_cast<double>(most_points - 1);
    const std::size_t rank =
        masses.size() <= most_points ? k + 1 : static_cast<std::size_t>(std::lround(std::pow(n, exponent)));
    if (ranks.empty() || rank > ranks.back()) ranks.push_back(rank);
  }
  return json_list(ranks, [&](std::size_t rank) { return fmt::format("[{},{}]", short_json(masses[rank - 1]), rank); });
}

}  // namespace

std::string_view name_of(RunState state) { return state_names[static_cast<std::size_t>(state)]; }

void MonitorStatus::record(std::string_view name, std::string_view unit, double at, double value) {
  auto series = std::find_if(history.begin(), history.end(), [&](const MonitorSeries& s) { return s.name == name; });
  if (series == history.end())
    series = history.insert(series, MonitorSeries{std::string(name), std::string(unit), {}, {}});
  series->time.push_back(at);
  series->values.push_back(value);
}

std::vector<MonitorView> read_views(const std::filesystem::path& run_folder) {
  std::vector<MonitorView> views;
  const std::filesystem::path file = run_folder / "images" / "data.csv";
  if (!std::filesystem::exists(file)) return views;
  const CsvTable table = read_csv(file);
  const std::size_t time = table.find("time"), step = table.find("step"), name = table.find("view"),
                    path = table.find("FILE"), reason = table.find("reason");
  if (std::max({time, step, name, path}) == CsvTable::npos) return views;
  for (const std::vector<std::string>& row : table.rows) {
    auto view = std::ranges::find(views, row[name], &MonitorView::name);
    if (view == views.end()) view = views.insert(view, MonitorView{row[name], {}});
    view->frames.push_back({"images/" + row[path], std::strtod(row[time].c_str(), nullptr),
                            std::atoll(row[step].c_str()), reason == CsvTable::npos ? "" : row[reason]});
  }
  return views;
}

std::vector<std::string> read_log_tail(const std::filesystem::path& run_folder, std::size_t most) {
  constexpr std::streamoff longest = 16384;  // bytes: logs of long runs are long
  std::ifstream in(run_folder / "run.log", std::ios::ate);
  std::vector<std::string> lines;
  if (!in) return lines;
  const std::streamoff size = in.tellg();
  in.seekg(std::max<std::streamoff>(0, size - longest));
  std::string line;
  if (size > longest) std::getline(in, line);  // the rest of one
  while (std::getline(in, line)) lines.push_back(line);
  if (lines.size() > most) lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(most));
  return lines;
}

std::vector<std::string> find_files(const std::filesystem::path& run_folder) {
  namespace fs = std::filesystem;
  std::vector<std::string> files;
  constexpr std::array<std::pair<const char*, const char*>, 6> kinds{
      {{"", ".mp4"}, {"figures", ".png"}, {"", ".json"}, {"", ".csv"}, {"", ".toml"}, {"", ".log"}}};
  for (const auto& [folder, extension] : kinds) {
    std::error_code gone;
    std::vector<std::string> found;
    for (fs::directory_iterator entry(run_folder / folder, gone), end; !gone && entry != end; entry.increment(gone))
      if (entry->path().extension() == extension)
        found.push_back((fs::path(folder) / entry->path().filename()).string());
    std::ranges::sort(found);
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

std::vector<std::size_t> telling_rows(const std::vector<double>& values, std::size_t most) {
  std::vector<std::size_t> rows;
  const std::size_t n = values.size();
  if (n <= most) {
    for (std::size_t i = 0; i < n; ++i) rows.push_back(i);
    return rows;
  }
  rows.push_back(0);
  const std::size_t blocks = (most - 2) / 2;
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(1 + b * (n - 2) / blocks);
    const auto end = values.begin() + static_cast<std::ptrdiff_t>(1 + (b + 1) * (n - 2) / blocks);
    const auto [least, greatest] = std::minmax_element(begin, end);
    rows.push_back(static_cast<std::size_t>(std::min(least, greatest) - values.begin()));
    if (least != greatest) rows.push_back(static_cast<std::size_t>(std::max(least, greatest) - values.begin()));
  }
  rows.push_back(n - 1);
  return rows;
}

std::string monitor_json(const MonitorStatus& s, std::int64_t updated) {
  std::string text;
  const auto add = [&](const char* key, const std::string& value) {
    text += fmt::format("{}\"{}\": {}", text.empty() ? "{\n" : ",\n", key, value);
  };
  add("scene", to_json(s.scene));
  add("state", to_json(name_of(s.state)));
  add("exit", to_json(s.exit));
  add("updated", to_json(updated));
  add("step", to_json(s.step));
  add("time_s", to_json(s.time));
  add("time_end_s", to_json(s.time_end));
  add("dt_s", to_json(s.dt));
  add("limited_by", to_json(s.limited_by));
  add("limits", limits_json(s.limits));
  add("element", to_json(s.element));
  add("particles", to_json(s.particles));
  add("particle_steps_per_s", to_json(s.particle_steps_per_s));
  add("eta_s", to_json(s.eta_s));
  add("wall_s", to_json(s.wall_s));
  add("insitu_share", to_json(s.insitu_share));
  add("memory_bytes", to_json(s.memory));
  add("memory_peak_bytes", to_json(s.memory_peak));
  add("energy_error_rel", to_json(s.energy_error));
  add("angular_momentum_error_rel", to_json(s.angular_momentum_error));
  add("warnings", json_list(s.warnings, [](const std::string& w) { return to_json(w); }));
  add("control", json_list(s.control));
  std::vector<MonitorView> pictures, extracts;
  for (const MonitorView& view : s.views)
    (view.frames.empty() || is_picture(view) ? pictures : extracts).push_back(view);
  add("views", json_list(pictures, view_json));
  add("extracts", json_list(extracts, extract_json));
  add("pipelines", json_list(s.pipelines, pipeline_json));
  add("log", json_list(s.log));
  add("files", json_list(s.files));
  add("draws", s.draws ? "true" : "false");
  add("profile", profile_json(s.profile));
  add("history", json_list(s.history, series_json));
  add("fragment_target", to_json(s.fragment_target));
  add("smallest_fragment", to_json(s.smallest_fragment));
  add("fragments", distribution_json(s.fragment_masses));
  add("prefixes", json_list(si_prefixes));
  return text + "\n}\n";
}

Monitor::Monitor(const std::filesystem::path& run_folder, std::chrono::milliseconds interval)
    : folder_(run_folder / "monitor"), interval_(interval) {}

bool Monitor::due() const { return !written_ || std::chrono::steady_clock::now() - *written_ >= interval_; }

void Monitor::update(const MonitorStatus& status, bool force) {
  if (!force && !due()) return;
  if (!std::filesystem::exists(folder_ / "index.html")) write_atomically(folder_ / "index.html", monitor_page());
  write(status, write_atomically);
  written_ = std::chrono::steady_clock::now();
}

void Monitor::write_over(const MonitorStatus& status) noexcept {
  try {
    write(status, [](const std::filesystem::path& file, std::string_view text) { std::ofstream(file) << text; });
  } catch (const std::exception&) {
    // The run ends with another error already.
  }
}

void Monitor::write(const MonitorStatus& status, Write write_file) const {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const std::string json = monitor_json(status, std::chrono::duration_cast<std::chrono::seconds>(now).count());
  write_file(folder_ / "status.json", json);
  write_file(folder_ / "status.js", "ejecta_status(" + json + ");\n");
}

}  // namespace ejecta
