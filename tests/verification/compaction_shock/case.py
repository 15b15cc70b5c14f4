"""A bar of porous aluminium against a wall: an elastic precursor and the shock that closes the pores."""
import numpy as np

from exact.porous import CrushCurve, Matter, PorousBody, wall_profiles, wave_speed
from exact.tillotson import Tillotson
from harness import Bound, Case, binned, fall, l1, relative

ROWS, LENGTH, MATERIAL = 5, 0.02, "porous_aluminium"
# Shock speed, density, pressure with an elastic branch of 4110 m/s, worked out by another program; the last is a shock
# into the state behind the precursor, although it would catch up with it.
PRINTED = {200: (1005.7, 2624.8, 0.4833e9), 458: (1982.75, 2747.05, 1.9594e9), 800: (3194.4, 2823.4, 5.425e9),
           1500: (5045.8, 3014.8, 16.015e9)}

# Limits at 100, 200, 500 and 1000 particles: measured and 15 %. Without corrected gradients the plateaus are five to ten
# times closer (0.06 % in pressure): continuity with them is not the derivative of a sum, and a front leaves some error of
# the density behind at any resolution. With full viscosity everywhere the L1 error of the pressure at 800 m/s is the same at
# 100 and a quarter less at 200. For comparison, SPHERAL with 500 points in one dimension, its own elastic branch and 458 m/s: L1 of density
# 67.8 kg/m^3, velocity 49.2 m/s, pressure 222 MPa, alpha 0.059.
LIMITS = {
    200: {"density L1": (26, 17, 8.6, 4.8), "velocity L1": (10.4, 6.8, 3.5, 2),
          "pressure L1": (2.5e7, 1.7e7, 9.4e6, 5.5e6), "alpha L1": (0.0125, 0.008, 0.0041, 0.0023),
          "plateau density relative": (0.018, 0.0043, 0.00072, 0.00026),
          "plateau pressure relative": (0.106, 0.027, 0.0042, 0.0015),
          "plateau alpha relative": (0.0175, 0.004, 0.0006, 0.00021),
          "shock speed relative": (0.032, 0.0205, 0.0096, 0.004),
          "precursor speed relative": (0.043, 0.0096, 0.0055, 0.0037)},
    458: {"density L1": (12.2, 6.2, 2.6, 1.3), "velocity L1": (13, 5.3, 2.2, 1.15),
          "pressure L1": (1.1e8, 5.5e7, 2.5e7, 1.3e7), "alpha L1": (0.0049, 0.0024, 0.00095, 0.00049),
          "plateau density relative": (0.0002, 0.0002, 0.0002, 0.0002),
          "plateau pressure relative": (0.0045, 0.0048, 0.0017, 0.00145),
          "plateau alpha relative": (1e-12, 1e-12, 1e-12, 1e-12),
          "shock speed relative": (0.0057, 0.0051, 0.003, 0.003),
          "precursor speed relative": (0.056, 0.0097, 0.0055, 0.0037)},
    800: {"density L1": (13.7, 7.9, 2.8, 1.9), "velocity L1": (21, 11, 4.4, 2.4),
          "pressure L1": (3e8, 1.6e8, 6.6e7, 3.8e7), "alpha L1": (0.0032, 0.002, 0.00068, 0.00036),
          "plateau density relative": (0.00033, 0.0002, 0.0002, 0.0002),
          "plateau pressure relative": (0.0058, 0.0028, 0.0025, 0.0025),
          "plateau alpha relative": (1e-12, 1e-12, 1e-12, 1e-12),
          "shock speed relative": (0.0035, 0.0035, 0.0035, 0.0035),
          "precursor speed relative": (0.068, 0.0098, 0.0055, 0.0037)},
    1500: {"density L1": (21, 11.2, 6.3, 4.8), "velocity L1": (36, 18, 9.1, 6),
           "pressure L1": (6.4e8, 3.5e8, 2.1e8, 1.6e8), "alpha L1": (0.0042, 0.0025, 0.00076, 0.00042),
           "plateau density relative": (0.00074, 0.00062, 0.00063, 0.00062),
           "plateau pressure relative": (0.0052, 0.0044, 0.0043, 0.0042),
           "plateau alpha relative": (1e-12, 1e-12, 1e-12, 1e-12),
           "shock speed relative": (0.0053, 0.003, 0.003, 0.003),
           "precursor speed relative": (0.11, 0.017, 0.0058, 0.0037)}}
WHY = "ends at the accuracy of the kernel's gradients on a compressed lattice, or is a root of an equation"


def bounds(speed):
    """First order in L1. At 200 m/s the viscosity, with a sound speed five times that of the shock, smears it over more
    of its way than at the others, so that the order is 0.6 at first and 0.85 between the finest two. At 1500 m/s the
    error that a front leaves behind, 0.4 % of the pressure at any spacing, is what remains at 500 and 1000 particles:
    the orders of density, velocity and pressure are 0.88, 1.0, 0.85 from 100 to 200, and 0.61, 0.76, 0.55 over the whole
    ladder."""
    result = []
    for key, limits in LIMITS[speed].items():
        quantity, norm = key.rsplit(" ", 1)
        order = (0.55 if speed == 200 else 0.8 if quantity != "alpha" else 0.6) if norm == "L1" else None
        result.append(Bound(quantity, norm, dict(zip(CompactionShock.full, limits)), order, "" if order else WHY,
                            up_to=200 if speed == 1500 else float("inf")))
    return tuple(result)


class CompactionShock(Case):
    """Resolution: particles along the bar of 20 mm (the reference errors are those of 500)."""
    exact = ("Rankine-Hugoniot with Tillotson and the crush curve of resolved.toml: two waves (set-up of Jutzi, Benz & "
             "Michel 2008, Icarus 198, 242, sec. 5.1; pores rigid below P_e)")
    quick = (100, 200)
    full = (100, 200, 500, 1000)
    boost, boost_speed = "y", 100.0

    def __init__(self, speed):
        self.speed, self.bounds = speed, bounds(speed)
        self.name = f"compaction_shock_{speed}"
        self.title = f"porous aluminium, alpha0 = 1.275, against a wall at {speed} m/s, t = 3.5 us"
        if speed != 458:
            self.rotation = self.boost = self.mixed_margin = "shown at 458 m/s; only the speed differs"

    def settings(self, resolution):
        spacing = LENGTH / resolution
        height = ROWS * spacing
        return {"resolution.spacing": (spacing, "m"), "bodies.bar.size": (LENGTH, height, "m"),
                "bodies.bar.velocity": (-self.speed, 0, "m/s"),
                "boundary.min": (0, -height / 2, "m"), "boundary.max": (0.025, height / 2, "m")}

    def errors(self, run, resolution):
        """Over the whole bar, volume-weighted; plateaus between 0.3 and 0.7 of the way to the shock."""
        body, spacing = PorousBody.of(run.scene, MATERIAL), LENGTH / resolution
        waves = body.waves(self.speed)
        (precursor, before), (shock, behind) = waves
        state, errors = run.final, {}
        front = (shock - self.speed) * state.time
        for label, x, value, exact in self.profiles(run):
            name, plateau = label.split(" ")[0], (0.3 * front < x) & (x < 0.7 * front)
            errors[name, "L1"] = l1(value, exact, state.volume)
            if name != "velocity":
                errors[f"plateau {name}", "relative"] = relative(value[plateau].mean(), getattr(behind, name))
        for name, speed, level in (("shock", shock, (before.pressure + behind.pressure) / 2),
                                   ("precursor", precursor, before.pressure / 2)):
            errors[f"{name} speed", "relative"] = relative(self.speed_of(run, level, spacing), speed)
        return errors

    def profiles(self, run):
        body = PorousBody.of(run.scene, MATERIAL)
        return wall_profiles(body, body.waves(self.speed), self.speed, run.final)

    def speed_of(self, run, level, spacing):
        """Of the place where the pressure falls through a level, seen from the bar ahead: slope in the last half."""
        later = run.states[-4:]
        places = [fall(*binned(s["position"][:, 0], s["pressure"], spacing), level) for s in later]
        return np.polyfit([s.time for s in later], places, 1)[0] + self.speed

    def check_exact(self):
        """The same formulas give the states printed for the elastic branch of the paper, from its state ahead of the
        shock; those of rigid pores differ from them by 1 % at most."""
        aluminium = Tillotson(2700, 0.5, 1.63, 75.2e9, 65e9, 5e6, 3e6, 13.9e6, 5, 5)
        alpha_e, u_e = 1.273829, 9.3006
        paper = PorousBody(aluminium, CrushCurve.quadratic(alpha_e, 8e7, 7e8))
        rigid = PorousBody(aluminium, CrushCurve.quadratic(1.275, 8e7, 7e8))
        ahead = Matter(2122.456, u_e ** 2 / 2, 8e7, alpha_e, u_e)
        for speed, (shock, density, pressure) in PRINTED.items():
            behind = paper.shock_to(ahead, pressure)
            found = behind.velocity, wave_speed(ahead, behind), behind.density
            assert np.allclose(found, (speed, shock, density), rtol=3e-4), (speed, found)
            found = rigid.waves(speed)[-1]
            assert np.allclose((found[0], found[1].density, found[1].pressure), (shock, density, pressure), rtol=0.011)


CASES = [CompactionShock(speed) for speed in LIMITS]
