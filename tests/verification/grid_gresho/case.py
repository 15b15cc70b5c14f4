"""Gresho's vortex on a grid, measured as that of the particles."""
from gresho.case import Gresho
from harness import Bound, GridCase


class GridGresho(GridCase, Gresho):
    """Resolution: cells along the box of 1 m."""
    name = "grid_gresho"
    title = "Gresho's vortex on a grid, gamma 5/3, t = 1 s"
    full = (16, 32, 64, 128)
    bounds = (  # measured and 15 %
        Bound("velocity", "L1", {64: 0.012, 128: 0.0041}, 1.35),
        Bound("radial velocity", "L1", {64: 0.0021, 128: 0.00053}, 1.65),
        Bound("peak speed", "relative", {64: 0.11, 128: 0.071}, 0.75),
        Bound("angular momentum", "relative", {64: 0.00035, 128: 0.00012}, 1.95),
    )


CASES = [GridGresho()]
