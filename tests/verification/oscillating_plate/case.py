"""Bending frequency of a free plate."""
import numpy as np
from scipy.optimize import curve_fit

from exact.beam import FreePlate
from harness import Bound, Case
from harness.run import number

LENGTH, THICKNESS = 0.1, 0.01  # m


class OscillatingPlate(Case):
    """Resolution: particles through the plate. Its faces, where half of the neighbours are missing, are too soft."""
    name = "oscillating_plate"
    title = "free plate of basalt, ten times as long as thick, lowest bending mode"
    exact = "Timoshenko's beam in plane strain (exact/beam.py)"
    quick = (4, 8)
    full = (4, 8, 16, 20)
    boost = "x"
    bounds = (
        Bound("frequency", "relative", {4: 0.27, 8: 0.073, 16: 0.02, 20: 0.013}, 1.8, why="2 % is asked at 16, and second "
              "order: the mode is smooth"),
        Bound("damping in a period", "relative", {4: 0.0095, 8: 0.006, 16: 0.0032, 20: 0.0027}, 0.6),
    )

    def settings(self, resolution):
        return {"resolution.spacing": (THICKNESS / resolution, "m")}

    def errors(self, run, resolution):
        """Of the share of the mode in the velocities, fitted by a damped cosine."""
        rock, eos = run.scene["materials"]["basalt"]["elastic"], run.scene["materials"]["basalt"]["eos"]
        plate = FreePlate(LENGTH, THICKNESS, number(eos["density"]), number(eos["A"]), number(rock["shear_modulus"]))
        exact = plate.frequency()
        t = np.array([s.time for s in run.states])
        swing = np.array([self.share(s) for s in run.states])
        (size, omega, damping), _ = curve_fit(lambda t, a, w, d: a * np.exp(-d * t) * np.cos(w * t), t, swing,
                                              (swing.max(), exact, 0.0))
        return {("frequency", "relative"): abs(omega / exact - 1),
                ("damping in a period", "relative"): abs(1 - np.exp(-damping * 2 * np.pi / exact))}

    def share(self, state):
        x, v, k = state["position"][:, 0], state["velocity"][:, 1], 47.3004
        mode = np.cos(k * x) / np.cos(k * LENGTH / 2) + np.cosh(k * x) / np.cosh(k * LENGTH / 2)
        return np.sum(v * mode) / np.sum(mode**2)


CASES = [OscillatingPlate()]
