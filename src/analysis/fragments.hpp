#pragma once
/// Friends-of-friends fragments of the live particles: who belongs together, and what each piece carries away.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/types.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// Whole box lengths along x, y, z.
using BoxShift = Eigen::Vector3i;

/// One axis of a box; open unless the length is positive.
struct PeriodicAxis {
  double min = 0, length = 0;  ///< m
};

/// The n particles as columns, SI. Three components in 3D; in plane strain (masses per metre) the third are empty.
/// Every span holds n values; those marked optional may be empty.
struct FragmentInput {
  std::array<std::span<const double>, 3> position;   ///< m
  std::array<std::span<const double>, 3> velocity;   ///< m/s
  std::span<const double> mass, density;             ///< kg (kg/m in plane strain), kg/m^3
  std::span<const double> damage, distension;        ///< 1; optional: counts as 0 and 1
  std::span<const std::int32_t> id, body, material;  ///< >= 0; each particle has its own id

  std::span<const double> smoothing_length;  ///< m; needed only to link by a round support
  /// G = H H [1/m^2] in the order of Symmetric; all empty: H is round.
  std::array<std::span<const double>, 6> smoothing_metric;
  double nodes_per_h = 1;  ///< node spacings per smoothing length

  std::array<PeriodicAxis, 3> box;
  /// By body label: only particles of bodies with the same number can be friends; negative: a gas, which has no pieces.
  std::vector<std::int32_t> piece_of_body;
  std::int32_t target = 0;  ///< label of the body whose pieces come first in the table

  std::size_t size() const { return mass.size(); }
  int dimension() const { return position[2].empty() ? 2 : 3; }
  double particle_size(std::size_t i) const;  ///< d = (m / rho)^(1/dimension) [m]
  Vec<3> place(std::size_t i) const;          ///< m
  std::int32_t piece(std::size_t i) const { return piece_of_body[static_cast<std::size_t>(body[i])]; }
  /// x [m] moved by whole box lengths.
  Vec<3> unwrapped(const Vec<3>& x, const BoxShift& shift) const;
};

/// What any set of particles carries. Angular momentum is about the origin.
struct Carried {
  std::size_t particles = 0;
  double mass = 0;                           ///< kg
  Vec<3> momentum = Vec<3>::Zero();          ///< kg m/s
  Vec<3> angular_momentum = Vec<3>::Zero();  ///< kg m^2/s
  Carried& operator+=(const Carried& other);
};

struct Fragment {
  std::int32_t number = 0;  ///< from 1; stable in time when a tracker numbers it
  Carried carried;
  std::vector<double> mass_by_body;      ///< kg, by body label
  std::vector<double> mass_by_material;  ///< kg, by material label
  Vec<3> centre, velocity;               ///< m, m/s: of the centre of mass; in the box where that is periodic
  Vec<3> spin;                           ///< rad/s: of the rigid body with the same inertia and angular momentum
  Vec<3> semi_axes;                      ///< m, descending: of the uniform ellipsoid (2D: ellipse) of the same inertia
  Vec<3> long_axis = Vec<3>::Zero();     ///< unit vector along the first of them, its largest component positive
  double mean_damage = 0, mean_distension = 1;  ///< by mass

  /// Mass of the matter that comes from one body [kg].
  double mass_of(std::size_t label) const { return label < mass_by_body.size() ? mass_by_body[label] : 0.0; }
};

struct FragmentTable {
  std::vector<Fragment> fragments;        ///< in the order of Groups
  std::vector<std::int32_t> number;       ///< per particle: number of its fragment, 0 is dust
  Carried dust;                           ///< everything in no fragment: fragments + dust = all particles
  std::vector<double> dust_mass_by_body;  ///< kg, by body label

  /// Mass of the largest piece of a body, counting that body's matter alone [kg]; 0 if there is none.
  double largest_mass(std::size_t body) const;
};

/// Which particles belong together.
struct Groups {
  /// Of every particle: 1, 2, ... or 0 for dust. First those with most of the target's matter, among equals the
  /// heaviest.
  std::vector<std::int32_t> number;
  std::vector<BoxShift> shift;  ///< box lengths to add to a particle's place so that its group is in one piece
};

/// With b = settings.linking_length two particles of the same or of welded bodies are friends, depending on
/// settings.link,
///  - spacing: if |x_ij| < b (d_i + d_j) / 2;
///  - support: if n_h |H_i x_ij| < b or n_h |H_j x_ij| < b: nearer than b node spacings in the metric of either;
///  - automatic: by support where H is a tensor, else by spacing.
/// Distances are measured across periodic faces, too. Particles damaged to settings.damage_threshold or beyond and
/// those of gases have no friends; groups below settings.min_particles are dust.
Groups find_groups(const FragmentInput& in, const FragmentSettings& settings);

/// Adds up what every group carries.
FragmentTable describe_groups(const FragmentInput& in, Groups groups);

/// Numbers fragments so that a piece keeps its number from call to call: the pair of new group and old number that
/// shares most mass is matched first; what matches nothing gets a number never used before.
class FragmentTracker {
 public:
  /// find_groups, describe_groups and stable numbers. The order of the table stays.
  FragmentTable update(const FragmentInput& in, const FragmentSettings& settings);

  /// Goes on from the numbers of a checkpoint: `number` (0 is dust) and `id` per particle, `last_number` as it was.
  void restore(std::span<const std::int32_t> id, std::span<const std::int32_t> number, std::int32_t last_number);
  std::int32_t last_number() const { return last_number_; }
  /// Number of the fragment by id of the particle, as of the last update; dust left out.
  const std::unordered_map<std::int32_t, std::int32_t>& number_of_id() const { return number_of_id_; }

 private:
  std::vector<std::int32_t> stable_numbers(const FragmentInput& in, const FragmentTable& table);

  std::unordered_map<std::int32_t, std::int32_t> number_of_id_;  ///< of the previous call; dust left out
  std::int32_t last_number_ = 0;
};

/// How the outcome depends on the linking length.
struct FragmentSensitivity {
  double linking_length;
  std::size_t fragments;
  double largest_mass_fraction, dust_mass_fraction;  ///< matter of the target over the target's mass
};
/// At 0.8, 1 and 1.25 times settings.linking_length.
std::array<FragmentSensitivity, 3> fragment_sensitivity(const FragmentInput& in, const FragmentSettings& settings);

}  // namespace ejecta
