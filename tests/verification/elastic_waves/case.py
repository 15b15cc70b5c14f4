"""Plane elastic waves in basalt, over one period in a thin periodic strip."""
import numpy as np

from harness import Bound, Case, l1
from harness.run import number

ROWS, AMPLITUDE, LENGTH = 8, 0.01, 1.0  # spacings; m/s; of a wave, m


class PWave(Case):
    """Resolution: particles in a wavelength. Errors relative to the amplitude of the wave."""
    name = "elastic_p_wave"
    title = "longitudinal wave, strain 2e-6, one period"
    exact = "linear elasticity: c = sqrt((K + 4 G/3)/rho) (Landau & Lifshitz, Theory of Elasticity, section 22)"
    quick = (16, 32, 64)
    full = (16, 32, 64, 128, 256)
    boost, boost_speed = "y", AMPLITUDE
    # Speed by the dispersion of the kernel, amplitude by the steps of 0.4 crossings of h.
    bounds = (
        Bound("velocity", "L1", {32: 0.09, 64: 0.022, 128: 0.0055, 256: 0.0014}, 1.9),
        Bound("wave speed", "relative", {32: 0.022, 64: 0.0055, 128: 0.0014, 256: 0.00035}, 1.9),
        Bound("amplitude", "relative", {32: 1.1e-3, 64: 1.15e-4, 128: 1.4e-5, 256: 1.5e-6}, 1.8),
    )
    component, printed = 0, 4593.34  # of the velocity; m/s

    def settings(self, resolution):
        width = ROWS * LENGTH / resolution
        return {"resolution.spacing": (LENGTH / resolution, "m"), "time.end": (LENGTH / self.printed, "s"),
                "bodies.rock.size": (LENGTH, width, "m"),
                "boundary.min": (0, -width / 2, "m"), "boundary.max": (LENGTH, width / 2, "m")}

    def speed(self, K, G, rho):
        return np.sqrt((K + 4 * G / 3) / rho)

    def errors(self, run, resolution):
        """Phase and amplitude are those of the first Fourier component."""
        basalt = run.scene["materials"]["basalt"]
        eos, elastic = basalt["eos"], basalt["elastic"]
        c = self.speed(number(eos["A"]), number(elastic["shear_modulus"]), number(eos["density"]))
        state, k = run.final, 2 * np.pi / LENGTH
        x, v = state["position"][:, 0], state["velocity"][:, self.component] / AMPLITUDE
        component = 2j * np.mean(v * np.exp(-1j * k * (x - c * state.time)))  # 1, turned by k (c - c_measured) t
        return {("velocity", "L1"): l1(v, np.sin(k * (x - c * state.time)), state.volume),
                ("wave speed", "relative"): abs(np.angle(component)) / (k * c * state.time),
                ("amplitude", "relative"): abs(abs(component) - 1)}

    def check_exact(self):
        assert abs(self.speed(26.7e9, 22.7e9, 2700) - self.printed) < 0.1


class SWave(PWave):
    __doc__ = PWave.__doc__
    name = "elastic_s_wave"
    title = "transverse wave, shear strain 3e-6, one period"
    exact = "linear elasticity: c = sqrt(G/rho) (Landau & Lifshitz, Theory of Elasticity, section 22)"
    scene = "s_wave.toml"
    component, printed = 1, 2899.55

    def speed(self, K, G, rho):
        return np.sqrt(G / rho)


CASES = [PWave(), SWave()]
