#pragma once
/// A grid everywhere, and particles where fronts are.
///
/// The grid owns all mass, momentum and energy. Where a front is, its cells are filled with particles twice as fine or
/// more, which are carried on by the Riemann fluxes of gsph in steps of their own within each step of the grid; around
/// them a belt of particles moves with the gas of the grid. Afterwards the cells that particles fill are led to what
/// those say, by fluxes that take from one cell what they give to the next (flux_correction.hpp): whatever the
/// particles do, nothing is lost. Particles come into being from what the grid holds, and vanish without leaving a
/// trace in the ledger. Solid bodies (solids.hpp) always have such gas around them.
#include <functional>
#include <memory>
#include <optional>

#include "hybrid/flux_correction.hpp"
#include "hybrid/particles_by_cell.hpp"
#include "hybrid/solids.hpp"
#include "sph/sph.hpp"

namespace ejecta {

template <int Dim>
class Hybrid final : public Package {
 public:
  /// Throws InputError if the scene asks for what a grid or Riemann particles cannot do.
  Hybrid(const Scene& scene, const std::vector<Material>& materials);

  std::string_view name() const override { return "hybrid"; }
  Vote vote() override { return grid_.vote(); }
  void advance(double dt) override;
  void check_health() const override {}
  Totals conserved() const override;
  Kept kept() const override;
  bool is_loaded() const override { return true; }
  void persist(Archive& archive) override;
  std::vector<Package*> parts() override;
  Quantities quantities() const override;
  std::string outline() const override;
  std::vector<Remark> remarks() const override { return grid_.remarks(); }
  std::vector<std::string> channel_names() const override { return grid_.channel_names(); }
  std::vector<Channel> channels(const Asked& asked) const override;
  std::string describe(std::size_t cell) const override { return grid_.describe(cell); }
  Whereabouts whereabouts(std::size_t cell) const override { return grid_.whereabouts(cell); }
  std::optional<BlastFront> blast() const override;
  std::size_t elements() const override;
  double element_steps() const override { return grid_.element_steps() + particle_steps_; }
  std::size_t bytes() const override;

  const Grid<Dim>& grid() const { return grid_; }
  /// Those of the gas, the images of solids among them.
  const Sph<Dim>& particles() const { return *particles_; }
  const Solids<Dim>* solids() const { return solids_ ? &*solids_ : nullptr; }
  const Zone<Dim>& zone() const { return zone_; }
  /// From now on particles move freely where inside(centre of a cell) says so, and nowhere else: for tests.
  void hold_zone(const std::function<bool(const Vec<Dim>&)>& inside);
  /// Pressure at a point [Pa], a mean over the particles near it where they move freely; nothing beyond the box. Of the
  /// state at the last call of look().
  std::optional<double> pressure_at(const Vec<Dim>& x) const;
  /// State at a point: that of the nearest particle where they move freely, else that of the grid; nothing beyond the
  /// box and in solids. Of the state at the last call of look().
  std::optional<CellState<Dim>> at(const Vec<Dim>& x) const;
  /// The particle of a solid at a point; nothing in gas. Of the state at the last call of look().
  std::optional<std::size_t> solid_at(const Vec<Dim>& x) const;
  /// Sorts particles into cells, for questions about points.
  void look() const;

 private:
  /// The particle nearest to a point, in cells that follow their particles.
  std::optional<std::size_t> nearest(const Vec<Dim>& x) const;
  std::vector<Stage<Dim>> stages(const std::vector<Material>& materials) const;
  void lay_particles(const std::vector<Material>& materials);
  Part part_at(const Vec<Dim>& x) const;
  /// What the grid says at a particle now.
  PointState<Dim> led_state(std::size_t particle) const;
  void lead_motion(Sph<Dim>& sph) const;
  void lead_state(Sph<Dim>& sph) const;
  void lead_gas(Sph<Dim>& sph) const;
  void lead_rest(Sph<Dim>& sph) const;
  std::vector<std::size_t> cells_of(bool only_active) const;
  std::vector<std::size_t> cells_of_solids() const;
  void check_room(std::size_t solid) const;
  void move_zone();
  void remove_outside();
  void fill_holes(const std::vector<Part>& before);
  void substeps(double dt, std::vector<SolidShare<Dim>>& solids, const std::vector<std::int32_t>& place);
  void follow_particles(const std::vector<std::size_t>& active, const std::vector<std::int32_t>& place,
                        std::vector<SolidShare<Dim>>& solids);

  Scene scene_;
  HybridSettings settings_;
  Grid<Dim> grid_;
  Zone<Dim> zone_;
  std::optional<Solids<Dim>> solids_;
  std::unique_ptr<Sph<Dim>> particles_;
  std::vector<double> laid_density_;              ///< by id, until the first particles have their masses [kg/m^3]
  std::optional<CellLines<Dim>> before_, after_;  ///< the grid at the ends of the present step
  double began_ = 0, span_ = 0;                   ///< of that step [s]
  double particle_steps_ = 0;                     ///< particles that have been advanced, all steps added
  mutable ParticlesByCell<Dim> by_cell_;
  mutable std::vector<std::uint32_t> solid_of_id_;  ///< places of solid particles, by id; for views
  mutable std::vector<double> shown_zone_;
  std::vector<std::int32_t> saved_zone_;  ///< what an archive is shown must outlive it
};

}  // namespace ejecta
