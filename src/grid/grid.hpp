#pragma once
/// Finite volumes on cubic cells: one fluid in a box.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grid/tile_sweep.hpp"
#include "material/material.hpp"
#include "model/package.hpp"
#include "reference/charge_start.hpp"
#include "scene/scene.hpp"

namespace ejecta {

/// Largest values at the start.
struct GridOutset {
  double density = 0;   ///< kg/m^3
  double pressure = 0;  ///< of the state or of what rams it: rho u^2, of a liquid rho u c [Pa]
  double speed = 0;     ///< m/s
  double mach = 0;      ///< u/c
};

template <int Dim>
class Grid final : public Package {
 public:
  /// Cells filled by the bodies of the scene. Throws InputError if the scene asks for what a grid cannot do.
  Grid(const Scene& scene, const std::vector<Material>& materials)
      : Grid(scene, materials, charge_start(scene, materials)) {}

  std::string_view name() const override { return "grid"; }
  Vote vote() override;
  void advance(double dt) override;
  void check_health() const override {}  // every step is judged before it is taken
  Totals conserved() const override;
  Kept kept() const override { return {.momentum = true, .angular_momentum = false}; }
  bool is_loaded() const override { return true; }  // by the faces of the box
  void persist(Archive& archive) override;
  Quantities quantities() const override;
  std::string outline() const override;
  std::vector<Remark> remarks() const override;
  std::vector<std::string> channel_names() const override { return {"grid"}; }
  std::vector<Channel> channels(const Asked& asked) const override;
  std::string describe(std::size_t cell) const override;
  Whereabouts whereabouts(std::size_t cell) const override;
  std::string_view element() const override { return "cell"; }
  std::size_t elements() const override { return box_.size(); }
  double element_steps() const override { return cell_steps_; }
  std::size_t bytes() const override;

  const Scene& scene() const { return scene_; }
  const Material& material() const { return material_; }
  const Box<Dim>& box() const { return box_; }
  CellState<Dim> state(std::size_t cell) const { return cell_state<Dim>(material_.eos, now_, cell); }
  /// State at a point [m]: that of its cell; beyond faces that grow that of the gas, else nothing.
  std::optional<CellState<Dim>> at(const Vec<Dim>& x) const;
  CellState<Dim> ambient() const;  ///< of [gas]
  const GridOutset& outset() const { return outset_; }
  const Conserved<Dim>& cells() const { return now_; }
  /// From now on also those tiles in which nothing can change: for tests.
  void sweep_all_tiles() { skips_quiet_ = false; }
  std::optional<BlastFront> blast() const override;
  /// All of its quantities but those of a blast.
  Quantities quantities_of_cells() const;
  /// Pressure at a point [Pa], linear between the centres of cells; nothing beyond the box.
  std::optional<double> pressure_at(const Vec<Dim>& x) const;
  /// Lets the box grow if a wave comes near its faces, as every step does first.
  void make_room();
  /// Changes what cells hold, between steps: mass, momentum and energy per volume.
  void put(const std::vector<std::size_t>& cells, const std::vector<std::array<double, Dim + 2>>& values);

 private:
  Grid(const Scene& scene, const std::vector<Material>& materials, const std::optional<RadialState>& start);
  struct TileState {
    Tile<Dim> tile;
    bool uniform = false;  ///< all cells the same state
    bool behind = true;    ///< next_ does not hold what now_ does
    double fastest = 0;    ///< m/s
    std::size_t where = 0;
    std::array<double, Dim + 2> outflow{};  ///< in the last step
  };

  void cut_tiles();
  void look(std::size_t tile);
  /// Whether nothing can change in a tile: it and all around it are one state.
  bool is_quiet(std::size_t tile) const;
  bool is_ambient(const Tile<Dim>& tile, std::size_t axis, int low, int high) const;
  /// One step, or two halves of it, and so on, where densities or energies would not stay positive.
  void step(double dt, int halvings);
  bool try_step(double dt);
  void sweep_tiles(const std::vector<std::size_t>& tiles, double dt, std::span<const std::uint8_t> flagged,
                   std::vector<std::size_t>& bad);
  std::vector<std::size_t> around(const std::vector<std::size_t>& cells) const;
  std::array<double, Dim + 2> cell(std::size_t i) const;
  std::array<double, Dim + 2> uniform_outflow(const TileState& tile, double dt) const;

  GridOutset outset_;
  Scene scene_;
  Material material_;
  GridSettings settings_;
  Box<Dim> box_;
  Conserved<Dim> now_, next_;
  std::array<double, Dim + 2> ambient_{};  ///< what a growing box is filled with
  std::vector<TileState> tiles_;
  std::array<int, Dim> tile_counts_{};
  mutable std::vector<OwnedField> shown_;  ///< what the channel is made of besides the columns
  std::vector<std::unique_ptr<TileSweep<Dim>>> sweeps_;  ///< one a thread
  bool skips_quiet_ = true;
  double free_step_ = 0;    ///< the last step that its votes would have allowed [s]; 0: none yet
  double cell_steps_ = 0;   ///< cells that have been advanced, all steps added
  double first_order_ = 0;  ///< cells that have passed fluxes of first order, all steps added
};

}  // namespace ejecta
