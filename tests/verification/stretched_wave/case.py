"""A sound wave along the short axis of a lattice stretched to 4:1: what smoothing by ellipsoids is for."""
import numpy as np

from harness import Bound, Case, l1

AMPLITUDE = 1e-5
COLUMNS = 14


class StretchedWave(Case):
    """Resolution: particles per wave length."""
    name = "stretched_wave"
    title = "sound wave of amplitude 1e-5 after 1.25 periods in a lattice stretched to 4:1, no viscosity"
    exact = "linear wave sin 2 pi (y - t) of density and velocity; nonlinear terms are 1e-4 of it"
    mixed_margin = 0.08  # votes on H magnify round-off a little
    quick = (25, 50)
    full = (25, 50, 100)
    boost = "x"
    bounds = (
        Bound("density", "L1", {50: 0.0243}, 1.5),
        Bound("velocity", "L1", {50: 0.0177}, 1.4),
        Bound("phase", "rad", {50: 0.0259}, 1.35),
    )

    def settings(self, resolution):
        width = COLUMNS / resolution  # before the stretch
        return {"resolution.spacing": (1 / resolution, "m"), "bodies.gas.size": (width, 1, "m"),
                "boundary.min": (-2 * width, 0, "m"), "boundary.max": (2 * width, 1, "m")}

    def errors(self, run, resolution):
        """Of density and velocity in units of their amplitudes."""
        state = run.final
        y, v = state["position"][:, 1], state["velocity"][:, 1] / AMPLITUDE
        rho = (state["density"] / np.mean(state["density"]) - 1) / AMPLITUDE
        exact = np.sin(2 * np.pi * (y - state.time))
        wave = 2j * np.mean(v * np.exp(-2j * np.pi * (y - state.time)))  # 1 for sin(2 pi (y - t))
        return {("density", "L1"): l1(rho, exact, state.volume),
                ("velocity", "L1"): l1(v, exact, state.volume),
                ("phase", "rad"): float(abs(np.angle(wave)))}


CASES = [StretchedWave()]
