/// What is made of the particles during a run: fragment_search/<dimension> and slice_image/<dimension>.
#include "analysis/fragments.hpp"
#include "performance/bodies.hpp"
#include "performance/flops.hpp"
#include "performance/measure.hpp"
#include "render/sampling.hpp"
#include "schemes/kernels.hpp"

namespace ejecta {
namespace {

constexpr double particles = 50000;

/// Reads position, mass, density, damage; writes the number of the group.
template <int Dim>
void fragment_search(benchmark::State& state) {
  const auto& sim = body<Dim>("pumice", particles);
  const auto& p = sim.particles;
  FragmentInput input{};
  input.position = vectors(p, Field::position);
  input.velocity = vectors(p, Field::velocity);
  input.mass = p.column(Field::mass);
  input.density = p.column(Field::density);
  input.damage = p.column(Field::damage);
  input.distension = p.column(Field::distension);
  input.id = p.label(Label::id);
  input.body = p.label(Label::body);
  input.material = p.label(Label::material);
  input.piece_of_body.assign(sim.scene.bodies.size(), 0);
  Measurement measured(state);
  measured.run([&] { benchmark::DoNotOptimize(find_groups(input, sim.scene.fragments)); });
  measured.items(static_cast<double>(p.size()));
  measured.bytes(static_cast<double>(p.size()) * ((Dim + 3) * sizeof(double) + sizeof(std::int32_t)));
}

/// Items are pixels. Operations are those at the pixels that lie within reach of a particle.
template <int Dim>
void slice_image(benchmark::State& state) {
  const auto& sim = body<Dim>("pumice", particles);
  const auto& p = sim.particles;
  const ParticleView view{vectors(p, Field::position),
                          p.column(Field::mass),
                          p.column(Field::density),
                          p.column(Field::smoothing_length),
                          {}};
  const std::vector<FieldView> fields{{"pressure", "Pa", {p.column(Field::pressure)}},
                                      {"distension", "1", {p.column(Field::distension)}}};
  const KernelShape kernel{WendlandC2::support, [](double q) { return WendlandC2::norm<Dim> * WendlandC2::value(q); }};
  const PixelGrid grid = centred_grid(480, 360, {0, 0}, 0.12);
  Measurement measured(state);
  measured.run([&] { benchmark::DoNotOptimize(sample_slice(view, fields, kernel, grid)); });
  double covered = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double depth = Dim == 2 ? 0 : p.column(Field::position, 1)[i],
                 reach = WendlandC2::support * p.column(Field::smoothing_length)[i];
    covered += std::max(0.0, reach * reach - depth * depth) * std::numbers::pi / (grid.pixel * grid.pixel);
  }
  measured.items(static_cast<double>(grid.width * grid.height));
  measured.flops<double>(covered * flops::slice_pixel(static_cast<int>(fields.size())));
}

BENCHMARK(fragment_search<2>)->Name("fragment_search/2d")->Unit(benchmark::kMillisecond);
BENCHMARK(fragment_search<3>)->Name("fragment_search/3d")->Unit(benchmark::kMillisecond);
BENCHMARK(slice_image<2>)->Name("slice_image/2d")->Unit(benchmark::kMillisecond);
BENCHMARK(slice_image<3>)->Name("slice_image/3d")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ejecta
