"""Expanding ring: the hoop stress of a plastic ring slows its flight."""
import numpy as np

from harness import Bound, Case
from harness.run import number

THICKNESS, RADIUS, SPEED = 3e-3, 20e-3, 200.0  # m, m, m/s


def speed(r, r0, v0, stress, density, elastic_strain):
    """V(r) of a thin ring from dV/dt = -stress/(density r); the stress grows linearly up to the elastic strain."""
    strain = np.log(r / r0) - elastic_strain / 2
    return np.sqrt(v0**2 - 2 * stress / density * strain)


class Tube(Case):
    """Resolution: particles through the wall."""
    exact = "thin ring of ideal plasticity, V^2 = V0^2 - 2 sigma/rho (ln(r/r0) - strain at yield/2)"
    quick = (6,)
    full = (4, 6, 12)
    boost = "walls on every axis"
    hoop = 2 / np.sqrt(3)  # hoop stress over yield stress
    sizes = 2

    def __init__(self, scheme, bounds):
        self.scheme, self.bounds = scheme, bounds
        self.name = f"{'tube' if self.sizes == 2 else 'ring'}_{scheme}"
        self.title = f"expanding {'tube in plane strain' if self.sizes == 2 else 'ring'}, 200 m/s, {scheme}"

    def settings(self, resolution):
        return {"resolution.spacing": (THICKNESS / resolution, "m"), "numerics.scheme": self.scheme}

    def errors(self, run, resolution):
        steel = run.scene["materials"]["steel"]
        shear, bulk = (number(steel["elastic"][name]) for name in ("shear_modulus", "bulk_modulus"))
        young = 9 * bulk * shear / (3 * bulk + shear)
        if self.sizes == 2:
            young /= 1 - ((3 * bulk - 2 * shear) / (6 * bulk + 2 * shear))**2
        stress = self.hoop * number(steel["strength"]["yield_stress"])
        r, v = np.array([self.motion(state) for state in run.states]).T
        r0, v0 = self.start(run)
        exact = speed(r, r0, v0, stress, number(steel["eos"]["density"]), stress / young)
        late = r > 1.02 * r0  # after the elastic start
        error = np.abs(v - exact)[late].max()
        return {("speed", "largest"): error / v0,
                ("loss of speed at the end", "relative"): abs((v0 - v[-1]) / (v0 - exact[-1]) - 1)}

    def motion(self, state):
        """Mean radius and the root mean square of the radial velocity."""
        x, v, m = state["position"][:, :2], state["velocity"][:, :2], state["mass"]
        r = np.linalg.norm(x, axis=1)
        radial = np.einsum("ia,ia->i", x, v) / r
        return np.average(r, weights=m), np.sqrt(np.average(radial**2, weights=m))

    def start(self, run):
        """Those at t = 0."""
        first = run.states[0]
        r, v = self.motion(first)
        # The first snapshot is after the start: it is taken back with the mean of both speeds.
        v0 = np.sqrt(2 * run.history["kinetic energy"][0] / run.history["mass"][0])
        return r - first.time * (v + v0) / 2, v0


class Ring(Tube):
    __doc__ = Tube.__doc__
    exact = Tube.exact + ", uniaxial stress"
    scene = "ring.toml"
    quick = ()
    full = (4, 6)
    hoop, sizes = 1, 3


TUBE = {scheme: (Bound("speed", "largest", {4: 0.0115, 6: 0.0085, 12: 0.0036}, 0.9, why="surfaces carry too little hoop stress"),
                 Bound("loss of speed at the end", "relative", {4: 0.047, 6: 0.034, 12: 0.0125}, 1.0, why="the same"))
        for scheme in ("sph", "asph")}
RING = (Bound("speed", "largest", {4: 0.02, 6: 0.01}, 1.5, why="four surfaces; 1 % is asked at 6"),
        Bound("loss of speed at the end", "relative", {4: 0.48, 6: 0.28}, 1.1))
CASES = [Tube(scheme, bounds) for scheme, bounds in TUBE.items()] + [Ring("sph", RING), Ring("asph", RING)]
