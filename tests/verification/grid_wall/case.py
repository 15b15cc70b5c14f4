"""A strong shock comes back from a wall."""
import numpy as np

from exact.riemann import Gas, ShockTube
from harness import Bound, GridCase, fall, l1, relative

GAMMA, MACH, ROWS = 1.4, 100.0, 4
START = 0.2  # m


def behind_shock():
    """Ahead of it density 1 at rest; it moves with 1 m/s (Rankine and Hugoniot)."""
    pressure = 1 / (GAMMA * MACH ** 2)
    ratio = (2 * GAMMA * MACH ** 2 - (GAMMA - 1)) / (GAMMA + 1)
    density = (GAMMA + 1) * MACH ** 2 / ((GAMMA - 1) * MACH ** 2 + 2)
    return Gas(1, 0, pressure), Gas(density, 1 - 1 / density, ratio * pressure)


class GridWall(GridCase):
    """Resolution: cells in 1 m."""
    name = "grid_wall"
    title = "a shock of Mach 100 comes back from a wall, gamma 1.4"
    exact = "Riemann problem of the gas behind the shock and its mirror image (Toro 2009, ch. 4)"
    quick = (100, 200, 400)
    full = (100, 200, 400, 800)
    ahead, driver = behind_shock()
    tube = ShockTube(driver, Gas(driver.density, -driver.velocity, driver.pressure), GAMMA)
    back = 0.3  # m, from the wall to the shock at the end
    bounds = (  # measured and 15 %
        Bound("reflected pressure", "relative", {400: 0.00041, 800: 0.00023}, 0.65),
        Bound("reflected density", "relative", {400: 0.0013, 800: 0.0011}, 0.3),
        Bound("pressure", "L1", {400: 0.0013, 800: 0.00062}, 0.85),
        Bound("density", "L1", {400: 0.0026, 800: 0.0016}, 0.7),
        Bound("shock position", "spacings", 0.039, why="a share of a spacing"),
        Bound("density at the wall", "relative", {400: 0.056, 800: 0.056}, why="the heat of the first steps stays there"),
    )

    def settings(self, resolution):
        spacing = 1 / resolution
        height, driver = ROWS * spacing, self.driver
        return {"resolution.spacing": (spacing, "m"), "time.end": (1 - START + self.back / self.tube.shock_speed(), "s"),
                "bodies.driver.size": (START, height, "m"), "bodies.gas.size": (1 - START, height, "m"),
                "bodies.driver.density": (driver.density, "kg/m^3"), "bodies.driver.pressure": (driver.pressure, "Pa"),
                "bodies.driver.velocity": (driver.velocity, 0, "m/s"), "bodies.gas.pressure": (self.ahead.pressure, "Pa"),
                "boundary.min": (0, -height / 2, "m"), "boundary.max": (1, height / 2, "m")}

    def errors(self, run, resolution):
        """On the plateau between the wall and the shock, both left out; where the shock is; beside the wall."""
        state, after = run.final, self.tube.behind(self.tube.left)
        x = 1 - state["position"][:, 0]  # from the wall
        plateau = (0.05 < x) & (x < 0.25)
        near = x < 0.4
        density = np.where(x < self.back, after.density, self.driver.density)
        pressure = np.where(x < self.back, after.pressure, self.driver.pressure)
        row = np.abs(state["position"][:, 1]) == np.abs(state["position"][:, 1]).min()
        k = np.flatnonzero(near & row)
        k = k[np.argsort(x[k])]
        place = fall(x[k], state["pressure"][k], 0.5 * (after.pressure + self.driver.pressure))
        wall = state["density"][np.argmin(x)]
        flat = state.volume[plateau]
        return {("reflected pressure", "relative"): l1(state["pressure"][plateau], after.pressure, flat) / after.pressure,
                ("reflected density", "relative"): l1(state["density"][plateau], after.density, flat) / after.density,
                ("pressure", "L1"): l1(state["pressure"][near], pressure[near], state.volume[near]) / after.pressure,
                ("density", "L1"): l1(state["density"][near], density[near], state.volume[near]) / after.density,
                ("shock position", "spacings"): abs(place - self.back) * resolution,
                ("density at the wall", "relative"): relative(wall, after.density)}

    def check_exact(self):
        ratio = ((3 * GAMMA - 1) * MACH ** 2 - 2 * (GAMMA - 1)) / ((GAMMA - 1) * MACH ** 2 + 2)
        assert abs(self.tube.pressure / self.driver.pressure / ratio - 1) < 1e-9 and abs(ratio - 8) < 0.01, ratio
        assert abs(self.tube.velocity) < 1e-12


CASES = [GridWall()]
