"""Sod's shock tube: a rarefaction, a contact and a shock. A solution with jumps: first order in L1 is all there is."""
import numpy as np

from exact.riemann import Gas, ShockTube
from harness import Bound, Case, binned, fall, l1, l2


class Sod(Case):
    """Resolution: particles in the 0.5 m of dense gas. The strip stays a whole number of rows high: 17 and 6."""
    name = "sod"
    title = "Sod's shock tube, gamma 1.4, (1, 0, 1) | (0.125, 0, 0.1), t = 0.2 s"
    exact = "Riemann problem (Toro 2009, ch. 4)"
    scene = "../../../inputs/sod.toml"
    quick = (100, 200, 400)
    full = (50, 100, 200, 400, 800)
    tube = ShockTube(Gas(1, 0, 1), Gas(0.125, 0, 0.1), 1.4)
    printed = 0.3031302, 0.9274526, 0.4263194, 0.2655737, 1.7521557  # p*, u*, densities beside the contact, shock speed
    rows, half_length, half_width = 17, 0.51, 0.5  # in spacings; of the box; of the part without effects of the ends
    boost = "y"
    places = (
        Bound("shock position", "spacings", 0.5, why="far sharper than the shock is resolved, and in spacings"),
        Bound("contact position", "spacings", 0.7, why="the same"),
    )
    bounds = (
        Bound("density", "L1", {100: 0.0065, 400: 0.0018}, 0.85),
        Bound("velocity", "L1", {100: 0.019, 400: 0.005}, 0.85),
        Bound("pressure", "L1", {100: 0.007, 400: 0.0019}, 0.85),
        *places,
    )

    def settings(self, resolution):
        spacing = 0.5 / resolution
        height, x = self.rows * spacing, self.half_length
        return {"resolution.spacing": (spacing, "m"),
                "bodies.left.size": (x, height, "m"), "bodies.right.size": (x, height, "m"),
                "boundary.min": (-x, -height / 2, "m"), "boundary.max": (x, height / 2, "m")}

    def errors(self, run, resolution):
        """Volume-weighted, over the part that knows nothing of the ends of the tube."""
        state = run.final
        x = state["position"][:, 0]
        inner = np.abs(x) < self.half_width
        exact = self.tube.at(x[inner] / state.time)
        values = state["density"], state["velocity"][:, 0], state["pressure"]
        errors = {(name, "L1"): l1(value[inner], truth, state.volume[inner])
                  for name, value, truth in zip(("density", "velocity", "pressure"), values, exact)}
        spacing, tube = 0.5 / resolution, self.tube
        star, contact = tube.pressure, tube.velocity * state.time
        levels = {"shock": ("pressure", (star + tube.right.pressure) / 2, x > contact, tube.shock_speed() * state.time),
                  "contact": ("density", (tube.behind(tube.left).density + tube.behind(tube.right).density) / 2,
                              np.abs(x - contact) < 0.08, contact)}
        for name, (field, level, near, exactly) in levels.items():
            place = fall(*binned(x[near], state[field][near], 2 * spacing), level)
            errors[f"{name} position", "spacings"] = abs(place - exactly) / spacing
        return errors

    def profiles(self, run):
        state, x = run.final, run.final["position"][:, 0]
        values = state["density"], state["velocity"][:, 0], state["pressure"]
        labels = "density [kg/m^3]", "velocity [m/s]", "pressure [Pa]"
        return [(label, x, value, exact) for label, value, exact in zip(labels, values, self.tube.at(x / state.time))]

    def check_exact(self):
        left, right = self.tube.behind(self.tube.left), self.tube.behind(self.tube.right)
        found = self.tube.pressure, self.tube.velocity, left.density, right.density, self.tube.shock_speed()
        assert np.allclose(found, self.printed, atol=1e-7, rtol=0), found


class SodGamma53(Sod):
    """Resolution: particles in the 0.5 m of dense gas."""
    name = "sod_gamma_53"
    title = "shock tube, gamma 5/3, (1, 0, 1) | (0.25, 0, 0.1795), t = 0.15 s"
    scene = "gamma_53.toml"
    tube = ShockTube(Gas(1, 0, 1), Gas(0.25, 0, 0.1795), 5 / 3)
    printed = 0.4217348, 0.6142148, 0.5956946, 0.4094021, 1.5775252
    rows, half_length = 16, 0.5
    quick = (50, 100, 200)
    bounds = (
        Bound("density", "L1", {100: 0.0064, 400: 0.0017}, 0.85),
        Bound("velocity", "L1", {100: 0.012, 400: 0.003}, 0.85),
        Bound("pressure", "L1", {100: 0.0072, 400: 0.0019}, 0.85),
        *Sod.places,
    )


class SodRiemann(Sod):
    """Resolution: particles in the 0.5 m of dense gas. Limits: measured and 15 %, of L2 at 128 what is asked."""
    name = "sod_gsph"
    title = "Sod's shock tube with Riemann problems between particles"
    scene = "gsph.toml"
    quick, full = (100, 128, 200), (50, 100, 128, 200, 400, 800)
    bounds = (
        Bound("density", "relative L2", {100: 0.0192, 128: 0.015, 200: 0.0112, 400: 0.0072, 800: 0.0053}, 0.55),
        Bound("density", "L1", {100: 0.0056, 200: 0.0027, 400: 0.00147, 800: 0.00094}, 0.85),
        Bound("velocity", "L1", {100: 0.0129, 200: 0.0071, 400: 0.0034, 800: 0.00195}, 0.85),
        Bound("pressure", "L1", {100: 0.006, 200: 0.003, 400: 0.00153, 800: 0.00082}, 0.85),
        Bound("shock position", "spacings", 0.5, why="far sharper than the shock is resolved, and in spacings"),
        Bound("contact position", "spacings", {50: 0.73, 100: 0.4, 800: 0.4}, why="a share of a spacing"),
    )
    mixed_margin = "Riemann problems are solved in double precision"

    def errors(self, run, resolution):
        state = run.final
        x = state["position"][:, 0]
        inner = np.abs(x) < self.half_width
        exact, weight = self.tube.at(x[inner] / state.time)[0], state.volume[inner]
        error = l2(state["density"][inner], exact, weight) / l2(exact, 0, weight)
        return {("density", "relative L2"): error, **super().errors(run, resolution)}


class SodRiemannSwept(SodRiemann):
    """Resolution: particles in the 0.5 m of dense gas. Limits: measured and 15 %, of L2 what is asked. At 400 the density
    is no better than at 200 (L2 0.0127, L1 0.0023): that is why these volumes are not the default."""
    name = "sod_gsph_swept"
    title = "Sod's shock tube with Riemann problems between particles, densities by what faces sweep"
    quick, full = (100, 128, 200), (50, 100, 128, 200)
    bounds = (
        Bound("density", "relative L2", {128: 0.015}, 0.5),
        Bound("density", "L1", {100: 0.0066, 200: 0.0035}, 0.85),
        Bound("velocity", "L1", {100: 0.0158, 200: 0.0081}, 0.85),
        Bound("pressure", "L1", {100: 0.0073, 200: 0.0036}, 0.85),
        Bound("shock position", "spacings", 0.5, why="far sharper than the shock is resolved, and in spacings"),
        Bound("contact position", "spacings", 0.82, why="measured and 15 %"),
    )

    def settings(self, resolution):
        return {**super().settings(resolution), "numerics.density": "continuity", "numerics.kernel": "quintic_spline"}


class SodMyers(SodRiemann):
    """Resolution: particles in the 0.5 m of dense gas. Limits: measured and 15 %."""
    name = "sod_gsph_myers"
    title = "Sod's shock tube with the Gaussian, the pilot density and the conduction of Myers et al. (2024)"
    quick, full = (50, 100), (50, 100, 200)
    rows = 34  # the pilot density reaches 32
    bounds = (
        Bound("density", "relative L2", {100: 0.035}, 0.4),
        Bound("density", "L1", {100: 0.0125}, 0.7, "conduction smears the contact"),
        Bound("velocity", "L1", {100: 0.0215}, 0.7, "the same"),
        Bound("pressure", "L1", {100: 0.0088}, 0.75, "the same"),
        Bound("shock position", "spacings", 0.5, why="far sharper than the shock is resolved, and in spacings"),
        Bound("contact position", "spacings", 1.5, why="1.3: conduction and sums smear it"),
    )

    def settings(self, resolution):
        return {**super().settings(resolution), "numerics.kernel": "gaussian", "numerics.nodes_per_h": 1.5,
                "numerics.pilot_width": 2.5, "numerics.linear_conduction": 0.25, "numerics.quadratic_conduction": 0.5}


CASES = [Sod(), SodGamma53(), SodRiemann(), SodRiemannSwept(), SodMyers()]
