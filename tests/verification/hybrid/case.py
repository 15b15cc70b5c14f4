"""The blast of 1 kt with particles where its front is, on a grid: the same problem, the same errors as on a grid alone."""
import numpy as np

from exact.riemann import Gas, ShockTube
from grid_blast.case import GridBlast
from grid_tubes.case import Tube
from harness import Bound
from sod.case import Sod

class HybridBlast(GridBlast):
    """Resolution: particles in 8 m; cells of the grid are twice as wide."""
    name = "hybrid_blast"
    title = "blast of 1 kt, a cylinder, a quarter of it, particles at its front, t = 1 ms"
    scene = "../../../inputs/blast_hybrid.toml"
    quick = (20,)
    full = (20, 40)
    small = {"time.end": "70 us"}
    rotation = "a quarter, whose other faces are not given"
    bounds = ()


class HybridSod(Tube, Sod):
    """Resolution: particles in half of the tube."""
    name = "hybrid_sod"
    title = "Sod's shock tube, particles at the shock, t = 0.2 s"
    quick = (100, 200)
    full = (50, 100, 200, 400)
    time = 0.2
    bounds = ()

    def cells(self, resolution):
        return resolution  # of the grid

    def settings(self, resolution):
        settings = super().settings(resolution)
        spacing, unit = settings["resolution.spacing"]
        return {**settings, "numerics.scheme": "hybrid", "resolution.spacing": (spacing / 2, unit)}


CASES = [HybridBlast(), HybridSod()]
