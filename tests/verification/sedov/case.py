"""Sedov's explosion on a line and at a point, into cold gas: a strong shock that leaves almost nothing behind."""
import numpy as np

from exact.sedov import Sedov
from harness import Bound, Case, binned, fall, l1, relative

NO_NEGATIVE_ENERGY = Bound("negative energy", "relative", 1e-12, why="there is none")


class SedovCase(Case):
    exact = "similarity solution (Sedov 1959), integrated numerically"
    nu: int

    def errors(self, run, resolution):
        state, blast = run.final, Sedov(self.nu, 5 / 3)
        r = np.linalg.norm(state["position"], axis=1)
        outwards = np.sum(state["position"] * state["velocity"], axis=1) / r
        k = r < 1
        errors = {(name, "L1"): l1(value[k], exact, state.volume[k]) for name, value, exact in
                  zip(("density", "velocity", "pressure"), (state["density"], outwards, state["pressure"]),
                      blast.at(r[k], state.time))}
        front = blast.radius(state.time)
        _, density = binned(r, state["density"], 1 / resolution)
        place = fall(*binned(r, state["pressure"], 1 / resolution), blast.at(0.999999 * front, state.time)[2] / 2)
        errors["shock radius", "relative"] = relative(place, front)
        errors["peak density", "relative"] = relative(density.max(), 4)
        energy = state["specific_energy"]
        errors["negative energy", "relative"] = max(0, -energy.min() / np.abs(energy).max())
        return errors

    profile_axis = "r [m]"

    def profiles(self, run):
        state = run.final
        r = np.linalg.norm(state["position"], axis=1)
        near, outwards = r < 1, np.sum(state["position"] * state["velocity"], axis=1) / r
        values = state["density"], outwards, state["pressure"]
        labels = "density [kg/m^3]", "speed outwards [m/s]", "pressure [Pa]"
        return [(label, r[near], value[near], exact) for label, value, exact in zip(
            labels, values, Sedov(self.nu, 5 / 3).at(r[near], state.time))]

    def check_exact(self):
        for nu, gamma, alpha, centre in ((2, 1.4, 0.98407, 0.3108), (3, 1.4, 0.85107, 0.3046),
                                         (2, 5 / 3, 0.56428, 0.2411), (3, 5 / 3, 0.49359, 0.2296)):
            blast = Sedov(nu, gamma)
            assert abs(blast.alpha - alpha) < 1e-5 and abs(blast.central_pressure() - centre) < 1e-4, (nu, gamma)


class SedovCylindrical(SedovCase):
    """Resolution: particles in 1 m."""
    name = "sedov_cylindrical"
    title = "Sedov's problem, cylindrical, shock at 0.8 m"
    scene = "cylindrical.toml"
    nu = 2
    quick = (15, 25, 50)
    full = (25, 50, 100)
    boost = "x"
    bounds = (
        Bound("density", "L1", {25: 0.185, 50: 0.105, 100: 0.063}, 0.6),
        Bound("velocity", "L1", {25: 0.07, 50: 0.037, 100: 0.018}, 0.7),
        Bound("pressure", "L1", {25: 0.053, 50: 0.027, 100: 0.0165}, 0.7),
        Bound("shock radius", "relative", {25: 0.012, 50: 0.003, 100: 0.003}, why="soon far below a spacing"),
        Bound("peak density", "relative", {25: 0.34, 50: 0.19, 100: 0.155}, 0.4),
        NO_NEGATIVE_ENERGY,
    )

    def settings(self, resolution):
        return {"resolution.spacing": (1 / resolution, "m")}


class SedovSpherical(SedovCylindrical):
    """Resolution: particles in 1 m."""
    name = "sedov_spherical"
    title = "Sedov's problem, spherical, shock at 0.8 m"
    scene = "spherical.toml"
    nu = 3
    quick = (8, 12, 16)
    full = (10, 20, 40)
    boost = "there is a wall on every axis"
    bounds = (
        Bound("density", "L1", {16: 0.25, 20: 0.21, 40: 0.12}, 0.6),
        Bound("velocity", "L1", {16: 0.115, 20: 0.1, 40: 0.05}, 0.3),
        Bound("pressure", "L1", {16: 0.075, 20: 0.057, 40: 0.03}, 0.75),
        Bound("shock radius", "relative", {16: 0.058, 20: 0.033, 40: 0.0063}, 0.9),
        Bound("peak density", "relative", {16: 0.55, 20: 0.48, 40: 0.31}, 0.3),
        NO_NEGATIVE_ENERGY,
    )


VOTES = "the lattice behind the shock is disordered, and smoothing tensors with it"


class SedovCylindricalTensors(SedovCylindrical):
    """The same with smoothing tensors, whose errors are a third smaller. Limits: measured and 15 %."""
    name = "sedov_cylindrical_asph"
    title = "Sedov's problem, cylindrical, with smoothing tensors"
    quick, full = (15, 25), (15, 25, 50)
    bounds = (
        # At 50 the lattice behind the shock is disordered, and so is H: 0.078, 0.024 and 0.025, which were 0.059, 0.019
        # and 0.021 once; votes on H every 3 or 30 steps in place of 10 give 0.071, 0.033, 0.025 or 0.099, 0.029, 0.036.
        Bound("density", "L1", {25: 0.132, 50: 0.09}, 0.6, VOTES),
        Bound("velocity", "L1", {25: 0.0415, 50: 0.028}, 0.65, VOTES),
        Bound("pressure", "L1", {25: 0.047, 50: 0.029}, 0.65, VOTES),
        Bound("shock radius", "relative", {25: 0.013, 50: 0.002}, why="soon far below a spacing"),
        Bound("peak density", "relative", {25: 0.3, 50: 0.19}, 0.33),
        NO_NEGATIVE_ENERGY,
    )

    def settings(self, resolution):
        return {**super().settings(resolution), "numerics.scheme": "asph"}


CASES = [SedovCylindrical(), SedovSpherical(), SedovCylindricalTensors()]
