"""Sod's shock tube against its exact solution: error and order."""
import math
import unittest
from ejecta_run import SOD, RunTest, Snapshot, summary
from riemann import Gas, ShockTube

EXACT = ShockTube(Gas(1, 0, 1), Gas(0.125, 0, 0.1), 1.4)
TIME = 0.2
BOUNDS = 0.0025, 0.007, 0.0025  # of density, velocity and pressure at the finest spacing, in SI
# The strip is periodic across and must stay a whole number of rows high: 17 left and 6 right at any spacing.
SPACINGS = {0.005: 100, 0.0025: 200, 0.00125: 400}  # m: particles in 0.5 m of the dense gas


class Profile:
    """Particles with |x| < 0.5 m, and volume-weighted L1 errors against the exact solution."""

    def __init__(self, file):
        s = Snapshot(file)
        columns = zip(*(s.column(c) for c in ("position_0", "mass", "density", "velocity_0", "pressure")))
        self.particles = sorted(p for p in columns if abs(p[0]) < 0.5)

    def errors(self):
        sums, volume = [0, 0, 0], 0
        for x, mass, *values in self.particles:
            exact = EXACT.at(x / TIME)
            v = mass / values[0]
            volume += v
            for k, truth in enumerate((exact.density, exact.velocity, exact.pressure)):
                sums[k] += v * abs(values[k] - truth)
        return [s / volume for s in sums]

    def crossing(self, column, value, low, high):
        """Rightmost place in low < x < high where the profile, in bins of 5 mm, falls through a value."""
        bins = {}
        for p in self.particles:
            if low < p[0] < high:
                bins.setdefault(math.floor(p[0] / 0.005), []).append((p[0], p[column]))
        means = [tuple(sum(v) / len(v) for v in zip(*bins[k])) for k in sorted(bins)]
        for (x0, y0), (x1, y1) in reversed(list(zip(means, means[1:]))):
            if y0 >= value > y1:
                return x0 + (x1 - x0) * (y0 - value) / (y0 - y1)
        return math.nan


class Sod(RunTest):
    def test_exact_solution(self):
        """The numbers every textbook gives."""
        self.assertAlmostEqual(EXACT.pressure, 0.3031302, 7)
        self.assertAlmostEqual(EXACT.velocity, 0.9274526, 7)
        self.assertAlmostEqual(EXACT.behind(EXACT.left).density, 0.4263194, 7)
        self.assertAlmostEqual(EXACT.behind(EXACT.right).density, 0.2655737, 7)
        self.assertAlmostEqual(EXACT.shock_speed(), 1.7521557, 7)

    def test_error_and_order(self):
        """With the quintic spline: Wendland C2 with the same 1.3 particles per h underrates gradients by 2.6 % even on a
        perfect lattice, at any resolution, and the shock then lags behind by 1.6 %."""
        errors = {}
        print("\n   spacing   L1 density     velocity     pressure   shock at   contact at")
        for spacing, across in SPACINGS.items():
            height = 17 * spacing
            values = {"resolution.spacing": f"{spacing} m"}
            out = self.run_scene(SOD, f"sod_{across}", {**values, **strip(height)})
            self.assertLess(abs(summary(out)["energy_error_rel"]), 1e-12)
            snapshot, = (out / "snapshots").glob("*.h5")
            profile = Profile(snapshot)
            errors[spacing] = profile.errors()
            right, left = EXACT.behind(EXACT.right).density, EXACT.behind(EXACT.left).density
            shock = profile.crossing(4, 0.5 * (EXACT.pressure + 0.1), 0.25, 0.45)
            contact = profile.crossing(2, 0.5 * (left + right), 0.12, 0.25)
            print(f"{spacing:10} " + " ".join(f"{e:12.5f}" for e in errors[spacing]) + f" {shock:10.4f} {contact:12.4f}")
            self.assertAlmostEqual(shock, EXACT.shock_speed() * TIME, delta=3 * spacing)
            self.assertAlmostEqual(contact, EXACT.velocity * TIME, delta=3 * spacing)
        coarse, middle, fine = errors.values()
        orders = [math.log2(a / b) for a, b in zip(middle, fine)]
        print("     order " + " ".join(f"{o:12.2f}" for o in orders))
        for error, bound in zip(fine, BOUNDS):
            self.assertLess(error, bound)
        for order in orders:
            self.assertGreater(order, 0.7)


def strip(height):
    """The scene with another height: --set values."""
    return {"bodies.left.size": f"0.51 {height} m", "bodies.right.size": f"0.51 {height} m",
            "boundary.min": f"-0.51 {-height / 2} m", "boundary.max": f"0.51 {height / 2} m"}



if __name__ == "__main__":
    unittest.main()
