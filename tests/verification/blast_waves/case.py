"""Two blast waves that meet between walls (Woodward & Colella 1984)."""
import numpy as np

from exact.finite_volume import two_blast_waves
from harness import Bound, Case, binned, l1, relative

ROWS = 12
CELLS = 1600  # of the reference; it differs by 0.017, 0.025 and 0.42 in L1 from that of twice as many


class BlastWaves(Case):
    """Resolution: particles in the 1 m between the walls."""
    name = "blast_waves"
    title = "two blast waves, gamma 1.4, t = 0.038 s"
    exact = "none in closed form: MUSCL-Hancock scheme with 1600 cells, itself good to 0.03, 0.05, 0.8 (L1)"
    quick = (50, 100, 200)
    full = (50, 100, 200, 400, 800)
    rotation = "the lattice is hexagonal, which is not the same along x and y"
    boost = "y"
    bounds = (
        Bound("density", "L1", {100: 0.145, 200: 0.087, 400: 0.07}, 0.5,
              why="two shocks melt the lattice, and the gas beside the contact at 0.76 m mixes"),
        Bound("velocity", "L1", {100: 0.9, 200: 0.5, 400: 0.265}, 0.7),
        Bound("pressure", "L1", {100: 14, 200: 7.6, 400: 5.7}, 0.7, why="5.0 at 400 and 2.8 at 800: in between the melted gas takes its time"),
        Bound("peak density", "relative", 0.25, why="the narrow peak between two contacts"),
    )
    boost_speed = 10.0

    def settings(self, resolution):
        spacing = 1 / resolution
        height = ROWS * spacing
        sizes = {"left": 0.1, "middle": 0.8, "right": 0.1}
        return {"resolution.spacing": (spacing, "m"),
                **{f"bodies.{name}.size": (length, height, "m") for name, length in sizes.items()},
                "boundary.min": (0, -height / 2, "m"), "boundary.max": (1, height / 2, "m")}

    def errors(self, run, resolution):
        state, (x, *reference) = run.final, two_blast_waves(CELLS)
        place = state["position"][:, 0]
        values = state["density"], state["velocity"][:, 0], state["pressure"]
        errors = {(name, "L1"): l1(value, np.interp(place, x, exact), state.volume)
                  for name, value, exact in zip(("density", "velocity", "pressure"), values, reference)}
        _, density = binned(place, state["density"], 1 / resolution)
        errors["peak density", "relative"] = relative(density.max(), reference[0].max())
        return errors


CASES = [BlastWaves()]
