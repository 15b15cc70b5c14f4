"""Sedov's explosion on a grid, measured as that of the particles."""
from harness import Bound, GridCase
from sedov.case import NO_NEGATIVE_ENERGY, SedovCylindrical, SedovSpherical


class GridSedovCylindrical(GridCase, SedovCylindrical):
    """Resolution: cells in 1 m."""
    name = "grid_sedov_cylindrical"
    title = "Sedov's problem on a grid, cylindrical, shock at 0.8 m"
    quick = (25, 50)
    full = (25, 50, 100, 200)
    bounds = (  # measured and 15 %
        Bound("density", "L1", {50: 0.096, 200: 0.032}, 0.6),
        Bound("velocity", "L1", {50: 0.02, 200: 0.0073}, 0.65),
        Bound("pressure", "L1", {50: 0.013, 200: 0.0041}, 0.7),
        Bound("shock radius", "relative", {50: 0.0049, 200: 0.0028}, why="of the order of a tenth of a spacing"),
        Bound("peak density", "relative", {50: 0.27, 200: 0.11}, 0.55),
        NO_NEGATIVE_ENERGY,
    )


class GridSedovSpherical(GridCase, SedovSpherical):
    """Resolution: cells in 1 m."""
    name = "grid_sedov_spherical"
    title = "Sedov's problem on a grid, spherical, shock at 0.8 m"
    quick = (16, 24)
    full = (16, 24, 40)
    bounds = (  # measured and 15 %
        Bound("density", "L1", {24: 0.17, 40: 0.13}, 0.4),
        Bound("velocity", "L1", {24: 0.04, 40: 0.027}, 0.65),
        Bound("pressure", "L1", {24: 0.025, 40: 0.017}, 0.6),
        Bound("shock radius", "relative", {24: 0.005, 40: 0.0036}, 0.95),
        Bound("peak density", "relative", {24: 0.49, 40: 0.37}, 0.3),
        NO_NEGATIVE_ENERGY,
    )


CASES = [GridSedovCylindrical(), GridSedovSpherical()]
