"""Shock tubes on a grid: those of the particles, measured alike, and the five tests of Toro (2009)."""
import numpy as np

from blast_waves.case import BlastWaves
from exact.riemann import Gas, ShockTube
from harness import Bound, GridCase, l1
from leblanc.case import LeBlanc
from sod.case import Sod

ROWS = 4


class Tube(GridCase):
    """Settings of a tube with ends at x = low and high [m] and `cells` between them."""
    scene = "scene.toml"
    ends = "open"
    low, high = -0.5, 0.5

    def cells(self, resolution):
        return resolution

    def settings(self, resolution):
        spacing = (self.high - self.low) / self.cells(resolution)
        height, tube = ROWS * spacing, self.tube
        settings = {"resolution.spacing": (spacing, "m"), "time.end": (self.time, "s"), "boundary.x": self.ends,
                    "materials.gas.eos.gamma": tube.gamma,
                    "boundary.min": (self.low, -height / 2, "m"), "boundary.max": (self.high, height / 2, "m")}
        for name, gas, length in (("left", tube.left, -self.low), ("right", tube.right, self.high)):
            settings |= {f"bodies.{name}.center": ((-1 if name == "left" else 1) * length / 2, 0, "m"),
                         f"bodies.{name}.size": (length, height, "m"), f"bodies.{name}.density": (gas.density, "kg/m^3"),
                         f"bodies.{name}.velocity": (gas.velocity, 0, "m/s"),
                         f"bodies.{name}.pressure": (gas.pressure, "Pa")}
        return settings


class GridSod(Tube, Sod):
    """Resolution: cells in half of the tube."""
    name = "grid_sod"
    title = "Sod's shock tube on a grid (Toro's test 1), t = 0.2 s"
    quick = (100, 200, 400)
    full = (50, 100, 200, 400, 800)
    time = 0.2
    bounds = (  # measured and 15 %
        Bound("density", "L1", {400: 0.00073, 800: 0.00039}, 0.75),
        Bound("velocity", "L1", {400: 0.0013, 800: 0.00044}, 0.75),
        Bound("pressure", "L1", {400: 0.00042, 800: 0.0002}, 0.85),
        Bound("shock position", "spacings", 0.12, why="a share of a spacing"),
        Bound("contact position", "spacings", 0.23, why="a share of a spacing"),
    )

    def cells(self, resolution):
        return 2 * resolution


class Toro(Tube):
    """Resolution: cells in the tube of 1 m."""
    exact = "Riemann problem (Toro 2009, Table 4.1, numbers of Table 4.2)"
    quick = (100, 200, 400)
    full = (100, 200, 400, 800, 1600)

    def errors(self, run, resolution):
        state = run.final
        x = state["position"][:, 0]
        density, velocity, pressure = self.tube.at(x / state.time)
        energy = pressure / density / (self.tube.gamma - 1)
        pairs = {"density": (state["density"], density), "velocity": (state["velocity"][:, 0], velocity),
                 "pressure": (state["pressure"], pressure), "energy": (state["specific_energy"], energy)}
        return {(name, "L1"): l1(value, exact, state.volume) for name, (value, exact) in pairs.items()}

    def profiles(self, run):
        state, x = run.final, run.final["position"][:, 0]
        values = state["density"], state["velocity"][:, 0], state["pressure"]
        labels = "density [kg/m^3]", "velocity [m/s]", "pressure [Pa]"
        return [(label, x, value, exact) for label, value, exact in zip(labels, values, self.tube.at(x / state.time))]

    def check_exact(self):
        left, right = self.tube.behind(self.tube.left), self.tube.behind(self.tube.right)
        found = self.tube.pressure, self.tube.velocity, left.density, right.density
        assert np.allclose(found, self.printed, rtol=2e-5, atol=1e-5), found


class Sonic(Toro):
    name = "grid_toro_1"
    title = "Toro's test 1 of chapter 6: a rarefaction that is sonic at the wall, t = 0.2 s"
    tube = ShockTube(Gas(1, 0.75, 1), Gas(0.125, 0, 0.1), 1.4)
    low, high, time = -0.3, 0.7, 0.2
    bounds = (  # measured and 15 %
        Bound("density", "L1", {400: 0.0017, 1600: 0.00054}, 0.75),
        Bound("velocity", "L1", {400: 0.003, 1600: 0.00066}, 0.75),
        Bound("pressure", "L1", {400: 0.00091, 1600: 0.00024}, 0.8),
        Bound("energy", "L1", {400: 0.0094, 1600: 0.0032}, 0.8),
    )

    def check_exact(self):
        """The rarefaction spreads over the place of the wall, where the flow is sonic."""
        density, velocity, pressure = self.tube.at(np.zeros(1))
        assert abs(velocity - np.sqrt(1.4 * pressure / density)) < 1e-12


class Apart(Toro):
    name = "grid_toro_2"
    title = "Toro's test 2: gases part and leave next to nothing, t = 0.15 s"
    tube = ShockTube(Gas(1, -2, 0.4), Gas(1, 2, 0.4), 1.4)
    printed = 0.00189, 0.0, 0.02185, 0.02185
    time = 0.15
    bounds = (  # measured and 15 %
        Bound("density", "L1", {400: 0.0017, 1600: 0.00087}, 0.75),
        Bound("velocity", "L1", {400: 0.012, 1600: 0.006}, why="the first steps heat the middle"),
        Bound("pressure", "L1", {400: 0.00088, 1600: 0.00023}, 0.95),
        Bound("energy", "L1", {400: 0.026, 1600: 0.0078}, 0.65),
    )


class LeftBlast(Toro):
    name = "grid_toro_3"
    title = "Toro's test 3: pressures of 100 000 : 1, t = 0.012 s"
    tube = ShockTube(Gas(1, 0, 1000), Gas(1, 0, 0.01), 1.4)
    printed = 460.894, 19.5975, 0.57506, 5.99924
    time = 0.012
    bounds = (  # measured and 15 %
        Bound("density", "L1", {400: 0.037, 1600: 0.012}, 0.85),
        Bound("velocity", "L1", {400: 0.082, 1600: 0.018}, 1.05),
        Bound("pressure", "L1", {400: 1.6, 1600: 0.37}, 1.05),
        Bound("energy", "L1", {400: 15, 1600: 4.9}, 0.8),
    )


class RightBlast(Toro):
    name = "grid_toro_4"
    title = "Toro's test 4: pressures of 1 : 10 000, t = 0.035 s"
    tube = ShockTube(Gas(1, 0, 0.01), Gas(1, 0, 100), 1.4)
    printed = 46.0950, -6.19633, 5.99242, 0.57511
    time = 0.035
    bounds = (  # measured and 15 %
        Bound("density", "L1", {400: 0.038, 1600: 0.013}, 0.75),
        Bound("velocity", "L1", {400: 0.03, 1600: 0.009}, 0.85),
        Bound("pressure", "L1", {400: 0.18, 1600: 0.055}, 0.85),
        Bound("energy", "L1", {400: 1.6, 1600: 0.51}, 0.75),
    )


class Meeting(Toro):
    name = "grid_toro_5"
    title = "Toro's test 5: two shocks meet, t = 0.035 s"
    tube = ShockTube(Gas(5.99924, 19.5975, 460.894), Gas(5.99242, -6.19633, 46.0950), 1.4)
    printed = 1691.64, 8.68975, 14.2823, 31.0426
    time = 0.035
    bounds = (  # measured and 15 %
        Bound("density", "L1", {400: 0.14, 1600: 0.058}, 0.65),
        Bound("velocity", "L1", {400: 0.031, 1600: 0.02}, 0.6),
        Bound("pressure", "L1", {400: 4.7, 1600: 2.8}, 0.4),
        Bound("energy", "L1", {400: 1.3, 1600: 0.53}, 0.65),
    )


class GridLeBlanc(Tube, LeBlanc):
    """Resolution: cells along the tube of 9 m."""
    name = "grid_leblanc"
    title = "LeBlanc's shock tube on a grid, t = 6 s"
    quick = (120, 240, 480)
    full = (120, 240, 480, 960, 1920)
    ends, low, high, time = "reflecting", -3, 6, 6
    bounds = (  # measured and 15 %
        Bound("density", "L1", {480: 0.00091, 1920: 0.00024}, 0.8),
        Bound("velocity", "L1", {480: 0.011, 1920: 0.0027}, 0.7),
        Bound("pressure", "L1", {480: 3.5e-05, 1920: 8.5e-06}, 0.9),
        Bound("logarithm of density", "L1", {480: 0.054, 1920: 0.015}, 0.65),
        Bound("shock position", "relative", {480: 0.028, 1920: 0.0071}, 0.55),
        Bound("negative energy", "relative", 1e-12, why="there is none"),
    )


class GridBlastWaves(GridCase, BlastWaves):
    """Resolution: cells in the 1 m between the walls."""
    name = "grid_blast_waves"
    title = "two blast waves on a grid, t = 0.038 s"
    scene = "blast_waves.toml"
    quick = (100, 200, 400)
    full = (100, 200, 400, 800)
    rotation = True
    bounds = (  # measured and 15 %
        Bound("density", "L1", {400: 0.08, 800: 0.026}, 0.75),
        Bound("velocity", "L1", {400: 0.14, 800: 0.032}, 0.85),
        Bound("pressure", "L1", {400: 1.9, 800: 0.55}, 0.85),
        Bound("peak density", "relative", {400: 0.15, 800: 0.047}, 0.5),
    )

    def settings(self, resolution):
        spacing = 1 / resolution
        height = ROWS * spacing
        return {"resolution.spacing": (spacing, "m"),
                **{f"bodies.{name}.size": (length, height, "m") for name, length in
                   {"left": 0.1, "middle": 0.8, "right": 0.1}.items()},
                "boundary.min": (0, -height / 2, "m"), "boundary.max": (1, height / 2, "m")}


CASES = [GridSod(), Sonic(), Apart(), LeftBlast(), RightBlast(), Meeting(), GridLeBlanc(), GridBlastWaves()]
