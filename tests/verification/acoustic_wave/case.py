"""A sound wave after 1.25 periods: smooth, so that the order is two."""
import numpy as np

from harness import Bound, Case, l1

AMPLITUDE = 1e-5
ROWS = 14


class AcousticWave(Case):
    """Resolution: particles per wave length."""
    name = "acoustic_wave"
    title = "sound wave of amplitude 1e-5 after 1.25 periods, no viscosity"
    exact = "linear wave sin 2 pi (x - t) of density and velocity; nonlinear terms are 1e-4 of it"
    quick = (25, 50, 100)
    full = (25, 50, 100, 200)
    boost = "y"
    bounds = (
        Bound("density", "L1", {100: 0.0026}, 1.9),
        Bound("velocity", "L1", {100: 0.0021}, 1.9),
        Bound("phase", "rad", {100: 0.003}, 1.9),
        Bound("amplitude", "relative", {100: 0.0014}, 1.7),
    )

    def settings(self, resolution):
        spacing = 1 / resolution
        height = ROWS * spacing
        return {"resolution.spacing": (spacing, "m"), "bodies.gas.size": (1, height, "m"),
                "boundary.min": (0, -height / 2, "m"), "boundary.max": (1, height / 2, "m")}

    def errors(self, run, resolution):
        """Of density and velocity in units of their amplitudes; phase and amplitude of the first harmonic."""
        state = run.final
        x, v = state["position"][:, 0], state["velocity"][:, 0] / AMPLITUDE
        rho = (state["density"] / np.mean(state["density"]) - 1) / AMPLITUDE
        exact = np.sin(2 * np.pi * (x - state.time))
        wave = 2j * np.mean(v * np.exp(-2j * np.pi * (x - state.time)))  # 1 for sin(2 pi (x - t))
        return {("density", "L1"): l1(rho, exact, state.volume),
                ("velocity", "L1"): l1(v, exact, state.volume),
                ("phase", "rad"): float(abs(np.angle(wave))),
                ("amplitude", "relative"): float(abs(abs(wave) - 1))}


CASES = [AcousticWave()]
