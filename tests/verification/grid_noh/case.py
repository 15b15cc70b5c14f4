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
        Bound("density", "L1", {100: 0.04, 400: 0.019}, 0.75),
        Bound("density", "Linf", 0.91, why="a cell inside the shock, whose width is a number of cells"),
        Bound("velocity", "L1", {100: 0.02, 400: 0.0049}, 0.9),
        Bound("velocity", "Linf", 0.53, why="a cell inside the shock, whose width is a number of cells"),
        Bound("pressure", "L1", {100: 0.02, 400: 0.0053}, 0.9),
        Bound("pressure", "Linf", 0.39, why="a cell inside the shock, whose width is a number of cells"),
        Bound("energy", "L1", {100: 0.013, 400: 0.0044}, 0.8),
        Bound("energy", "Linf", 0.33, why="a cell inside the shock, whose width is a number of cells"),
        Bound("plateau density", "relative", {100: 0.0017, 400: 0.0002}, 0.6),
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
        Bound("density", "L1", {100: 0.32, 400: 0.073}, 1),
        Bound("velocity", "L1", {100: 0.024, 400: 0.0055}, 1),
        Bound("pressure", "L1", {100: 0.11, 400: 0.026}, 1),
        Bound("energy", "L1", {100: 0.014, 400: 0.0035}, 1),
        Bound("plateau density", "relative", {100: 0.023, 400: 0.0054}, 1.1),
        NO_NEGATIVE_ENERGY,
    )


class GridNohSpherical(GridCase, NohSpherical):
    """Resolution: cells in 1 m."""
    name = "grid_noh_spherical"
    title = "Noh's problem on a grid, spherical, t = 0.6 s"
    quick = (20, 40)
    full = (20, 40)
    bounds = (  # measured and 15 %
        Bound("density", "L1", {40: 4.3}, 1.05),
        Bound("velocity", "L1", {40: 0.078}, 1.45),
        Bound("pressure", "L1", {40: 1.4}, 1.15),
        Bound("energy", "L1", {40: 0.046}, 1.5),
        Bound("plateau density", "relative", {40: 0.19}, 1),
        NO_NEGATIVE_ENERGY,
    )


CASES = [GridNohPlanar(), GridNohCylindrical(), GridNohSpherical()]
