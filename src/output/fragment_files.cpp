#include "output/fragment_files.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace ejecta {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double mass_of(const std::vector<double>& by_body, std::size_t body) {
  return body < by_body.size() ? by_body[body] : 0.0;
}

std::vector<CsvColumn> largest_columns(const FragmentContext& context) {
  return {{"time", "s"},
          {"largest fragment mass fraction", context.unit()},
          {"fragments", "1"},
          {"dust mass fraction", context.unit()}};
}

CsvWriter open(std::filesystem::path file, std::span<const CsvColumn> columns, std::optional<double> resume_at) {
  return resume_at ? CsvWriter(std::move(file), columns, *resume_at) : CsvWriter(std::move(file), columns);
}

void add_vector(std::vector<CsvCell>& row, const Vec<3>& v) { row.insert(row.end(), {v[0], v[1], v[2]}); }

void add_labels(std::vector<CsvCell>& row, const std::vector<double>& by_label, std::size_t labels) {
  for (std::size_t k = 0; k < labels; ++k) row.emplace_back(k < by_label.size() ? by_label[k] : 0.0);
}

}  // namespace

void write_fragments(const std::filesystem::path& file, const FragmentTable& table, const FragmentContext& context) {
  const std::string kg = context.dimension == 2 ? "kg/m" : "kg";
  std::vector<CsvColumn> columns{{"number", "1"}, {"particles", "1"}, {"mass", kg}, {"mass fraction", context.unit()}};
  for (const std::string& body : context.bodies) columns.push_back({"mass of " + body, kg});
  for (const std::string& material : context.materials) columns.push_back({"mass of material " + material, kg});
  for (const auto& [name, unit] : {std::pair{"centre", "m"}, {"velocity", "m/s"}, {"spin", "rad/s"}})
    for (const char* axis : {" x", " y", " z"}) columns.push_back({std::string(name) + axis, unit});
  for (const char* axis : {"a", "b", "c"}) columns.push_back({std::string("semi-axis ") + axis, "m"});
  for (const char* axis : {"x", "y", "z"}) columns.push_back({std::string("long axis ") + axis, "1"});
  columns.insert(columns.end(), {{"mean damage", "1"}, {"mean distension", "1"}});

  std::vector<std::vector<CsvCell>> rows;
  for (const Fragment& f : table.fragments) {
    std::vector<CsvCell> row{std::int64_t{f.number}, static_cast<std::int64_t>(f.carried.particles), f.carried.mass,
                             context.share(f.mass_of(context.target))};
    add_labels(row, f.mass_by_body, context.bodies.size());
    add_labels(row, f.mass_by_material, context.materials.size());
    for (const Vec<3>* v : {&f.centre, &f.velocity, &f.spin, &f.semi_axes, &f.long_axis}) add_vector(row, *v);
    row.insert(row.end(), {f.mean_damage, f.mean_distension});
    rows.push_back(std::move(row));
  }
  std::vector<CsvCell> dust(columns.size(), none);
  dust[0] = std::int64_t{0};
  dust[1] = static_cast<std::int64_t>(table.dust.particles);
  dust[2] = table.dust.mass;
  dust[3] = context.share(mass_of(table.dust_mass_by_body, context.target));
  for (std::size_t b = 0; b < context.bodies.size(); ++b) dust[4 + b] = mass_of(table.dust_mass_by_body, b);
  const std::size_t velocity = 4 + context.bodies.size() + context.materials.size() + 3;
  if (table.dust.mass > 0)
    for (int a = 0; a < 3; ++a) dust[velocity + static_cast<std::size_t>(a)] = table.dust.momentum[a] / table.dust.mass;
  rows.push_back(std::move(dust));
  write_csv(file, columns, rows);
}

void write_fragment_distribution(const std::filesystem::path& file, const FragmentTable& table,
                                 const FragmentContext& context) {
  std::vector<double> mass;
  for (const Fragment& f : table.fragments)
    if (const double m = f.mass_of(context.target); m > 0) mass.push_back(m);
  std::sort(mass.begin(), mass.end(), std::greater<>());
  std::vector<std::vector<CsvCell>> rows;
  for (std::size_t k = 0; k < mass.size(); ++k)
    if (k + 1 == mass.size() || mass[k + 1] < mass[k])  // equal masses share the row that counts them all
      rows.push_back({mass[k], context.share(mass[k]), static_cast<std::int64_t>(k + 1)});
  write_csv(file,
            std::vector<CsvColumn>{{"mass", context.dimension == 2 ? "kg/m" : "kg"},
                                   {"mass fraction", context.unit()},
                                   {"fragments at least as heavy", "1"}},
            rows);
}

void write_fragment_theory(const std::filesystem::path& file, std::span<const FragmentPrediction> predictions,
                           const FragmentContext& context) {
  const double whole = context.body_mass[context.target];
  std::vector<CsvColumn> columns{{"mass", context.dimension == 2 ? "kg/m" : "kg"}, {"mass fraction", context.unit()}};
  for (const FragmentPrediction& p : predictions)
    columns.insert(columns.end(), {{p.who + ", fewest", "1"}, {p.who + ", most", "1"}});
  constexpr int samples = 200;
  std::vector<std::vector<CsvCell>> rows;
  for (int k = 0; k <= samples; ++k) {
    const double mass = whole * std::pow(0.1 * context.smallest / whole, 1 - static_cast<double>(k) / samples);
    std::vector<CsvCell> row{mass, context.share(mass)};
    for (const FragmentPrediction& p : predictions) {
      const PieceRange pieces = pieces_at_least(mass, p, whole, context.dimension);
      row.insert(row.end(), {pieces.fewest, pieces.most});
    }
    rows.push_back(std::move(row));
  }
  write_csv(file, columns, rows);
}

void write_measured_fragments(const std::filesystem::path& file, std::vector<double> masses) {
  std::ranges::sort(masses, std::greater<>());
  std::vector<std::vector<CsvCell>> rows;
  for (std::size_t k = 0; k < masses.size(); ++k) rows.push_back({masses[k], static_cast<std::int64_t>(k + 1)});
  write_csv(file, std::vector<CsvColumn>{{"mass", "kg"}, {"fragments at least as heavy", "1"}}, rows);
}

LargestFragmentHistory::LargestFragmentHistory(std::filesystem::path file, FragmentContext context,
                                               std::optional<double> resume_at)
    : context_(std::move(context)), writer_(open(std::move(file), largest_columns(context_), resume_at)) {}

void LargestFragmentHistory::write(double time, const FragmentTable& table) {
  writer_.row(std::vector<CsvCell>{time, context_.share(table.largest_mass(context_.target)),
                                   static_cast<std::int64_t>(table.fragments.size()),
                                   context_.share(mass_of(table.dust_mass_by_body, context_.target))});
}

std::vector<BodyFragments> fragments_by_body(const FragmentTable& table, const FragmentContext& context) {
  std::vector<BodyFragments> result;
  for (std::size_t b = 0; b < context.bodies.size(); ++b)
    result.push_back({context.bodies[b], context.body_mass[b],
                      std::ranges::count_if(table.fragments, [&](const Fragment& f) { return f.mass_of(b) > 0; }),
                      context.share(table.largest_mass(b), b), context.share(mass_of(table.dust_mass_by_body, b), b)});
  return result;
}

void write_compaction(const std::filesystem::path& file, std::span<const double> pressure,
                      std::span<const double> distension, std::span<const std::int32_t> loading) {
  std::vector<std::vector<CsvCell>> rows;
  for (std::size_t i = 0; i < pressure.size(); ++i)
    rows.push_back({pressure[i], distension[i], std::int64_t{loading[i]}});
  write_csv(file, std::vector<CsvColumn>{{"pressure", "Pa"}, {"distension", "1"}, {"loading", "1"}}, rows);
}

void write_crush_curve(const std::filesystem::path& file, std::span<const double> pressure,
                       std::span<const double> distension) {
  std::vector<std::vector<CsvCell>> rows;
  for (std::size_t i = 0; i < pressure.size(); ++i) rows.push_back({pressure[i], distension[i]});
  write_csv(file, std::vector<CsvColumn>{{"pressure", "Pa"}, {"distension", "1"}}, rows);
}

}  // namespace ejecta
