"""The blast of 1 kt with particles where its front is, on a grid: the same problem, the same errors as on a grid alone."""
from grid_blast.case import GridBlast
from grid_tubes.case import Tube
from harness import Bound
from sod.case import Sod

DEBRIS = "the edge of the debris is unstable, and differs with every particle"


class HybridBlast(GridBlast):
    """Resolution: particles in 8 m; cells of the grid are twice as wide."""
    name = "hybrid_blast"
    title = "blast of 1 kt, a cylinder, a quarter of it, particles at its front, t = 1 ms"
    scene = "../../../inputs/blast_hybrid.toml"
    quick = (20,)
    full = (20, 40)
    small = {"time.end": "70 us"}
    rotation = "a quarter, whose other faces are not given"
    bounds = (  # measured and a quarter more; 0.5 % of the radius is asked at 40
        Bound("shock radius at 56 us", "relative", {20: 0.0095, 40: 0.005}, why="the start, 8 and 17 cells wide"),
        Bound("shock radius at 100 us", "relative", {20: 0.01, 40: 0.005}, why=DEBRIS),
        Bound("shock radius at 225 us", "relative", {20: 0.005, 40: 0.005}, why=DEBRIS),
        Bound("shock radius at 631 us", "relative", {20: 0.005, 40: 0.005}, why=DEBRIS),
        Bound("shock radius at 1000 us", "relative", {20: 0.005, 40: 0.005}, why=DEBRIS),
        Bound("density at 56 us", "L1", {20: 0.38, 40: 0.18}, 0.9),
        Bound("density at 100 us", "L1", {20: 0.29, 40: 0.13}, 0.9),
        Bound("density at 225 us", "L1", {20: 0.2, 40: 0.147}, why=DEBRIS),
        Bound("density at 631 us", "L1", {20: 0.095, 40: 0.049}, 0.75),
        Bound("density at 1000 us", "L1", {20: 0.072, 40: 0.048}, why=DEBRIS),
        Bound("spread of the radius", "relative", {20: 0.0035, 40: 0.005}, why=DEBRIS),
        Bound("peak density", "relative", {20: 0.155, 40: 0.049}, why="of the cells"),
    )


class HybridSod(Tube, Sod):
    """Resolution: particles in half of the tube."""
    name = "hybrid_sod"
    scene = "sod.toml"
    title = "Sod's shock tube, particles at the shock, t = 0.2 s"
    quick = (100, 200)
    full = (50, 100, 200, 400)
    time = 0.2
    bounds = (  # measured and 15 %
        Bound("density", "L1", {100: 0.0078, 200: 0.0029, 400: 0.0024}, 0.75),
        Bound("velocity", "L1", {100: 0.0148, 200: 0.005, 400: 0.0035}, 1),
        Bound("pressure", "L1", {100: 0.0056, 200: 0.00184, 400: 0.00158}, 0.85),
        Bound("shock position", "spacings", 0.35, why="a share of a spacing"),
        Bound("contact position", "spacings", {100: 0.44, 200: 0.44, 400: 0.44}, why="a share of a spacing"),
    )

    def cells(self, resolution):
        return resolution  # of the grid

    def settings(self, resolution):
        settings = super().settings(resolution)
        spacing, unit = settings["resolution.spacing"]
        return {**settings, "numerics.scheme": "hybrid", "resolution.spacing": (spacing / 2, unit),
                "hybrid.jump": 0.2, "hybrid.least_share": 0.02}

    def errors(self, run, resolution):
        assert run.history["particles"][-1] > 0, "the shock has none"
        return super().errors(run, resolution)


CASES = [HybridBlast(), HybridSod()]
