#include "observe/shocks.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "observe/solvers.hpp"

namespace ejecta {

Shocks::Shocks(const Simulation& sim, std::filesystem::path folder, std::optional<double> resume_at)
    : folder_(std::move(folder)),
      resume_at_(resume_at),
      interval_(is_set(sim.scene.output.history_interval) ? sim.scene.output.history_interval : sim.scene.time_end / 200),
      times_(sim.scene.output.times) {
  if (!resume_at) return;
  while (next_ <= *resume_at) next_ += interval_;
  times_.pass(*resume_at);
}

void Shocks::observe(Simulation& sim, bool last) {
  const bool asked = times_.pass(sim.clock.time);
  if (asked || last) sim.timers.time("tables", [&] { write_lineouts(sim); });
  if (sim.clock.time < next_ && !asked && !last) return;
  while (next_ <= sim.clock.time) next_ += interval_;
  sim.timers.time("tables", [&] { write_row(sim); });
}

void Shocks::write_row(const Simulation& sim) {
  for (const auto& package : sim.packages) {
    const auto blast = package->blast();
    if (!blast) continue;
    if (!rows_) {
      const std::array<CsvColumn, 4> columns{
          {{"time", "s"}, {"radius", "m"}, {"peak_density", "kg/m^3"}, {"peak_pressure", "Pa"}}};
      if (resume_at_)
        rows_.emplace(folder_ / "shock.csv", columns, *resume_at_);
      else
        rows_.emplace(folder_ / "shock.csv", columns);
    }
    rows_->row(std::array<CsvCell, 4>{sim.clock.time, blast->radius, blast->peak_density, blast->peak_pressure});
  }
}

void Shocks::write_lineouts(const Simulation& sim) const {
  with_grid(sim, [&]<int Dim>(const Grid<Dim>& grid) {
    const Box<Dim>& box = grid.box();
    std::array<int, Dim> cell{};
    for (std::size_t a = 1; a < Dim; ++a) {
      const double charge = sim.scene.charge ? (sim.scene.charge->center[a] - box.corner[static_cast<int>(a)]) / box.spacing
                                             : 0.5 * box.cells[a];
      cell[a] = std::clamp(static_cast<int>(std::floor(charge)), 0, box.cells[a] - 1);
    }
    const std::array<CsvColumn, 6> columns{{{"x", "m"}, {"density", "kg/m^3"}, {"velocity x", "m/s"}, {"pressure", "Pa"},
                                            {"specific energy", "J/kg"}, {"mach", "1"}}};
    std::vector<std::vector<CsvCell>> rows;
    for (cell[0] = 0; cell[0] < box.cells[0]; ++cell[0]) {
      const CellState<Dim> s = grid.state(box.index(cell));
      rows.push_back({box.centre(cell)[0], s.density, s.velocity[0], s.pressure, s.specific_energy,
                      s.velocity.norm() / s.sound_speed});
    }
    std::filesystem::create_directories(folder_ / "lineouts");
    write_csv(folder_ / fmt::format("lineouts/lineout_{:06d}.csv", sim.clock.step), columns, rows);
  });
}

}  // namespace ejecta
