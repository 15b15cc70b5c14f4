#include "analysis/fragments.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "analysis/friends.hpp"

namespace ejecta {

double FragmentInput::particle_size(std::size_t i) const {
  const double volume = mass[i] / density[i];
  return dimension() == 2 ? std::sqrt(volume) : std::cbrt(volume);
}

namespace {

Vec<3> vector_at(const std::array<std::span<const double>, 3>& columns, std::size_t i) {
  return {columns[0][i], columns[1][i], columns[2].empty() ? 0.0 : columns[2][i]};
}

/// Brings a point back between the periodic faces.
Vec<3> wrapped(const FragmentInput& in, Vec<3> x) {
  for (int a = 0; a < 3; ++a)
    if (const PeriodicAxis& axis = in.box[static_cast<std::size_t>(a)]; axis.length > 0)
      x[a] -= axis.length * std::floor((x[a] - axis.min) / axis.length);
  return x;
}

Carried carried_by(const FragmentInput& in, std::size_t i) {
  const Vec<3> momentum = in.mass[i] * vector_at(in.velocity, i);
  return {1, in.mass[i], momentum, vector_at(in.position, i).cross(momentum)};
}

void add_mass(std::vector<double>& by_label, std::int32_t label, double mass) {
  if (by_label.size() <= static_cast<std::size_t>(label)) by_label.resize(static_cast<std::size_t>(label) + 1, 0.0);
  by_label[static_cast<std::size_t>(label)] += mass;
}

/// Second moments of a fragment about its centre of mass.
struct SecondMoments {
  Mat<3> points = Mat<3>::Zero();            ///< sum m r r^T, kg m^2
  double inner = 0;                          ///< sum m d^2 / 12: what the particles' own extent adds to each axis
  Vec<3> angular_momentum = Vec<3>::Zero();  ///< about the centre
};

/// Spin and axes. Directions without inertia (a line of particles about itself) have no spin.
void add_shape(Fragment& fragment, const SecondMoments& moments, int dimension) {
  const Mat<3> inertia = moments.points.trace() * Mat<3>::Identity() - moments.points;
  const Eigen::SelfAdjointEigenSolver<Mat<3>> turning(inertia);
  fragment.spin.setZero();
  for (int a = 0; a < 3; ++a) {
    const Vec<3> axis = turning.eigenvectors().col(a);
    if (const double about = turning.eigenvalues()[a]; about > 1e-12 * turning.eigenvalues()[2])
      fragment.spin += axis * (axis.dot(moments.angular_momentum) / about);
  }
  // A uniform ellipsoid has second moments M a^2 / 5, an ellipse M a^2 / 4.
  const double ratio = dimension == 3 ? 5 : 4;
  const Eigen::SelfAdjointEigenSolver<Mat<3>> extent(moments.points);
  for (int a = 0; a < 3; ++a) {
    const double second = std::max(0.0, extent.eigenvalues()[2 - a]) + moments.inner;
    fragment.semi_axes[a] = a < dimension ? std::sqrt(ratio * second / fragment.carried.mass) : 0.0;
  }
  fragment.long_axis = extent.eigenvectors().col(2);
  Eigen::Index largest;
  fragment.long_axis.cwiseAbs().maxCoeff(&largest);
  if (fragment.long_axis[largest] < 0) fragment.long_axis *= -1;
}

}  // namespace

Vec<3> FragmentInput::place(std::size_t i) const { return vector_at(position, i); }

Vec<3> FragmentInput::unwrapped(const Vec<3>& x, const BoxShift& shift) const {
  return x + shift.cast<double>().cwiseProduct(Vec<3>(box[0].length, box[1].length, box[2].length));
}

double FragmentTable::largest_mass(std::size_t body) const {
  double largest = 0;
  for (const Fragment& f : fragments) largest = std::max(largest, f.mass_of(body));
  return largest;
}

Carried& Carried::operator+=(const Carried& other) {
  particles += other.particles;
  mass += other.mass;
  momentum += other.momentum;
  angular_momentum += other.angular_momentum;
  return *this;
}

Groups find_groups(const FragmentInput& in, const FragmentSettings& settings) {
  std::vector<std::uint32_t> members;
  for (std::size_t i = 0; i < in.size(); ++i)
    if ((in.damage.empty() || in.damage[i] < settings.damage_threshold) && in.piece(i) >= 0 &&
        std::isnormal(in.particle_size(i)))
      members.push_back(static_cast<std::uint32_t>(i));
  Friends friends = join_friends(in, members, settings);

  struct Group {
    std::size_t particles = 0;
    double target_mass = 0, mass = 0;
    std::int32_t lowest_id = 0;
  };
  std::vector<Group> groups;
  std::vector<std::int32_t> group_of(in.size(), -1);  // by root, then by particle
  for (const std::uint32_t i : members) {
    const std::uint32_t root = friends.root[i];  // the root is the lowest member, so it is met first
    if (root == i) {
      group_of[i] = static_cast<std::int32_t>(groups.size());
      groups.push_back({.lowest_id = in.id[i]});
    }
    group_of[i] = group_of[root];
    Group& group = groups[static_cast<std::size_t>(group_of[i])];
    ++group.particles;
    group.mass += in.mass[i];
    if (in.body[i] == in.target) group.target_mass += in.mass[i];
    group.lowest_id = std::min(group.lowest_id, in.id[i]);
  }
  std::vector<std::size_t> order(groups.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto key = [&](std::size_t g) {
      return std::tuple(-groups[g].target_mass, -groups[g].mass, groups[g].lowest_id);
    };
    return key(a) < key(b);
  });
  std::vector<std::int32_t> rank(groups.size(), 0);
  std::int32_t next = 0;
  for (const std::size_t g : order)
    if (groups[g].particles >= static_cast<std::size_t>(std::max(1, settings.min_particles))) rank[g] = ++next;
  for (std::int32_t& g : group_of) g = g < 0 ? 0 : rank[static_cast<std::size_t>(g)];
  return {std::move(group_of), std::move(friends.shift)};
}

FragmentTable describe_groups(const FragmentInput& in, Groups found) {
  FragmentTable table;
  std::vector<std::int32_t>& number = found.number;
  const std::int32_t groups = number.empty() ? 0 : *std::max_element(number.begin(), number.end());
  table.fragments.resize(static_cast<std::size_t>(groups));
  std::vector<Vec<3>> mass_moment(table.fragments.size(), Vec<3>::Zero());
  for (std::size_t i = 0; i < in.size(); ++i) {
    if (number[i] == 0) {
      table.dust += carried_by(in, i);
      add_mass(table.dust_mass_by_body, in.body[i], in.mass[i]);
      continue;
    }
    const std::size_t g = static_cast<std::size_t>(number[i] - 1);
    Fragment& fragment = table.fragments[g];
    fragment.carried += carried_by(in, i);
    mass_moment[g] += in.mass[i] * in.unwrapped(in.place(i), found.shift[i]);
    add_mass(fragment.mass_by_body, in.body[i], in.mass[i]);
    add_mass(fragment.mass_by_material, in.material[i], in.mass[i]);
    fragment.mean_damage += in.damage.empty() ? 0 : in.mass[i] * in.damage[i];
    if (!in.distension.empty()) fragment.mean_distension += in.mass[i] * (in.distension[i] - 1);
  }
  for (std::size_t g = 0; g < table.fragments.size(); ++g) {
    Fragment& fragment = table.fragments[g];
    const double mass = fragment.carried.mass;
    fragment.number = static_cast<std::int32_t>(g + 1);
    fragment.centre = mass_moment[g] / mass;
    fragment.velocity = fragment.carried.momentum / mass;
    fragment.mean_damage /= mass;
    fragment.mean_distension = 1 + (fragment.mean_distension - 1) / mass;
  }
  // Second moments about the centres in a second pass: far from the origin the parallel-axis theorem would cancel.
  std::vector<SecondMoments> moments(table.fragments.size());
  for (std::size_t i = 0; i < in.size(); ++i) {
    if (number[i] == 0) continue;
    const std::size_t g = static_cast<std::size_t>(number[i] - 1);
    const Vec<3> r = in.unwrapped(in.place(i), found.shift[i]) - table.fragments[g].centre;
    const Vec<3> v = vector_at(in.velocity, i) - table.fragments[g].velocity;
    const double d = in.particle_size(i);
    moments[g].points += in.mass[i] * r * r.transpose();
    moments[g].inner += in.mass[i] * d * d / 12;
    moments[g].angular_momentum += in.mass[i] * r.cross(v);
  }
  for (std::size_t g = 0; g < moments.size(); ++g) {
    add_shape(table.fragments[g], moments[g], in.dimension());
    table.fragments[g].centre = wrapped(in, table.fragments[g].centre);
  }
  table.number = std::move(number);
  return table;
}

FragmentTable FragmentTracker::update(const FragmentInput& in, const FragmentSettings& settings) {
  FragmentTable table = describe_groups(in, find_groups(in, settings));
  const std::vector<std::int32_t> stable = stable_numbers(in, table);
  for (std::size_t g = 0; g < stable.size(); ++g) table.fragments[g].number = stable[g];
  for (std::int32_t& number : table.number)
    if (number != 0) number = stable[static_cast<std::size_t>(number - 1)];
  restore(in.id, table.number, last_number_);
  return table;
}

std::vector<std::int32_t> FragmentTracker::stable_numbers(const FragmentInput& in, const FragmentTable& table) {
  std::map<std::pair<std::int32_t, std::int32_t>, double> shared;  // (old number, new group) -> mass
  for (std::size_t i = 0; i < in.size(); ++i) {
    if (table.number[i] == 0) continue;
    if (const auto old = number_of_id_.find(in.id[i]); old != number_of_id_.end())
      shared[{old->second, table.number[i]}] += in.mass[i];
  }
  std::vector<std::pair<std::pair<std::int32_t, std::int32_t>, double>> by_mass(shared.begin(), shared.end());
  std::stable_sort(by_mass.begin(), by_mass.end(), [](const auto& a, const auto& b) { return a.second > b.second; });

  std::vector<std::int32_t> number(table.fragments.size(), 0);
  std::vector<bool> taken(static_cast<std::size_t>(last_number_) + 1, false);
  for (const auto& [pair, mass] : by_mass) {
    const auto [old, group] = pair;
    if (taken[static_cast<std::size_t>(old)] || number[static_cast<std::size_t>(group - 1)] != 0) continue;
    taken[static_cast<std::size_t>(old)] = true;
    number[static_cast<std::size_t>(group - 1)] = old;
  }
  for (std::int32_t& n : number)
    if (n == 0) n = ++last_number_;
  return number;
}

void FragmentTracker::restore(std::span<const std::int32_t> id, std::span<const std::int32_t> number,
                              std::int32_t last_number) {
  last_number_ = last_number;
  number_of_id_.clear();
  for (std::size_t i = 0; i < id.size(); ++i) {
    if (number[i] == 0) continue;
    number_of_id_[id[i]] = number[i];
    last_number_ = std::max(last_number_, number[i]);
  }
}

std::array<FragmentSensitivity, 3> fragment_sensitivity(const FragmentInput& in, const FragmentSettings& settings) {
  const std::size_t target = static_cast<std::size_t>(in.target);
  double target_mass = 0;
  for (std::size_t i = 0; i < in.size(); ++i)
    if (in.body[i] == in.target) target_mass += in.mass[i];
  std::array<FragmentSensitivity, 3> result{};
  const std::array<double, 3> factors{0.8, 1.0, 1.25};
  for (std::size_t k = 0; k < factors.size(); ++k) {
    FragmentSettings changed = settings;
    changed.linking_length *= factors[k];
    const FragmentTable table = describe_groups(in, find_groups(in, changed));
    result[k] = {changed.linking_length, table.fragments.size(), table.largest_mass(target) / target_mass,
                 target < table.dust_mass_by_body.size() ? table.dust_mass_by_body[target] / target_mass : 0.0};
  }
  return result;
}

}  // namespace ejecta
