"""Copper driven by PBX 9501: the shipped cylinder test and the shell, against experiment and Gurney's formula."""
import numpy as np

from exact.jwl import gurney_speed
from harness import Bound, Case, relative
from harness.run import SOURCE

EXPLOSIVE, COPPER, ROOT_2E = 1840, 8930, 2900  # kg/m^3, kg/m^3, m/s: of PBX 9501, Martineau (1998)
BORE, READ_AT = 50.8e-3, 30e-6  # radius [m]; the plateau is said to be there after 25 to 30 us
MEASURED = {2.54: (2750, 2800), 5.08: (2300, 2350)}  # m/s, by the thickness of the wall in mm; LA-13424-T


def speed_of(run, name, state):
    """Mean speed of the case outwards [m/s]."""
    of = run.body(name, state)
    x, v, m = state["position"][of], state["velocity"][of], state["mass"][of]
    return float(np.sum(m * np.sum(x * v, axis=1) / np.linalg.norm(x, axis=1)) / m.sum())


class Cylinder(Case):
    """Resolution: particles through the wall."""
    exact = "experiment and computations beside it (LA-13424-T), and Gurney's cylinder"
    boost = "planes of symmetry"
    mixed_margin = "two figures, whose errors pass through zero"
    bounds = (
        Bound("speed at 30 us, of the experiment", "relative", 0.03, why="3 % is asked: two figures, no order"),
        Bound("speed at 40 us, of Gurney's", "relative", 0.03, why="the same"),
    )

    def __init__(self, wall):
        self.wall = wall
        self.name = f"cylinder_{wall:.2f}mm".replace(".", "_")
        self.title = f"tube of copper, wall of {wall} mm, filled with PBX 9501"
        self.quick, self.full = ((4,), (4, 6)) if wall < 5 else ((8,), (6, 8))

    @property
    def scene_file(self):
        return SOURCE / "inputs" / "cylinder_test.toml"

    def settings(self, resolution):
        wall = 1e-3 * self.wall
        return {"resolution.spacing": (2 * wall / resolution, "m"),
                "bodies.tube.radius": (BORE + wall, "m"), "output.times": '["30 us"]',
                "insitu.enabled": False}

    def gurney(self):
        outer = BORE + 1e-3 * self.wall
        return gurney_speed(ROOT_2E, (outer**2 / BORE**2 - 1) * COPPER / EXPLOSIVE, "cylinder")

    def errors(self, run, resolution):
        """30 us after the detonation has passed, of the middle of what was measured; at the end, of Gurney's."""
        read = next(state for state in run.states if abs(state.time - READ_AT) < 1e-9)
        return {("speed at 30 us, of the experiment", "relative"):
                    relative(speed_of(run, "tube", read), np.mean(MEASURED[self.wall])),
                ("speed at 40 us, of Gurney's", "relative"): relative(speed_of(run, "tube", run.final), self.gurney())}

    def check_exact(self):
        printed = {2.54: 2902, 5.08: 2351}[self.wall]
        assert abs(self.gurney() / printed - 1) < 5e-3, self.gurney()


class Shell(Case):
    """Resolution: particles through the wall."""
    name = "shell"
    title = "spherical shell of copper filled with PBX 9501, lit at the centre"
    exact = "Gurney's sphere"
    quick, full = (), (3, 4)
    boost = rotation = "planes of symmetry; shown with the tube"
    mixed_margin = "one figure"
    bounds = (Bound("speed at 45 us, of Gurney's", "relative", {3: 0.065, 4: 0.04}, 1.0),)

    @property
    def scene_file(self):
        return SOURCE / "inputs" / "he_shell.toml"

    def settings(self, resolution):
        return {"resolution.spacing": (10e-3 / resolution, "m"), "insitu.enabled": False}

    def errors(self, run, resolution):
        inner, outer = 50e-3, 55e-3
        speed = gurney_speed(ROOT_2E, (outer**3 / inner**3 - 1) * COPPER / EXPLOSIVE, "sphere")
        plateau = speed_of(run, "shell", run.final)
        return {("speed at 45 us, of Gurney's", "relative"): relative(plateau, speed)}


CASES = [*(Cylinder(wall) for wall in MEASURED), Shell()]
