/// The pair passes: pair_rates/<dimension>/<kernel>/<precision>/<gas|stress|corrected> and
/// summation_density/<dimension>/<kernel>/<precision>. Particles move at random, so that viscosity acts between all:
/// where nothing closes a pass of solids in double precision is faster.
#include <random>

#include "particles/spatial_order.hpp"
#include "performance/bodies.hpp"
#include "performance/flops.hpp"
#include "performance/measure.hpp"
#include "scene/names.hpp"
#include "schemes/kernels.hpp"
#include "schemes/pair_records.hpp"

namespace ejecta {
namespace {

constexpr double particles = 50000;

/// Lists and a pass for one case, on the particles of the body that all cases share.
template <int Dim>
struct PairCase {
  Sph<Dim>& sim = body<Dim>("pumice", particles);
  PairLists<Dim> lists;
  std::unique_ptr<PairPass<Dim>> pass;

  explicit PairCase(const flops::PairWork& work) {
    PairPassSettings settings;
    settings.kernel = work.kernel;
    settings.precision = work.mixed ? Precision::mixed : Precision::double_precision;
    settings.stress = work.stress;
    settings.velocity_gradient = work.gradient;
    settings.gradient_correction = work.correction;
    for (const Material& m : sim.materials) settings.rules.reference_density.push_back(m.bulk_density());
    settings.length_unit = power_of_two_below(sim.scene.spacing);
    const std::size_t cluster = cluster_size(settings.precision);
    std::vector<std::uint32_t> order;
    spatial_order(sim.particles, cluster, order);
    sim.particles.reorder(order);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> speed(-10, 10);  // m/s
    for (int a = 0; a < Dim; ++a)
      for (double& v : sim.particles.column(Field::velocity, a)) v = speed(random);
    lists.build(sim.particles, {kernel_support(work.kernel), cluster, 0, {}});
    pass = make_pair_pass<Dim>(settings);
  }

  /// Mean numbers of partners: within the support of a particle, and candidates within reach of any of a cluster.
  struct Partners {
    double neighbours = 0, reached = 0;
  };
  Partners partners(Kernel kernel) const {
    const auto& p = sim.particles;
    const auto h = p.column(Field::smoothing_length);
    Partners mean;
    std::size_t members = 0, clusters = 0;
    for (std::size_t c = 0; c < lists.clusters().size(); c += 50, ++clusters) {
      const Cluster& cluster = lists.clusters()[c];
      members += cluster.end - cluster.begin;
      for (const std::uint32_t j : lists.candidates(c)) {
        bool reached = false;
        for (std::size_t i = cluster.begin; i < cluster.end; ++i) {
          const double q =
              (p.vector(Field::position, i) - p.vector(Field::position, j)).norm() / kernel_support(kernel);
          mean.neighbours += i != j && q < h[i];
          reached |= q < std::max(h[i], h[j]);
        }
        mean.reached += reached;
      }
    }
    return {mean.neighbours / static_cast<double>(members), mean.reached / static_cast<double>(clusters)};
  }

  /// Operations of all lanes: per candidate, and per candidate within reach.
  void report(Measurement& measured, const flops::PairWork& work, int per_candidate, int per_reached) const {
    const std::size_t lanes = lists.clusters().front().end - lists.clusters().front().begin;
    const Partners mean = partners(work.kernel);
    const double operations = static_cast<double>(lists.clusters().size() * lanes) *
                              (lists.mean_candidates() * per_candidate + mean.reached * per_reached);
    measured.items(static_cast<double>(sim.particles.size()));
    measured.counter("neighbours", mean.neighbours);
    measured.counter("candidates", lists.mean_candidates());
    measured.counter("reached", mean.reached);
    if (work.mixed) {
      measured.flops<float>(operations);
    } else {
      measured.flops<double>(operations);
    }
  }
};

template <int Dim>
void pair_rates(benchmark::State& state, const flops::PairWork& work) {
  PairCase<Dim> c(work);
  Measurement measured(state);
  measured.run([&] { c.pass->rates(c.sim.particles, c.lists); });
  c.report(measured, work, flops::pair_reach(work), flops::pair_exchange(work));
}

template <int Dim>
void summation_density(benchmark::State& state, const flops::PairWork& work) {
  PairCase<Dim> c(work);
  Measurement measured(state);
  measured.run([&] { c.pass->density(c.sim.particles, c.lists); });
  c.report(measured, work, flops::pair_density(work), 0);
}

template <int Dim>
void add_cases() {
  for (const Kernel kernel : {Kernel::cubic_spline, Kernel::quintic_spline, Kernel::wendland_c2, Kernel::wendland_c4})
    for (const bool mixed : {false, true}) {
      const std::string of = fmt::format("{}d/{}/{}", Dim, name_of(kernel), mixed ? "mixed" : "double");
      const auto add = [](const std::string& name, auto function, const flops::PairWork& work) {
        benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
          function(state, work);
        })->Unit(benchmark::kMillisecond);
      };
      add("pair_rates/" + of + "/gas", pair_rates<Dim>, {Dim, kernel, mixed, false, false, false});
      add("pair_rates/" + of + "/stress", pair_rates<Dim>, {Dim, kernel, mixed, true, true, false});
      add("pair_rates/" + of + "/corrected", pair_rates<Dim>, {Dim, kernel, mixed, true, true, true});
      add("summation_density/" + of, summation_density<Dim>, {Dim, kernel, mixed, false, false, false});
    }
}

const bool added = (add_cases<2>(), add_cases<3>(), true);

}  // namespace
}  // namespace ejecta
