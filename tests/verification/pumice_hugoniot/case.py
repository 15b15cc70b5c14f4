"""The Hugoniot of porous pumice: a bar of the shipped material against a wall, from 20 m/s to 2 km/s."""
import numpy as np

from exact.porous import CrushCurve, PorousBody, wall_profiles, wave_speed
from exact.tillotson import Tillotson
from harness import Bound, Case, binned, fall, l1, relative

CRUSHED, ROWS, SOUND = 0.01, 5, 3388  # m of bar that the front runs through; spacings; speed of the precursor [m/s]
# Speed of the throw: speed of the front, pressure and density behind it, worked out by another program for a single
# shock into pumice at rest. Without the precursor of 1 MPa ahead slow fronts would be faster.
PRINTED = {20: (168.8, 2.36e6, 794), 50: (159.8, 5.59e6, 1019), 100: (195.0, 13.65e6, 1437),
           200: (325.9, 45.6e6, 1812), 400: (576.1, 161e6, 2290), 800: (1160, 650e6, 2256),
           1500: (2250, 2.363e9, 2100), 2000: (3105, 4.347e9, 1967)}
FRONT = {20: 131, 50: 148, 100: 192, 200: 325, 400: 576, 800: 1160, 1500: 2250, 2000: 3105}  # m/s, behind the precursor
PUMICE = PorousBody(Tillotson(2327, 0.5, 1.5, 26.7e9, 26.7e9, 487e6, 4.72e6, 18.2e6, 5, 5),
                    CrushCurve.two_power(2327 / 700, 4.64, 1.90, 1e6, 6.8e7, 2.13e8, 12, 3))


class PumiceHugoniot(Case):
    """Resolution: particles that the front has crushed along the bar. The precursor is up to 26 times as fast, and the
    bar that much longer."""
    exact = ("Rankine-Hugoniot with Tillotson and the crush curve of resolved.toml: a precursor to P_e, pores rigid, "
             "and a compaction shock")
    boost, boost_speed = "y", 100.0

    def __init__(self, speed):
        self.speed, self.bounds, self.quick = speed, bounds(speed), QUICK[speed]
        self.full = (25, 50, 100, 200)[:len(LIMITS[speed][0])]
        self.name = f"pumice_hugoniot_{speed}"
        self.title = f"pumice of 70 % pores against a wall at {speed} m/s"
        if speed != 2000:
            self.rotation = self.boost = self.mixed_margin = "shown at 2000 m/s; only the speed differs"

    def settings(self, resolution):
        spacing, front = CRUSHED / resolution, FRONT[self.speed]
        length, height = 1.08 * CRUSHED * SOUND / front, ROWS * spacing
        return {"resolution.spacing": (spacing, "m"), "time.end": (CRUSHED / front, "s"),
                "bodies.bar.center": (length / 2, 0, "m"), "bodies.bar.size": (length, height, "m"),
                "bodies.bar.velocity": (-self.speed, 0, "m/s"), "numerics.viscosity_alpha": min(1, 3 * front / SOUND),
                "boundary.min": (0, -height / 2, "m"), "boundary.max": (1.2 * length, height / 2, "m")}

    def errors(self, run, resolution):
        """Profiles relative to the jump, up to twice as far as the front; plateaus between 0.3 and 0.7 of its way."""
        body = PorousBody.of(run.scene, "pumice")
        waves = body.waves(self.speed)
        (_, before), (front, behind) = waves
        state = run.final
        x, place = state["position"][:, 0], (front - self.speed) * state.time
        near, plateau = x < 2 * place, (0.3 * place < x) & (x < 0.7 * place)
        errors = {(label.split(" ")[0], "L1"): l1(value[near], exact[near], state.volume[near]) / np.ptp(exact)
                  for label, _, value, exact in self.profiles(run)}
        for name, field in (("density", "density"), ("pressure", "pressure"), ("alpha", "distension")):
            errors[f"plateau {name}", "relative"] = relative(state[field][plateau].mean(), getattr(behind, name))
        later, level = run.states[-4:], (before.pressure + behind.pressure) / 2
        places = [fall(*binned(s["position"][:, 0], s["pressure"], CRUSHED / resolution / 2), level) for s in later]
        speed = np.polyfit([s.time for s in later], places, 1)[0] + self.speed
        errors["shock speed", "relative"] = relative(speed, front)
        return errors

    def profiles(self, run):
        body = PorousBody.of(run.scene, "pumice")
        return wall_profiles(body, body.waves(self.speed), self.speed, run.final)

    def check_exact(self):
        """The same formulas without a precursor give what is printed elsewhere; density falls beyond 400 m/s."""
        shock, pressure, density = PRINTED[self.speed]
        behind = PUMICE.shock_to(PUMICE.rest, pressure)
        found = behind.velocity, wave_speed(PUMICE.rest, behind), behind.density
        assert np.allclose(found, (self.speed, shock, density), rtol=2e-3), found
        densities = [PUMICE.waves(speed)[-1][1].density for speed in PRINTED]
        assert np.argmax(densities) == list(PRINTED).index(400), densities


# By speed: resolutions of the quick test, and limits at those of the full one: on the L1 errors of density, velocity,
# pressure and alpha, then on plateau density, pressure, alpha and the speed of the front. Measured and 15 %, but 1 %
# for shock speed and plateau density and 2 % for plateau pressure, the levels aimed at, where they are reached. At 1500
# and 2000 m/s the pressure is 2.5 to 3.5 % off, for half a percent in the density behind a front that compresses three
# times. Corrected gradients have a part in it: without them 2.1 in place of 2.8 % at 2000 m/s and 50 particles, and an L1
# error of the pressure of 0.059 in place of 0.075. With few particles the stiff crushed matter rings as well.
QUICK = {2000: (25, 50, 100), 1500: (50,), 800: (25, 50), 400: (25, 50), 200: (25, 50), 100: (25,), 50: (), 20: ()}
LIMITS = {
    2000: ((0.12, 0.065, 0.036, 0.025), (0.11, 0.057, 0.03, 0.021), (0.15, 0.088, 0.07, 0.055),
           (0.1, 0.061, 0.033, 0.023), (0.01, 0.01, 0.01, 0.01), (0.041, 0.032, 0.03, 0.039),
           (1e-12, 1e-12, 1e-12, 1e-12), (0.013, 0.01, 0.01, 0.01)),
    1500: ((0.085, 0.045, 0.024, 0.021), (0.094, 0.047, 0.026, 0.016), (0.14, 0.091, 0.061, 0.052),
           (0.098, 0.048, 0.027, 0.017), (0.01, 0.01, 0.01, 0.01), (0.086, 0.034, 0.028, 0.039),
           (1e-12, 1e-12, 1e-12, 1e-12), (0.016, 0.01, 0.01, 0.01)),
    800: ((0.11, 0.056, 0.029, 0.019), (0.16, 0.082, 0.041, 0.022), (0.24, 0.14, 0.066, 0.05),
          (0.16, 0.083, 0.042, 0.022), (0.01, 0.01, 0.01, 0.01), (0.07, 0.031, 0.02, 0.02),
          (1e-12, 1e-12, 1e-12, 1e-12), (0.01, 0.01, 0.01, 0.01)),
    400: ((0.13, 0.066, 0.036), (0.17, 0.089, 0.044), (0.15, 0.096, 0.066), (0.17, 0.093, 0.047),
          (0.01, 0.01, 0.01), (0.058, 0.025, 0.02), (0.01, 0.01, 0.01), (0.01, 0.01, 0.01)),
    200: ((0.12, 0.061, 0.033), (0.15, 0.076, 0.038), (0.15, 0.087, 0.052), (0.15, 0.08, 0.041),
          (0.01, 0.01, 0.01), (0.02, 0.02, 0.02), (0.01, 0.01, 0.01), (0.014, 0.013, 0.01)),
    100: ((0.16, 0.084, 0.043), (0.18, 0.095, 0.049), (0.15, 0.084, 0.043), (0.18, 0.096, 0.049),
          (0.031, 0.01, 0.01), (0.089, 0.02, 0.02), (0.032, 0.01, 0.01), (0.015, 0.01, 0.01)),
    50: ((0.17, 0.11, 0.062), (0.17, 0.11, 0.063), (0.14, 0.086, 0.053), (0.17, 0.11, 0.064),
         (0.027, 0.01, 0.01), (0.069, 0.02, 0.02), (0.028, 0.01, 0.01), (0.01, 0.01, 0.01)),
    20: ((0.15, 0.11, 0.068), (0.15, 0.099, 0.066), (0.095, 0.065, 0.044), (0.15, 0.11, 0.068),
         (0.01, 0.01, 0.01), (0.042, 0.02, 0.02), (0.01, 0.01, 0.01), (0.01, 0.01, 0.01))}
QUANTITIES = (("density", "L1"), ("velocity", "L1"), ("pressure", "L1"), ("alpha", "L1"),
              ("plateau density", "relative"), ("plateau pressure", "relative"), ("plateau alpha", "relative"),
              ("shock speed", "relative"))


def bounds(speed):
    """First order in L1, less where the front is still widening, at 20 and 50 m/s, where it takes tens of particles, and
    in the pressure, which ends at the error of its plateau."""
    order = 0.5 if speed == 20 else 0.6 if speed == 50 else 0.7
    pressure = min(order, 0.45)
    return tuple(Bound(*key, dict(zip((25, 50, 100, 200), values)),
                       None if key[1] != "L1" else pressure if key[0] == "pressure" else min(order, 0.65),
                       "ends at the accuracy of a density from velocity gradients" if key[1] != "L1" else "")
                 for key, values in zip(QUANTITIES, LIMITS[speed]))


CASES = [PumiceHugoniot(speed) for speed in LIMITS]
