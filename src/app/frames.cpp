#include "app/frames.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "app/log.hpp"
#include "base/errors.hpp"
#include "insitu/pipelines.hpp"
#include "output/fragment_files.hpp"
#include "schemes/kernels.hpp"

namespace ejecta {

namespace {

constexpr std::size_t samples_per_frame = 400;  ///< particles a frame adds to the compaction plot

/// Largest extent of a body [m].
double extent(const Body& body, int dim) {
  if (is_set(body.size[0])) return *std::max_element(body.size.begin(), body.size.begin() + dim);
  return std::max(2 * body.radius, is_set(body.length) ? body.length : 0.0);
}

double speed(const Body& body) { return std::hypot(body.velocity[0], body.velocity[1], body.velocity[2]); }

/// Fields of the slices: what an impact is about, else what a gas is about.
template <int Dim>
std::vector<Field> slice_fields(const Particles<Dim>& p) {
  std::vector<Field> fields;
  if (p.has(Field::damage)) {
    fields = {Field::pressure};
    if (p.has(Field::distension)) fields.push_back(Field::distension);
    fields.push_back(Field::damage);
  } else {
    fields = {Field::density, Field::pressure, Field::velocity};
  }
  return fields;
}

ColourMap map_of(std::string_view field) {
  if (field == "pressure") return ColourMap::cool_warm;
  if (field == "damage") return ColourMap::inferno;
  return ColourMap::viridis;
}

}  // namespace

View choose_view(const Scene& scene) {
  const Body& calmest = *std::min_element(scene.bodies.begin(), scene.bodies.end(),
                                          [](const Body& a, const Body& b) { return speed(a) < speed(b); });
  View view{scene.insitu.view_center, scene.insitu.view_size};
  for (std::size_t a = 0; a < 3; ++a)
    if (!is_set(view.center[a])) view.center[a] = calmest.center[a];
  if (!is_set(view.size)) view.size = 1.6 * extent(calmest, scene.dimension);
  return view;
}

std::map<std::string, ColourRange> default_ranges(const Scene& scene, const std::vector<Material>& materials,
                                                  const Outset& outset) {
  double distension = 1;
  for (const Material& m : materials)
    if (m.porosity) distension = std::max(distension, m.porosity->initial_distension());
  const double stiffest = outset.pressure, densest = outset.density;
  const double fastest = outset.speed > 0 ? outset.speed : std::sqrt(stiffest / densest);
  std::map<std::string, ColourRange> ranges{{"pressure", {std::min(0.0, -0.05 * stiffest), stiffest}},
                                            {"pressure_peak", {0, stiffest}},
                                            {"density", {0, densest}},
                                            {"velocity", {0, fastest}},
                                            {"distension", {1, std::max(1.01, distension)}},
                                            {"aspect", {1, std::clamp(scene.numerics.largest_aspect, 1.5, 4.0)}},
                                            {"damage", {0, 1}}};
  for (const auto& [name, range] : scene.insitu.ranges) ranges[name] = range;
  return ranges;
}

template <int Dim>
Frames<Dim>::Frames(const Sph<Dim>& sim, std::filesystem::path folder, bool catalyst)
    : folder_(std::move(folder)),
      view_(choose_view(sim.scene)),
      ranges_(default_ranges(sim.scene, sim.materials, sim.outset)) {
  const InSitu& insitu = sim.scene.insitu;
  std::filesystem::create_directories(folder_ / "images");
  auto grid_of = [&](int panels) {
    const auto [width, height] = panel_pixels(insitu.image_width, insitu.image_height, panels);
    // The picture must hold view_size in its smaller direction too.
    const double visible = view_.size * std::max(1.0, static_cast<double>(width) / height);
    return centred_grid(width, height, {view_.center[0], view_.center[Dim == 3 ? 2 : 1]}, visible);
  };
  grid_ = grid_of(static_cast<int>(slice_fields(sim.particles).size()));
  column_grid_ = grid_of(1);
  if (!catalyst) return;
  PipelineSettings settings;
  settings.run_folder = std::filesystem::absolute(folder_).string();
  settings.scene_title = sim.scene.title.empty() ? sim.scene.name : sim.scene.title;
  settings.dimension = Dim;
  settings.image_width = insitu.image_width;
  settings.image_height = insitu.image_height;
  settings.view_center = view_.center;
  settings.view_size = view_.size;
  settings.time_end = sim.scene.time_end;
  settings.particle_radius = 0.6 * sim.scene.spacing;
  settings.ranges = ranges_;
  settings.nodes_per_h = sim.scene.numerics.nodes_per_h;
  settings.radius_per_smoothing_length = 0.6 / settings.nodes_per_h;
  settings.fragment_target = sim.scene.bodies[target_body(sim.scene, sim.outset.bodies)].name;
  settings.kernel_support = kernel_support(sim.scene.numerics.kernel);
  bridge_ = std::make_unique<CatalystBridge>(pipeline_scripts(insitu.pipelines, sim.scene.fragments.enabled), settings);
}

template <int Dim>
double Frames<Dim>::next_time() const {
  return next_;
}

template <int Dim>
void Frames<Dim>::resume(Sph<Dim>& sim) {
  const double interval = sim.scene.time_end / (sim.scene.insitu.frames - 1);
  while (next_ <= sim.clock.time) next_ += interval;
  if (sim.scene.fragments.enabled) find_fragments(sim);
}

template <int Dim>
void Frames<Dim>::observe(Sph<Dim>& sim, bool last) {
  const double interval = sim.scene.time_end / (sim.scene.insitu.frames - 1);
  const bool due = sim.clock.time >= next_ - 1e-9 * interval;
  if ((!due && !last) || sim.clock.step == last_drawn_) return;
  while (next_ <= sim.clock.time * (1 + 1e-12)) next_ += interval;
  if (!last && ++passed_over_ < stride_) return;
  passed_over_ = 0;
  last_drawn_ = sim.clock.step;
  ++drawn_;
  if (sim.scene.fragments.enabled) sim.timers.time("in situ: fragments", [&] { find_fragments(sim); });
  if (sim.scene.insitu.enabled) {
    sim.timers.time("in situ: slice", [&] { sample(sim); });
    sim.timers.time("in situ: images", [&] {
      if (bridge_) {
        draw_with_catalyst(sim);
      } else {
        draw_without_gl(sim);
      }
    });
    govern(sim);
  }
  collect_compaction(sim);
  if (last) write_compaction_tables(sim);
}

/// Doubles the time between frames once in-situ work takes more than its share of the wall time. Steps still end at the
/// times of the frames passed over, so that the result of a run does not depend on the speed of the machine.
template <int Dim>
void Frames<Dim>::govern(const Sph<Dim>& sim) {
  const double spent = insitu_seconds(sim.timers);
  if (frame_++ == 0) {  // the first frame pays for starting the renderer: judge what comes after it
    insitu_before_ = spent;
    steps_before_ = sim.wall_seconds;
    return;
  }
  constexpr int frames_before_judging = 5;
  const double share = (spent - insitu_before_) / (spent - insitu_before_ + sim.wall_seconds - steps_before_);
  if (frame_ <= frames_before_judging || share <= sim.scene.insitu.max_share) return;
  stride_ *= 2;
  frame_ = 0;
  warn(
      fmt::format("in-situ work takes {:.0f} % of the wall time (insitu.max_share = {:.0f} %): time between frames "
                  "doubled",
                  100 * share, 100 * sim.scene.insitu.max_share));
}

template <int Dim>
void Frames<Dim>::warn(std::string text) {
  spdlog::warn("{}", text);
  warnings_.push_back(std::move(text));
}

double insitu_seconds(const StageTimers& timers) {
  double total = 0;
  for (const StageTimers::Entry& e : timers.entries())
    if (e.name.starts_with("in situ")) total += e.seconds;
  return total;
}

template <int Dim>
void Frames<Dim>::find_fragments(Sph<Dim>& sim) {
  fragments_ = tracker_.update(fragment_input(sim), sim.scene.fragments);
}

template <int Dim>
void Frames<Dim>::sample(const Sph<Dim>& sim) {
  const Particles<Dim>& p = sim.particles;
  const ParticleView view = particle_view(p);
  std::vector<FieldView> fields;
  for (Field f : slice_fields(p)) fields.push_back(field_view(p, f));
  const KernelShape kernel = with_kernel(sim.scene.numerics.kernel, [](auto k) {
    using K = decltype(k);
    return KernelShape{K::support, [](double q) { return K::template norm<Dim> * K::value(q); }};
  });
  slice_ = sample_slice(view, fields, kernel, grid_, view_.center[1]);
  if (!sim.scene.insitu.column_density) return;
  const SampledImage column = sample_column_density(view, kernel, column_grid_);
  const SampledImage::Field& field = column.field("column_density");
  // Fixed by the first frame: what lies undisturbed in the line of sight.
  if (column_density_max_ == 0)
    for (double value : field.components[0]) column_density_max_ = std::max(column_density_max_, value);
  const Panel panel{"column density", field.unit, field.components[0], 0, column_density_max_, ColourMap::viridis};
  paint(sim, "column", column_grid_, {&panel, 1});
}

/// Writes a picture by Ejecta's own painter.
template <int Dim>
void Frames<Dim>::paint(const Sph<Dim>& sim, std::string_view name, const PixelGrid& grid,
                        std::span<const Panel> panels) {
  const std::filesystem::path file = folder_ / "images" / fmt::format("{}_{:06d}.png", name, sim.clock.step);
  write_panels(file, sim.scene.insitu.image_width, sim.scene.insitu.image_height, grid, panels,
               {sim.scene.title, sim.clock.time, sim.scene.time_end, {"x", Dim == 3 ? "z" : "y"}});
}

template <int Dim>
void Frames<Dim>::draw_with_catalyst(Sph<Dim>& sim) {
  const std::vector<Channel> all = channels_.update(sim, slice_, view_.center[1], fragments_);
  const FrameReport report = bridge_->execute(sim.clock.step, sim.clock.time, all);
  images_ += static_cast<int>(report.images.size());
  for (const std::string& warning : report.warnings) {
    if (sim.scene.insitu.on_error == OnError::abort) throw SimulationError("in situ: " + warning);
    warn("in situ: " + warning);
  }
}

template <int Dim>
void Frames<Dim>::draw_without_gl(const Sph<Dim>& sim) {
  std::vector<Panel> panels;
  std::vector<std::vector<double>> magnitudes;
  magnitudes.reserve(slice_.fields.size());
  for (Field f : slice_fields(sim.particles)) {
    const SampledImage::Field& field = slice_.field(info(f).name);
    std::span<const double> values = field.components[0];
    if (field.components.size() > 1) {
      std::vector<double>& magnitude = magnitudes.emplace_back(values.size());
      for (std::size_t i = 0; i < magnitude.size(); ++i) {
        double sum = 0;
        for (const auto& component : field.components) sum += component[i] * component[i];
        magnitude[i] = std::sqrt(sum);
      }
      values = magnitude;
    }
    const ColourRange range = ranges_.at(field.name);
    panels.push_back({field.name, field.unit, values, range.min, range.max, map_of(field.name)});
  }
  const std::filesystem::path images = folder_ / "images";
  if (!index_) index_.emplace(images);
  const std::filesystem::path file = images / fmt::format("slice_{:06d}.png", sim.clock.step);
  write_panels(file, sim.scene.insitu.image_width, sim.scene.insitu.image_height, grid_, panels,
               {sim.scene.title, sim.clock.time, sim.scene.time_end, {"x", Dim == 3 ? "z" : "y"}});
  images_ += static_cast<int>(index_->add_new_images(sim.clock.step, sim.clock.time).size());
}

template <int Dim>
void Frames<Dim>::collect_compaction(const Sph<Dim>& sim) {
  const Particles<Dim>& p = sim.particles;
  for (std::size_t m = 0; m < sim.materials.size(); ++m) {
    if (!sim.materials[m].porosity) continue;
    const CrushCurve& curve = sim.materials[m].porosity->curve;
    const Range range = p.material_ranges()[m];
    const std::size_t stride = std::max<std::size_t>(1, range.size() / samples_per_frame);
    for (std::size_t i = range.begin; i < range.end; i += stride) {
      const double pressure = p.column(Field::pressure)[i], alpha = p.column(Field::distension)[i];
      if (alpha >= curve.initial_distension && pressure < curve.elastic_pressure) continue;  // untouched so far
      compaction_pressure_.push_back(pressure);
      compaction_distension_.push_back(alpha);
      compaction_loading_.push_back(std::abs(alpha - curve.alpha(pressure)) < 1e-6 ? 1 : 0);
    }
  }
}

template <int Dim>
void Frames<Dim>::write_compaction_tables(const Sph<Dim>& sim) const {
  for (const Material& material : sim.materials) {
    if (!material.porosity) continue;
    const CrushCurve& curve = material.porosity->curve;
    std::vector<double> pressure, distension;
    constexpr int points = 400;
    const double first = 0.1 * curve.elastic_pressure, last = 2 * curve.solid_pressure;
    for (int k = 0; k <= points; ++k) {
      pressure.push_back(first * std::pow(last / first, static_cast<double>(k) / points));
      distension.push_back(curve.alpha(pressure.back()));
    }
    std::filesystem::create_directories(folder_ / "figures");
    write_crush_curve(folder_ / "figures/crush_curve.csv", pressure, distension);
    write_compaction(folder_ / "figures/compaction.csv", compaction_pressure_, compaction_distension_,
                     compaction_loading_);
    return;  // one porous material is what the plot is for
  }
}

template class Frames<2>;
template class Frames<3>;

}  // namespace ejecta
