"""A plane detonation lit at a rigid wall: its speed, the state of Chapman and Jouguet at the front, the wave behind."""
import numpy as np

from exact.jwl import Jwl
from harness import Bound, Case, binned, fall, l1, relative
from harness.run import number

LENGTH, ROWS = 0.1, 8  # m; spacings
PRINTED = 0.7403, 37.00e9, 8800, 2285  # of PBX 9501: V, Pa, m/s, m/s
KEYS = ("density", "A", "B", "R1", "R2", "omega", "E0", "detonation_speed")


def explosive(run, name="pbx_9501"):
    eos = run.scene["materials"][name]["eos"]
    return Jwl(*(number(eos[key]) for key in KEYS))


class Detonation(Case):
    """Resolution: particles along the slab."""
    name = "detonation"
    title = "plane detonation of PBX 9501 from a rigid wall"
    exact = "Chapman and Jouguet's state of the products, and the isentropic wave in x/t behind it (Taylor 1950)"
    quick, full = (50, 100, 200), (50, 100, 200, 400)
    boost = "a wall on which the explosive is lit"
    bounds = (
        Bound("density", "L1", {50: 0.044, 100: 0.0235, 200: 0.0125}, 0.8),
        Bound("pressure", "L1", {50: 0.026, 100: 0.014, 200: 0.0071}, 0.8),
        Bound("velocity", "L1", {50: 0.036, 100: 0.018, 200: 0.0095}, 0.8),
        Bound("pressure at the front", "relative", {50: 0.21, 100: 0.135, 200: 0.086}, 0.5),
        Bound("pressure at rest", "relative", {50: 0.0035, 100: 0.0032, 200: 0.0012}, why="half of the way behind the front "
              "little is left of its width: the error changes its sign, so no order"),
        Bound("detonation speed", "relative", {50: 0.003, 100: 0.001, 200: 0.001}, why="0.1 % is asked; the times of lighting "
              "are exact, and the place of the front is read to a part of a spacing, so no order"),
        Bound("burnt mass", "relative", {50: 0.0065, 100: 0.003, 200: 0.0017}, 0.8),
    )

    def settings(self, resolution):
        spacing = LENGTH / resolution
        return {"resolution.spacing": (spacing, "m"), "bodies.slab.size": (LENGTH, ROWS * spacing, "m"),
                "boundary.min": (0, -ROWS / 2 * spacing, "m"), "boundary.max": (0, ROWS / 2 * spacing, "m")}

    def errors(self, run, resolution):
        """Profiles over the whole slab, relative to the state of Chapman and Jouguet; its pressure at the front; the rest."""
        jwl, state = explosive(run), run.final
        V, P, D, u = jwl.cj
        jumps = jwl.density / V - jwl.density, P, u
        errors = {(name.split()[0], "L1"): l1(value, exact, state.volume) / jump
                  for (name, x, value, exact), jump in zip(self.profiles(run), jumps)}
        x = state["position"][:, 0]
        errors["pressure at the front", "relative"] = relative(state["pressure"].max(), P)
        resting = (x > 0.1 * D * state.time) & (x < 0.4 * D * state.time)
        errors["pressure at rest", "relative"] = relative(state["pressure"][resting].mean(),
                                                          jwl.taylor_wave(np.array([0.0]), state.time)[1][0])
        errors["detonation speed", "relative"] = relative(self.measured_speed(run, LENGTH / resolution), D)
        errors["burnt mass", "relative"] = relative(run.history["burnt mass fraction"][-1], D * state.time / LENGTH)
        return errors

    def profiles(self, run):
        jwl, state = explosive(run), run.final
        x = state["position"][:, 0]
        volume, pressure, velocity = jwl.taylor_wave(x, state.time)
        return [("density [kg/m^3]", x, state["density"], jwl.density / volume),
                ("pressure [Pa]", x, state["pressure"], pressure), ("velocity [m/s]", x, state["velocity"][:, 0], velocity)]

    def measured_speed(self, run, spacing):
        """Slope of the line through the places where half of the highest pressure has been reached."""
        later = run.states[3:]
        places = [fall(*binned(s["position"][:, 0], s["pressure"], 0.2 * spacing), s["pressure"].max() / 2)
                  for s in later]
        return np.polyfit([s.time for s in later], places, 1)[0]

    def check_exact(self):
        jwl = Jwl(1840, 852.4e9, 18.02e9, 4.6, 1.3, 0.38, 10.2e9)
        assert np.allclose(jwl.cj, PRINTED, rtol=2e-4), jwl.cj
        assert abs(jwl.isentrope(jwl.cj[0])[1] / (jwl.cj[2] - jwl.cj[3]) - 1) < 1e-6  # sonic
        assert np.allclose([jwl.isentrope(7)[0], jwl.energy(7)], [0.08429e9, 1.5172e9], rtol=1e-3)


CASES = [Detonation()]
