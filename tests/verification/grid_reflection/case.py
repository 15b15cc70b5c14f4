"""A planar shock of Mach 10 meets a wall at an angle: by two shocks up to a known angle, beyond with a Mach stem."""
import numpy as np

from exact.reflection import detachment, normal, regular
from harness import Bound, GridCase, fall, relative

GAMMA, MACH = 1.4, 10.0
WIDTH, HEIGHT, FOOT = 3.2, 2.4, 2.6  # m; the foot of the incident shock gets as far as that


class Reflection(GridCase):
    """Resolution: cells in 1 m. The shock leans by `angle` degrees from the wall."""
    scene = "../../../inputs/double_mach.toml"
    quick = (40, 80)
    full = (40, 80, 160)
    exact = "reflection by two shocks (von Neumann 1943), normal shock"
    rotation = "the wall is a face of the box"
    momentum = mass = 1e-12

    @property
    def lean(self):
        return np.radians(self.angle)

    @property
    def speed(self):
        """Of the foot of the incident shock along the wall [m/s]; the sound speed ahead is 1 m/s."""
        return MACH / np.sin(self.lean)

    def settings(self, resolution):
        slope, speed = np.tan(self.lean), 8.25  # of the gas behind the shock
        behind = f"x < y / {slope!r}"
        velocity = f'["{behind} ? {speed * np.sin(self.lean)!r} : 0", "{behind} ? {-speed * np.cos(self.lean)!r} : 0"]'
        return {"resolution.spacing": (1 / resolution, "m"), "time.end": (FOOT / self.speed, "s"), "insitu.enabled": False,
                "bodies.gas.center": (WIDTH / 2, HEIGHT / 2, "m"), "bodies.gas.size": (WIDTH, HEIGHT, "m"),
                "boundary.max": (WIDTH, HEIGHT, "m"), "bodies.gas.profile.density": f'"{behind} ? 8 : 1.4"',
                "bodies.gas.profile.pressure": f'"{behind} ? 116.5 : 1"', "bodies.gas.profile.velocity": velocity}

    def wall(self, run):
        """x and pressure of the cells along the wall."""
        state = run.final
        row = state["position"][:, 1] == state["position"][:, 1].min()
        order = np.argsort(state["position"][row, 0])
        return state["position"][row, 0][order], state["pressure"][row][order]

    def check_exact(self):
        """Strong shocks part with the wall at 39.97 degrees (von Neumann), those of Mach 10 somewhat later."""
        assert abs(np.degrees(detachment(1000, GAMMA)) - 39.97) < 0.05, np.degrees(detachment(1000, GAMMA))
        assert (regular(MACH, self.lean, GAMMA) is not None) == self.by_two


class Regular(Reflection):
    name = "grid_reflection_regular"
    title = "a shock of Mach 10 at 38 degrees from a wall: regular reflection"
    angle, by_two = 38.0, True
    bounds = (  # measured and 15 %
        Bound("foot", "spacings", 0.96, why="half of the pressure behind both shocks, which are some cells wide"),
        Bound("pressure at the wall", "relative", {40: 0.021, 80: 0.0039, 160: 0.0044}, why="next to the sonic point, behind which the flow is not uniform"),
    )

    def errors(self, run, resolution):
        """Where the shock meets the wall; pressure on the wall behind it, from 0.1 to 0.4 m."""
        x, pressure = self.wall(run)
        expected = regular(MACH, self.lean, GAMMA)
        behind = (FOOT - 0.4 < x) & (x < FOOT - 0.1)
        return {("foot", "spacings"): abs(fall(x, pressure, 0.5 * expected) - FOOT) * resolution,
                ("pressure at the wall", "relative"): relative(pressure[behind].mean(), expected)}


class Stem(Reflection):
    name = "grid_reflection_mach"
    title = "a shock of Mach 10 at 45 degrees from a wall: Mach reflection"
    angle, by_two = 45.0, False
    bounds = (  # measured and 15 %
        Bound("pressure behind the stem", "relative", {40: 0.055, 80: 0.086, 160: 0.078}, why="a jet along the wall pushes at a stem of 5 to 20 cells"),
        Bound("stem behind the incident shock", "m", 1e-12, why="it runs ahead, or there is none"),
    )

    def errors(self, run, resolution):
        """The stem is a normal shock that runs ahead of the incident one: pressure behind it for the speed it has had, and
        against regular reflection."""
        x, pressure = self.wall(run)
        foot = fall(x, pressure, 0.5 * normal(self.speed, GAMMA))
        expected = normal(foot / FOOT * self.speed, GAMMA)
        behind = (foot - 6 / resolution < x) & (x < foot - 3 / resolution)
        return {("pressure behind the stem", "relative"): relative(pressure[behind].mean(), expected),
                ("stem behind the incident shock", "m"): max(0.0, FOOT - foot)}


CASES = [Regular(), Stem()]
