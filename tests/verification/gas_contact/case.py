"""Gases of very different density side by side, on one lattice, with either density method."""
import numpy as np

from exact.riemann import Gas, ShockTube
from harness import Bound, Case, l1

LENGTH, GAMMA = 1.0, 5 / 3  # m; of the contact


class Contact(Case):
    """Resolution: particles along the tube. Pressure relative to 1 Pa, velocity to the thin gas's speed of sound."""
    exact = "no motion"
    scene = "scene.toml"
    quick = (50, 100)
    full = (50, 100, 200)
    rows = 10
    boost = "y"
    mixed_margin = "what is noise here grows from round-off"
    rest = {"continuity": (
        Bound("pressure", "L1", 1e-12, why="round-off"),
        Bound("velocity", "largest", 1e-12, why="round-off"),
        Bound("velocity", "L1 at the end", 1e-12, why="round-off"),
        Bound("negative energy", "relative", 1e-12, why="there is none"),
    ), "summation": (
        Bound("pressure", "L1", {50: 0.11, 100: 0.055, 200: 0.03}, why="sums of masses are wrong within a kernel of the "
              "contact"),
        Bound("velocity", "largest", 0.6, why="what throws the particles at the contact; it settles"),
        Bound("velocity", "L1 at the end", {50: 0.036, 100: 0.027, 200: 0.02}, why="the same"),
        Bound("negative energy", "relative", 1e-12, why="there is none"),
    )}

    def __init__(self, density):
        self.density, self.bounds = density, self.rest[density]
        self.name = f"gas_contact_{density}"
        self.title = f"gases of 10 000 : 1 at rest, {density}"

    def settings(self, resolution):
        dx = LENGTH / resolution
        height = self.rows * dx
        return {"resolution.spacing": (dx, "m"), "numerics.density": self.density,
                "bodies.heavy.size": (LENGTH / 2, height, "m"), "bodies.light.size": (LENGTH / 2, height, "m"),
                "boundary.min": (-LENGTH / 2, -height / 2, "m"), "boundary.max": (LENGTH / 2, height / 2, "m")}

    def errors(self, run, resolution):
        sound, state = np.sqrt(GAMMA), run.final
        speeds = [np.linalg.norm(s["velocity"], axis=1) / sound for s in run.states]
        return {("pressure", "L1"): l1(state["pressure"], 1, state.volume),
                ("velocity", "largest"): max(s.max() for s in speeds),
                ("velocity", "L1 at the end"): l1(speeds[-1], 0, run.states[-1].volume),
                ("negative energy", "relative"): max(0, -state["specific_energy"].min() / state["specific_energy"].max())}


class Tube(Case):
    """Resolution: particles in the dense half. Velocity relative to that of the contact."""
    exact = "Riemann problem (Toro 2009, ch. 4)"
    scene = "tube.toml"
    tube = ShockTube(Gas(1, 0, 1), Gas(1e-3, 0, 0.1), 1.4)
    quick = (50, 100)
    full = (50, 100, 200, 400)
    rows = 10
    boost = "y"
    mixed_margin = "the contact is noise in part"
    jump = "continuity keeps the error that the first instants of a jump of 1000 leave at the contact"
    tube_bounds = {"continuity": (
        Bound("density", "L1", {100: 0.0093, 200: 0.0051, 400: 0.0033}, 0.75, why=jump),
        Bound("velocity", "L1", {100: 0.19, 200: 0.1, 400: 0.055}, 0.7),
        Bound("pressure", "L1", {100: 0.0107, 200: 0.0057, 400: 0.0031}, 0.8),
        Bound("negative energy", "relative", 1e-12, why="there is none"),
    ), "summation": (
        Bound("density", "L1", {100: 0.0025, 200: 0.0014, 400: 0.00123}, 0.8, why="0.0061, 0.0024, 0.0013, 0.0011 from 50 to 400: "
              "what the contact throws off is left"),
        # 0.18 at 100, 0.15 with weights by mass whatever the densities, which do not bear the contact at rest.
        Bound("velocity", "L1", {100: 0.19, 200: 0.083, 400: 0.045}, 0.7),
        Bound("pressure", "L1", {100: 0.009, 200: 0.0044, 400: 0.0024}, 0.8),
        Bound("negative energy", "relative", 1e-12, why="there is none"),
    )}

    def __init__(self, density):
        self.density, self.bounds = density, self.tube_bounds[density]
        self.name = f"thin_tube_{density}"
        self.title = f"shock tube, (1, 0, 1) | (0.001, 0, 0.1), {density}"

    def settings(self, resolution):
        dx = 0.5 / resolution
        height = self.rows * dx
        return {"resolution.spacing": (dx, "m"), "numerics.density": self.density,
                "bodies.left.size": (0.5, height, "m"), "bodies.right.size": (0.5, height, "m"),
                "boundary.min": (-0.5, -height / 2, "m"), "boundary.max": (0.5, height / 2, "m")}

    def errors(self, run, resolution):
        state = run.final
        density, velocity, pressure = self.tube.at(state["position"][:, 0] / state.time)
        energy = state["specific_energy"]
        return {("density", "L1"): l1(state["density"], density, state.volume),
                ("velocity", "L1"): l1(state["velocity"][:, 0], velocity, state.volume) / self.tube.velocity,
                ("pressure", "L1"): l1(state["pressure"], pressure, state.volume),
                ("negative energy", "relative"): max(0, -energy.min() / energy.max())}

    def check_exact(self):
        """Rankine and Hugoniot's jump of momentum at the shock, and the isentrope on the left."""
        tube, right = self.tube, self.tube.right
        jump = right.density * tube.shock_speed() * tube.velocity
        assert np.isclose(tube.pressure - right.pressure, jump, rtol=1e-10), (tube.pressure, jump)
        assert np.isclose(tube.behind(tube.left).density, tube.pressure ** (1 / 1.4), rtol=1e-10)


CASES = [case(density) for case in (Contact, Tube) for density in ("continuity", "summation")]
