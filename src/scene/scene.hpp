#pragma once
/// What a scene file asks for, checked and in SI. Plain values with their defaults: `describe.cpp` says the unit, the
/// range and the meaning of each, and the same text reads, checks, echoes and documents them.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/blast.hpp"
#include "scene/body_shape.hpp"
#include "scene/boundary.hpp"
#include "scene/choices.hpp"
#include "scene/detonator.hpp"
#include "scene/document.hpp"
#include "scene/probe.hpp"
#include "scene/section.hpp"

namespace ejecta {

enum class SchemeKind { sph, asph, fvm, gsph, agsph, hybrid };
enum class DensityMethod { continuity, summation };
enum class Lattice { cubic, hexagonal, glass };
enum class BodyLattice { of_scene, cubic, hexagonal, glass, shells };
enum class OnError { warn, disable, abort };
enum class Switch { automatic, off, on };
enum class FragmentLink { automatic, spacing, support };

/// Formulas that replace the uniform values of a body at the start (formula.hpp says of what). Empty: none.
struct Profile {
  std::vector<std::string> displacement;       ///< m; Dim components: particles leave their lattice places, masses stay
  std::vector<std::string> velocity;           ///< m/s; Dim components
  std::vector<std::string> deviatoric_stress;  ///< Pa; in the order of base/types.hpp
  std::string density, pressure, specific_energy;  ///< kg/m^3, Pa (gas only), J/kg
};

/// One solid or gas body, filled with particles at set-up. Later bodies do not displace earlier ones.
struct Body {
  std::string name;
  std::string material;  ///< name of inputs/materials/<material>.toml
  BodyShape shape = BodyShape::sphere;
  Triple center{0, 0, 0};                       ///< m
  double radius = unset;                        ///< m; sphere, disc, cylinder
  double inner_radius = 0;                      ///< m; of the hole in them
  Triple size{unset, unset, unset};             ///< m; box: full edge lengths
  double length = unset;                        ///< m; cylinder
  Triple axis{0, 0, 1};                         ///< cylinder axis
  Triple velocity{0, 0, 0};                     ///< m/s
  double density = unset;                       ///< kg/m^3; default: the material's reference bulk density
  double pressure = unset;                      ///< Pa; gas bodies: sets the specific energy
  double specific_energy = 0;                   ///< J/kg; used where pressure is not given
  double spacing_factor = 1;                    ///< particle spacing relative to resolution.spacing
  BodyLattice lattice = BodyLattice::of_scene;  ///< how its particles are laid
  double aspect = 1;                            ///< of shells: edge of a particle along its shell over that across
  std::string origin;                           ///< where the scene says so: "inputs/x.toml:14"
  std::string weld = "auto";                    ///< body it is one piece with; none; auto: see describe.cpp
  bool driven = false;                          ///< keeps its velocity whatever pulls at it, and never breaks
  double jitter = 0;                            ///< random displacement along each axis, up to this many spacings
  Profile profile;
  bool implied = false;  ///< follows from [charge] or [gas], and is not echoed
};

/// Diameter, edges, length [m]: those that the shape of a body has, not a number where it is not set.
std::vector<double> widths(const Body& body, int dimension);

struct Numerics {
  /// Smoothing tensors; fluxes of Riemann problems.
  bool tensors() const { return scheme == SchemeKind::asph || scheme == SchemeKind::agsph; }
  bool godunov() const {
    return scheme == SchemeKind::gsph || scheme == SchemeKind::agsph || scheme == SchemeKind::hybrid;
  }
  /// Whether all matter is on a grid, perhaps with particles besides.
  bool on_grid() const { return scheme == SchemeKind::fvm || scheme == SchemeKind::hybrid; }
  bool conducts() const { return linear_conduction > 0 || quadratic_conduction > 0; }
  /// What damps a difference of velocities, as coefficients of Monaghan's viscosity. A Riemann problem between like
  /// gases has p* - p = rho u (c + (gamma + 1)/4 u), u half of what they close by [Toro 2009, sect. 3.1.3].
  double damping_alpha() const { return godunov() ? 1 : viscosity_alpha; }
  double damping_beta() const { return godunov() ? 1 : viscosity_beta; }

  SchemeKind scheme = SchemeKind::sph;
  Kernel kernel = Kernel::wendland_c2;
  Precision precision = Precision::double_precision;
  DensityMethod density = DensityMethod::continuity;
  double nodes_per_h = 1.3;       ///< n_h of Owen (2010): particles per smoothing length
  double smoothing_growth = 1.5;  ///< h stays within [1/4, this] of its initial value; 1 keeps h constant
  double largest_aspect = 10;     ///< ASPH: longest over shortest axis of the smoothing ellipsoid
  int shape_interval = 10;        ///< ASPH: steps between votes on the shape of H; between them it moves with the flow
  Switch gradient_correction = Switch::automatic;  ///< gradients exact for linear fields, and forces their adjoint
  Switch balsara = Switch::off;                    ///< shear switch on the viscosity
  Switch shock_switch = Switch::automatic;         ///< no viscosity in smooth flow
  Switch bonds = Switch::automatic;                ///< elastic matter holds on to the neighbours of the start
  double viscosity_alpha = 1;                      ///< linear coefficient of Monaghan's viscosity
  double viscosity_beta = 2;                       ///< quadratic coefficient
  PairRiemann riemann = PairRiemann::approximate;  ///< GSPH: between two particles
  PairLimiter limiter = PairLimiter::monotonised_central;  ///< GSPH: of the states brought to the middle of a pair
  PairFaces faces = PairFaces::renormalised;               ///< GSPH: what the flux of a pair goes through
  Switch fill_space = Switch::automatic;                   ///< GSPH: summed volumes are moved until they fill space
  double pilot_width = unset;  ///< GSPH: of the pilot density that h follows [h]; else neighbours are counted
  double linear_conduction = 0, quadratic_conduction = 0;  ///< GSPH: g1, g2 of the artificial conduction
  double courant = 0.4;
  DistensionSolver distension_solver = DistensionSolver::safe_newton;
  double distension_tolerance = 1e-12;
  double max_energy_drift = 0.05;  ///< run ends with an error beyond this relative drift of total energy
};

/// A colour range that stays fixed from the first frame to the last.
struct ColourRange {
  double min, max;
};

/// Stands for the default set among insitu.pipelines.
inline constexpr std::string_view default_pipelines_name = "default";

/// Stands for frames dense at first as insitu.times.
inline constexpr std::string_view dense_early_word = "dense early";

/// What bodies and walls do where they touch.
struct Contact {
  double friction = 0;  ///< coefficient
};

/// A Catalyst script, what it is told, and when it is asked.
struct Pipeline {
  std::string script;             ///< a path, or "default" for the default ones
  std::vector<std::string> args;  ///< catalyst.get_args() of the script
  std::string every;  ///< as parse_every() reads it; empty: with the frames, or when its own triggers say so
  bool operator==(const Pipeline&) const = default;
};

/// When the frames are drawn: at these times, or as many as insitu.frames says, equally spaced or dense at first.
struct FrameTimes {
  std::vector<double> list;  ///< s
  bool dense_early = false;
};

struct InSitu {
  bool enabled = true;
  int frames = 60;                  ///< in simulated time, first and last included
  FrameTimes times;                 ///< of the frames
  std::vector<std::string> every;   ///< more frames, as parse_every() reads it
  std::vector<std::string> events;  ///< more frames when one of event_words happens
  int burst = 4;                    ///< frames after that of an event
  std::vector<Pipeline> pipelines;  ///< empty: the default ones
  bool column_density = false;      ///< also draw the mass per area seen along y
  OnError on_error = OnError::warn;
  double max_share = 0.15;  ///< frames are left out where in-situ work would exceed this share of the wall time
  int image_width = 1920, image_height = 1080;
  Triple view_center{unset, unset, unset};  ///< m; default: centre of the bodies at rest
  double view_size = unset;    ///< m; visible width at least; default: 1.6 times the extent of the slowest body
  double view_height = unset;  ///< m; visible height at least; default: view_size
  std::map<std::string, ColourRange> ranges;  ///< field name -> fixed colour range in SI
};

/// What the figures of fragments show beside those computed: how a wall that stretches breaks
/// (analysis/fragment_theory.hpp). Lists of numbers are one value, or the ends of a range.
struct FragmentTheory {
  double strain_rate = unset;           ///< 1/s; when it breaks
  double thickness = unset;             ///< m; of the wall then
  std::vector<double> fracture_energy;  ///< J/m^2; empty: no prediction by Grady and Kipp
  std::vector<double> flow_stress;      ///< Pa; empty: none by Mott
  std::vector<double> mott_gamma;       ///< 1 over the scatter of the strain at fracture

  bool any() const { return !fracture_energy.empty() || !flow_stress.empty(); }
};

struct FragmentSettings {
  bool enabled = false;
  FragmentLink link = FragmentLink::automatic;  ///< automatic: support in ASPH, else spacing
  double linking_length =
      1.4;  ///< spacing: in mean particle sizes (m/rho)^(1/Dim); support: in h / nodes_per_h along each axis
  double damage_threshold = 0.99;  ///< particles damaged beyond this link to nothing (dust)
  int min_particles = 8;           ///< smaller groups count as dust
  std::string target;              ///< body whose pieces count; empty: the body struck (sph/outset.hpp)
  std::string measured;            ///< CSV file of measured masses, for the figure; absolute once read
  FragmentTheory theory;
};

struct OutputSettings {
  double history_interval = unset;   ///< s of simulated time; default: end/200
  double checkpoint_interval = 600;  ///< s of wall time; not set: only at the end
  double checkpoint_every = unset;   ///< s of simulated time; not set: by wall time alone
  int checkpoints_kept = 2;          ///< the newest ones
  int snapshots = 0;                 ///< full HDF5 dumps, equally spaced in time; 0: none
  std::vector<double> times;         ///< s; steps end there, with a frame, rows of the tables and a full dump
  bool peaks = false;                ///< particles remember their extremes and where they come from
};

struct Scene {
  std::string file;  ///< path of the scene file
  std::string name, title;
  int dimension = 3;
  double spacing = unset;  ///< m
  Lattice lattice = Lattice::cubic;
  double time_end = unset;                ///< s
  std::optional<std::int64_t> max_steps;  ///< not set: no limit
  std::vector<Body> bodies;
  std::vector<Detonator> detonators;
  std::optional<Charge> charge;  ///< among the bodies too
  std::optional<Gas> gas;        ///< the last of the bodies too
  Numerics numerics;
  Boundary boundary;
  Contact contact;
  InSitu insitu;
  FragmentSettings fragments;
  std::vector<Probe> probes;
  OutputSettings output;
  std::map<std::string, Document> materials;  ///< material name -> values that replace those of its file
  std::map<std::string, std::shared_ptr<SectionSettings>> sections;  ///< of packages, by name: those in the file
  std::optional<int> threads;                                        ///< not set: all cores
  std::uint64_t seed = 1;

  /// Time between rows of the tables [s].
  double row_interval() const { return is_set(output.history_interval) ? output.history_interval : time_end / 200; }
};

}  // namespace ejecta
