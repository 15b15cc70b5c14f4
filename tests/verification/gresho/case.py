"""Gresho's vortex: how much shear flow survives the viscosity and the noise of the method."""
import numpy as np

from harness import Bound, Case, l1


class Gresho(Case):
    """Resolution: particles along the box of 1 m."""
    name = "gresho"
    title = "Gresho's vortex, gamma 5/3, t = 1 s"
    exact = "stationary: v = 5 r to 0.2 m, 2 - 5 r to 0.4 m (Gresho & Chan 1990)"
    quick = (16, 32, 64)
    full = (16, 32, 64, 128)
    boost = "x"
    bounds = (
        Bound("velocity", "L1", {64: 0.04, 128: 0.023}, 0.7),
        Bound("radial velocity", "L1", {64: 0.018, 128: 0.011}, 0.4),
        Bound("peak speed", "relative", {64: 0.2, 128: 0.135}, 0.35),
        Bound("angular momentum", "relative", {64: 0.006, 128: 0.002}, why="lost to disorder at once"),
    )

    def settings(self, resolution):
        return {"resolution.spacing": (1 / resolution, "m")}

    def errors(self, run, resolution):
        """Of the azimuthal velocity, whose largest value is 1 m/s."""
        state = run.final
        (x, y), (u, v) = state["position"].T, state["velocity"].T
        r = np.hypot(x, y)
        around, outwards = (x * v - y * u) / r, (x * u + y * v) / r
        exact = np.where(r < 0.2, 5 * r, np.clip(2 - 5 * r, 0, None))
        inner = r < 0.5
        spin = state["mass"] * r
        return {("velocity", "L1"): l1(around[inner], exact[inner], state.volume[inner]),
                ("radial velocity", "L1"): l1(outwards[inner], 0, state.volume[inner]),
                ("peak speed", "relative"): abs(1 - peak(r, around)),
                ("angular momentum", "relative"): abs(1 - np.sum(spin * around) / np.sum(spin * exact))}

    profile_axis = "r [m]"

    def profiles(self, run):
        (x, y), (u, v) = run.final["position"].T, run.final["velocity"].T
        r = np.hypot(x, y)
        exact = np.where(r < 0.2, 5 * r, np.clip(2 - 5 * r, 0, None))
        return [("azimuthal velocity [m/s]", r, (x * v - y * u) / r, exact)]


def peak(r, around):
    """Largest mean speed of rings 0.02 m wide."""
    ring = np.floor(r[r < 0.5] / 0.02).astype(int)
    count = np.bincount(ring)
    return np.max(np.bincount(ring, around[r < 0.5])[count > 0] / count[count > 0])


CASES = [Gresho()]
