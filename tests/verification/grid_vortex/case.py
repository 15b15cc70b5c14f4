"""A smooth vortex that the flow carries: the order of the scheme where nothing is in its way."""
import numpy as np

from harness import Bound, GridCase, l1, linf

GAMMA, STRENGTH = 1.4, 5.0


class GridVortex(GridCase):
    """Resolution: cells along the box of 10 m."""
    name = "grid_vortex"
    title = "isentropic vortex on a grid, carried along the diagonal for one period, t = 10 s"
    exact = "it is where it was (Shu 1998): averages over the cells, by Gauss's points"
    quick = (40, 80, 160)
    full = (40, 80, 160)
    bounds = (  # measured and 15 %
        Bound("density", "L1", {160: 9.6e-05}, 2.45),
        Bound("velocity", "L1", {160: 0.00026}, 2.35),
        Bound("pressure", "L1", {160: 0.00012}, 2.6),
        Bound("density", "Linf", {160: 0.002}, 2.4),
    )

    def settings(self, resolution):
        return {"resolution.spacing": (10 / resolution, "m")}

    def errors(self, run, resolution):
        state = run.final
        density, velocity, pressure = averages(state["position"], 10 / resolution)
        return {("density", "L1"): l1(state["density"], density, state.volume),
                ("velocity", "L1"): l1(state["velocity"][:, 0], velocity[:, 0], state.volume),
                ("pressure", "L1"): l1(state["pressure"], pressure, state.volume),
                ("density", "Linf"): linf(state["density"], density)}

    def check_exact(self):
        """The pressure balances the centrifugal force."""
        r = np.linspace(0.1, 4.9, 49)
        density, _, around, _ = vortex(r, 0.0)
        rise = (vortex(r + 1e-4, 0.0)[3] - vortex(r - 1e-4, 0.0)[3]) / 2e-4
        assert np.allclose(rise, density * (around - 1) ** 2 / r, atol=1e-8)


def vortex(x, y):
    """Density, velocity along x and y, pressure."""
    r2 = x * x + y * y
    spin = STRENGTH / (2 * np.pi) * np.exp(0.5 * (1 - r2))
    heat = 1 - (GAMMA - 1) / (2 * GAMMA) * spin * spin
    return heat ** (1 / (GAMMA - 1)), 1 - y * spin, 1 + x * spin, heat ** (GAMMA / (GAMMA - 1))


def averages(centres, spacing):
    """Density, velocity and pressure of the mean mass, momentum and energy of cells."""
    points, weights = np.polynomial.legendre.leggauss(4)
    sums = np.zeros((4, len(centres)))
    for a, wa in zip(points, weights):
        for b, wb in zip(points, weights):
            density, u, v, pressure = vortex(*(centres + 0.5 * spacing * np.array([a, b])).T)
            sums += 0.25 * wa * wb * np.array([density, density * u, density * v,
                                               pressure / (GAMMA - 1) + 0.5 * density * (u * u + v * v)])
    density, velocity = sums[0], (sums[1:3] / sums[0]).T
    return density, velocity, (GAMMA - 1) * (sums[3] - 0.5 * density * np.sum(velocity ** 2, axis=1))


CASES = [GridVortex()]
