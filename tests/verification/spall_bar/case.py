"""Basalt pulled apart at steady rates: the strength that its cracks leave, in particles of any size."""
import numpy as np

from exact.grady_kipp import Rock
from harness import Bound, Case, execute, relative

WIDTH, MIDDLE = 0.006, 0.006  # m; m on either side that no release wave reaches
FASTEST = 5000  # m/s, of the waves
FLAWS = {2: "5e31 1/m^3", 3: "5e34 1/m^3"}  # in plane strain per m^2, each through a metre
BASALT = {dim: Rock(2700, 22.7e9, 26.7e9, 8.5, float(k.split()[0]), 0.4) for dim, k in FLAWS.items()}


def stretched(rate, spacing, dim, end):
    """Settings of a bar long enough that release waves stay out of its middle. Its faces are periodic."""
    length, width = 2 * spacing * round((FASTEST * end + MIDDLE) / spacing + 8), max(6 * spacing, WIDTH)
    bar = {"resolution.spacing": (spacing, "m"), "time.end": (end, "s"),
           "materials.basalt_von_mises.damage.weibull_k": FLAWS[dim]}
    if dim == 3:
        return {**bar, "bodies.bar.size": (length, width, width, "m"),
                "bodies.bar.profile.velocity": f'["{rate}*x", "0", "0"]',
                "boundary.min": (0, -width / 2, -width / 2, "m"), "boundary.max": (0, width / 2, width / 2, "m")}
    width *= 2  # fewer particles than in space, and as many cracks
    return {**bar, "scene.dimension": 2, "bodies.bar.shape": "rectangle", "bodies.bar.size": (length, width, "m"),
            "bodies.bar.profile.velocity": f'["{rate}*x", "0"]', "boundary.z": "open",
            "boundary.min": (0, -width / 2, "m"), "boundary.max": (0, width / 2, "m")}


def mean_stress(state):
    stress = (1 - state["damage"]) * state["deviatoric_stress"][:, 0] - state["pressure"]
    return stress[np.abs(state["position"][:, 0]) < MIDDLE].mean()


class Pulled(Case):
    rotation = "flaws belong to places: a turned bar has others"
    boost = "y"
    exact = "Grady & Kipp (1980): every crack relieves a sphere (in plane strain a disc) of its own size"

    def check_exact(self):
        """The closed form against the integral over the cracks, the maximum against its neighbours."""
        for dim, rock in BASALT.items():
            strength, time = rock.strength(1e4, dim)
            assert np.isclose(rock.integrated_damage(1e4, time, dim), rock.damage(1e4, time, dim), rtol=1e-6)
            assert np.isclose(rock.damage(1e4, time, dim), 1 / (rock.m + dim + 1))
            around = [rock.modulus * 1e4 * t * (1 - rock.damage(1e4, t, dim)) for t in (0.99 * time, time, 1.01 * time)]
            assert np.isclose(around[1], strength) and max(around) == around[1]
            assert np.isclose(np.log10(rock.strength(1e5, dim)[0] / rock.strength(1e2, dim)[0]) / 3, dim / (8.5 + dim))


class SpallStrength(Pulled):
    """Resolution: the strain rate [1/s]."""
    full = (400, 1300, 4000, 13000, 40000, 130000)
    small = {"time.max_steps": 40}
    bounds = (Bound("peak stress", "to Grady & Kipp", 0.1, why="what is asked at all sizes and rates"),)

    def __init__(self, dim, spacing, quick=()):
        self.dim, self.spacing, self.quick = dim, spacing, quick
        self.name = f"spall_strength_{dim}d_{spacing * 1e6:.0f}um"
        self.title = f"largest mean stress of basalt in particles of {spacing * 1e3:g} mm, {dim}D, against strain rate"

    def settings(self, rate):
        return stretched(rate, self.spacing, self.dim, 1.5 * BASALT[self.dim].strength(rate, self.dim)[1])

    def errors(self, run, rate):
        strength, _ = Rock.of(run.scene, "basalt_von_mises").strength(rate, self.dim)
        peak = max(mean_stress(state) for state in run.states)
        print(f"{rate}/s: {peak / 1e6:.2f} MPa, {peak / strength:.4f} of Grady & Kipp's")
        return {("peak stress", "to Grady & Kipp"): relative(peak, strength)}


class CrackGrowth(Pulled):
    """Resolution: time steps per crossing of h, 1/courant; 4 is the usual one."""
    exact = "the same bar in steps of courant 1/64"
    quick = full = (4, 8, 16)
    boost = mixed_margin = "shown by spall_strength"
    bounds = (Bound("peak stress", "to fine steps", 0.01, why="what is asked of the usual step"),)

    def __init__(self, rate):
        self.rate = rate
        self.name = f"crack_growth_{rate}"
        self.title = f"stress of basalt stretched at {rate}/s until it is largest, in few steps"

    def settings(self, resolution):
        end = BASALT[3].strength(self.rate, 3)[1]
        return {**stretched(self.rate, 0.001, 3, end), "output.snapshots": 1, "numerics.courant": 1 / resolution}

    def errors(self, run, resolution):
        fine = execute(run.folder / "resolved.toml", {"numerics.courant": 1 / 64}, run.folder / "fine")
        print(f"{run.summary['steps']} steps against {fine.summary['steps']}")
        assert run.summary["steps"] < fine.summary["steps"], "these are the same steps"
        return {("peak stress", "to fine steps"): relative(mean_stress(run.final), mean_stress(fine.final))}


CASES = [*(SpallStrength(3, spacing, (13000, 130000) if spacing == 1e-3 else ()) for spacing in (0.5e-3, 1e-3, 2e-3)),
         *(SpallStrength(2, spacing, (130000,) if spacing == 1e-3 else ()) for spacing in (0.5e-3, 1e-3, 2e-3)),
         CrackGrowth(130000), CrackGrowth(13000)]
