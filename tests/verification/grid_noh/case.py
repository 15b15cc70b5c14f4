"""Noh's problem on a grid, measured as that of the particles."""
from harness import Bound, GridCase
from noh.case import NO_NEGATIVE_ENERGY, NohCylindrical, NohPlanar, NohSpherical

ROWS = 4


class GridNohPlanar(GridCase, NohPlanar):
    """Resolution: cells in 1 m."""
    name = "grid_noh_planar"
    title = "Noh's problem on a grid, planar, t = 0.6 s"
    full = (25, 50, 100, 200, 400)
    bounds = (  # measured and 15 %
        Bound("density", "L1", {100: 0.011, 400: 0.012}, 0.9),
        Bound("density", "Linf", 0.51, why="a cell inside the shock, whose width is a number of cells"),
        Bound("velocity", "L1", {100: 0.0087, 400: 0.0026}, 1),
        Bound("velocity", "Linf", 0.37, why="a cell inside the shock, whose width is a number of cells"),
        Bound("pressure", "L1", {100: 0.006, 400: 0.0021}, 1),
        Bound("pressure", "Linf", 0.25, why="a cell inside the shock, whose width is a number of cells"),
        Bound("energy", "L1", {100: 0.0043, 400: 0.0022}, 0.95),
        Bound("energy", "Linf", 0.26, why="a cell inside the shock, whose width is a number of cells"),
        Bound("plateau density", "relative", {100: 0.0011, 400: 8.8e-05}, 2.25),
        NO_NEGATIVE_ENERGY,
    )

    def settings(self, resolution):
        spacing = 1 / resolution
        height = ROWS * spacing
        return {"resolution.spacing": (spacing, "m"), "bodies.gas.size": (1, height, "m"),
                "boundary.min": (0, -height / 2, "m"), "boundary.max": (1, height / 2, "m")}


class GridNohCylindrical(GridCase, NohCylindrical):
    """Resolution: cells in 1 m."""
    name = "grid_noh_cylindrical"
    title = "Noh's problem on a grid, cylindrical, t = 0.6 s"
    quick = (25, 50, 100)
    full = (25, 50, 100, 200, 400)
    bounds = (  # measured and 15 %
        Bound("density", "L1", {100: 0.19, 400: 0.05}, 0.9),
        Bound("velocity", "L1", {100: 0.018, 400: 0.0045}, 0.7),
        Bound("pressure", "L1", {100: 0.07, 400: 0.019}, 0.85),
        Bound("energy", "L1", {100: 0.0083, 400: 0.0023}, 0.85),
        Bound("plateau density", "relative", {100: 0.015, 400: 0.003}, 0.9),
        NO_NEGATIVE_ENERGY,
    )


class GridNohSpherical(GridCase, NohSpherical):
    """Resolution: cells in 1 m."""
    name = "grid_noh_spherical"
    title = "Noh's problem on a grid, spherical, t = 0.6 s"
    quick = (20, 40)
    full = (20, 40)
    bounds = (  # measured and 15 %
        Bound("density", "L1", {40: 2.3}, 0.7),
        Bound("velocity", "L1", {40: 0.04}, 0.9),
        Bound("pressure", "L1", {40: 0.81}, 0.7),
        Bound("energy", "L1", {40: 0.024}, 0.9),
        Bound("plateau density", "relative", {40: 0.11}, 0.55),
        NO_NEGATIVE_ENERGY,
    )


CASES = [GridNohPlanar(), GridNohCylindrical(), GridNohSpherical()]
