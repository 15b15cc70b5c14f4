#include "observe/shocks.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "observe/profile.hpp"
#include "observe/solvers.hpp"

namespace ejecta {

Shocks::Shocks(const Simulation& sim, std::filesystem::path folder, Outputs& outputs,
               const std::optional<Clock>& resume_at)
    : folder_(std::move(folder)),
      outputs_(outputs),
      due_(sim.scene.row_interval(), sim.scene.output.times, resume_at),
      times_(sim.scene.output.times) {
  if (resume_at) times_.pass(resume_at->time);
}

void Shocks::observe(Simulation& sim, bool last) {
  if (times_.pass(sim.clock.time) || last)
    sim.timers.time("tables",
                    [&] { outputs_.write("lineouts", Outputs::Loss::for_good, [&] { write_lineouts(sim); }); });
  if (!due_.take(sim.clock, last)) return;
  sim.timers.time("tables", [&] { outputs_.write("shock.csv", Outputs::Loss::until_next, [&] { write_row(sim); }); });
}

void Shocks::write_row(const Simulation& sim) {
  for (const auto& package : sim.packages) {
    const auto blast = package->blast();
    if (!blast) continue;
    if (!rows_) {
      const std::array<CsvColumn, 4> columns{
          {{"time", "s"}, {"radius", "m"}, {"peak_density", "kg/m^3"}, {"peak_pressure", "Pa"}}};
      if (const auto until = due_.kept_until())
        rows_.emplace(folder_ / "shock.csv", columns, *until);
      else
        rows_.emplace(folder_ / "shock.csv", columns);
    }
    rows_->row(std::array<CsvCell, 4>{sim.clock.time, blast->radius, blast->peak_density, blast->peak_pressure});
  }
}

void Shocks::write_lineouts(const Simulation& sim) const {
  with_grid(sim, [&]<int Dim>(const Grid<Dim>& grid) {
    const Box<Dim>& box = grid.box();
    const std::array<CsvColumn, 6> columns{{{"x", "m"},
                                            {"density", "kg/m^3"},
                                            {"velocity x", "m/s"},
                                            {"pressure", "Pa"},
                                            {"specific energy", "J/kg"},
                                            {"mach", "1"}}};
    std::vector<std::vector<CsvCell>> rows;
    for (const std::size_t i : row_of_cells(grid, sim.scene)) {
      const CellState<Dim> s = grid.state(i);
      rows.push_back({box.centre(box.cell(i))[0], s.density, s.velocity[0], s.pressure, s.specific_energy,
                      s.velocity.norm() / s.sound_speed});
    }
    write_csv(folder_ / fmt::format("lineouts/lineout_{:06d}.csv", sim.clock.step), columns, rows);
  });
}

}  // namespace ejecta
