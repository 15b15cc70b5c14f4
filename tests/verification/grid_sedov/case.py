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
        Bound("density", "L1", {50: 0.13, 200: 0.041}, 0.5),
        Bound("velocity", "L1", {50: 0.024, 200: 0.0079}, 0.75),
        Bound("pressure", "L1", {50: 0.016, 200: 0.0052}, 0.65),
        Bound("shock radius", "relative", {50: 0.0071, 200: 0.0037}, why="of the order of a tenth of a spacing"),
        Bound("peak density", "relative", {50: 0.3, 200: 0.12}, 0.5),
        NO_NEGATIVE_ENERGY,
    )


class GridSedovSpherical(GridCase, SedovSpherical):
    """Resolution: cells in 1 m."""
    name = "grid_sedov_spherical"
    title = "Sedov's problem on a grid, spherical, shock at 0.8 m"
    quick = (16, 24)
    full = (16, 24, 40)
    bounds = (  # measured and 15 %
        Bound("density", "L1", {24: 0.2, 40: 0.17}, 0.35),
        Bound("velocity", "L1", {24: 0.051, 40: 0.033}, 0.7),
        Bound("pressure", "L1", {24: 0.03, 40: 0.022}, 0.55),
        Bound("shock radius", "relative", {24: 0.0059, 40: 0.0054}, 1.3),
        Bound("peak density", "relative", {24: 0.54, 40: 0.41}, 0.3),
        NO_NEGATIVE_ENERGY,
    )


CASES = [GridSedovCylindrical(), GridSedovSpherical()]
