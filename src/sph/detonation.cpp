#include "sph/detonation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <limits>
#include <queue>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "scene/shape_geometry.hpp"
#include "scene/units.hpp"

namespace ejecta {

namespace {

namespace bg = boost::geometry;

constexpr double never = std::numeric_limits<double>::infinity();

/// Explosives as bodies, a quarter of a spacing larger all around: faces that touch are no gaps, and the particles of a
/// round body, which need not lie within it to the last bit, are in it.
constexpr double margin = 0.25;
/// Places at which a straight way asks where it is, in spacings.
constexpr double look = 0.25;
/// Neighbours along all diagonals of a cube of a lattice, in spacings. A detonator touches what is as near.
constexpr double reach = 1.75;

template <int Dim>
class Explosives {
 public:
  Explosives(const Scene& scene, const std::vector<Material>& materials) {
    for (const Body& body : scene.bodies) {
      const auto explosive = std::ranges::find(materials, body.material, &Material::name)->explosive();
      if (!explosive) continue;
      const double spacing = scene.spacing * body.spacing_factor;
      finest_ = std::min(finest_, spacing);
      coarsest_ = std::max(coarsest_, spacing);
      fastest_ = std::max(fastest_, explosive->detonation_speed);
      Body wider = body;
      wider.radius += margin * spacing;
      wider.inner_radius = std::max(0.0, body.inner_radius - margin * spacing);
      wider.length += 2 * margin * spacing;
      for (double& edge : wider.size) edge += 2 * margin * spacing;
      bodies_.push_back({wider, 1 / explosive->detonation_speed});
    }
  }
  double coarsest() const { return coarsest_; }
  double fastest() const { return fastest_; }

  /// Time of the straight way from a to b [s]; infinite if it leaves the explosives.
  double time(const Vec<Dim>& a, const Vec<Dim>& b) const {
    const double length = (b - a).norm();
    const double pieces = std::max(1.0, std::ceil(length / (look * finest_)));
    double sum = 0;
    for (double k = 0; k < pieces; ++k) {
      const double here = slowness(a + (k + 0.5) / pieces * (b - a));
      if (here == never) return never;
      sum += here;
    }
    return length * (sum / pieces);
  }

 private:
  double slowness(const Vec<Dim>& x) const {
    for (const auto& [body, slowness] : bodies_)
      if (inside<Dim>(body, x)) return slowness;
    return never;
  }
  struct Charge {
    Body body;
    double slowness;  ///< s/m
  };
  std::vector<Charge> bodies_;
  double finest_ = never, coarsest_ = 0, fastest_ = 0;
};

/// The place on a detonator that is nearest to x.
template <int Dim>
Vec<Dim> nearest_on(const Detonator& detonator, const Vec<Dim>& x) {
  const Vec<Dim> p = first_components<Dim>(detonator.position);
  switch (detonator.shape) {
    case DetonatorShape::point:
      return p;
    case DetonatorShape::line: {
      const Vec<Dim> along = first_components<Dim>(detonator.end) - p;
      return p + std::clamp((x - p).dot(along) / along.squaredNorm(), 0.0, 1.0) * along;
    }
    case DetonatorShape::plane: {
      const Vec<Dim> n = first_components<Dim>(detonator.normal).normalized();  // zero if it is along z in 2D
      return x - (x - p).dot(n) * n;
    }
  }
  return p;
}

/// How the detonation has come: straight from `source`, where it was at `start`.
template <int Dim>
struct Way {
  double time = never, start = never;  ///< s
  Vec<Dim> source = Vec<Dim>::Zero();
};

/// Distance of the nearest place from a detonator [m].
template <int Dim>
double distance_of(const Detonator& detonator, const std::vector<Vec<Dim>>& places) {
  return parallel_min(places.size(), never,
                      [&](std::size_t k) { return (nearest_on<Dim>(detonator, places[k]) - places[k]).norm(); })
      .value;
}

/// Straight ways from a detonator.
template <int Dim>
void light(const Detonator& detonator, const Explosives<Dim>& explosives, const std::vector<Vec<Dim>>& places,
           std::vector<Way<Dim>>& ways) {
  parallel_for(0, places.size(), [&](std::size_t k) {
    const Vec<Dim> source = nearest_on<Dim>(detonator, places[k]);
    const double time = detonator.time + explosives.time(source, places[k]);
    if (time < ways[k].time) ways[k] = {time, detonator.time, source};
  });
}

/// Hands ways on from particle to particle, the earliest first (Dijkstra 1959): a neighbour is reached straight from
/// the source of the one before, or from that particle itself, whichever is quicker. Ways thus turn only where they
/// must: at corners, and where the detonation passes from one explosive to another.
template <int Dim>
void spread(const Explosives<Dim>& explosives, const std::vector<Vec<Dim>>& places, std::vector<Way<Dim>>& ways) {
  using Point = bg::model::point<double, Dim, bg::cs::cartesian>;
  const auto point = [](const Vec<Dim>& x) {
    if constexpr (Dim == 2) return Point(x[0], x[1]);
    if constexpr (Dim == 3) return Point(x[0], x[1], x[2]);
  };
  using Entry = std::pair<Point, std::size_t>;
  std::vector<Entry> entries;
  for (std::size_t k = 0; k < places.size(); ++k) entries.emplace_back(point(places[k]), k);
  const bg::index::rtree<Entry, bg::index::rstar<16>> tree(entries);

  using Reached = std::pair<double, std::size_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
  for (std::size_t k = 0; k < places.size(); ++k)
    if (ways[k].time < never) front.emplace(ways[k].time, k);
  const double distance = reach * explosives.coarsest();
  std::vector<Entry> near;
  while (!front.empty()) {
    const auto [time, i] = front.top();
    front.pop();
    if (time > ways[i].time) continue;  // reached earlier since
    near.clear();
    const Vec<Dim> margin_of_box = Vec<Dim>::Constant(distance);
    const bg::model::box<Point> box(point(places[i] - margin_of_box), point(places[i] + margin_of_box));
    tree.query(bg::index::within(box), std::back_inserter(near));
    for (const auto& [unused, j] : near) {
      if ((places[j] - places[i]).norm() > distance) continue;
      for (const Way<Dim>& from : {ways[i], Way<Dim>{time, time, places[i]}}) {
        // Round-off must not hand the same way back and forth, and most neighbours have been reached as early.
        const double soonest = from.start + (places[j] - from.source).norm() / explosives.fastest();
        if (!(soonest < ways[j].time * (1 - 1e-12))) continue;
        const double arrival = from.start + explosives.time(from.source, places[j]);
        if (!(arrival < ways[j].time * (1 - 1e-12))) continue;
        ways[j] = {arrival, from.start, from.source};
        front.emplace(arrival, j);
      }
    }
  }
}

}  // namespace

template <int Dim>
std::vector<double> lighting_times(const Scene& scene, const std::vector<Material>& materials,
                                   const std::vector<Placement<Dim>>& placements) {
  const Explosives<Dim> explosives(scene, materials);
  std::vector<std::size_t> particles;
  std::vector<Vec<Dim>> places;
  for (std::size_t i = 0; i < placements.size(); ++i)
    if (materials[static_cast<std::size_t>(placements[i].material)].explosive()) {
      particles.push_back(i);
      places.push_back(placements[i].x);
    }
  std::vector<Way<Dim>> ways(places.size());
  std::vector<std::string> problems;
  for (const Detonator& detonator : scene.detonators) {
    const double distance = distance_of(detonator, places);
    if (distance < reach * explosives.coarsest())
      light(detonator, explosives, places, ways);
    else
      problems.push_back(fmt::format(
          "{}: detonators: expected one that touches an explosive, got one {} from the nearest of its particles",
          detonator.origin, format_quantity(distance, "m")));
  }
  if (!problems.empty()) throw InputError(problems);
  spread(explosives, places, ways);
  std::vector<double> times(placements.size(), 0);
  for (std::size_t k = 0; k < places.size(); ++k) times[particles[k]] = ways[k].time;
  return times;
}

template std::vector<double> lighting_times<2>(const Scene&, const std::vector<Material>&,
                                               const std::vector<Placement<2>>&);
template std::vector<double> lighting_times<3>(const Scene&, const std::vector<Material>&,
                                               const std::vector<Placement<3>>&);

}  // namespace ejecta
