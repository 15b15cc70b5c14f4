"""Psi0 against n_h: the sum that the pair pass makes on a lattice and the h that follows, against exact lattice sums."""
import itertools

import numpy as np

from harness import Bound, Case

SUPPORT = {"cubic_spline": 2, "quintic_spline": 3, "wendland_c2": 2, "wendland_c4": 2}


def kernel(name, q):
    """W without its normalisation, as in the literature (Monaghan 2005; Dehnen & Aly 2012, support 2h)."""
    rest = np.clip(1 - q / 2, 0, None)
    if name == "cubic_spline":
        return np.clip(2 - q, 0, None)**3 / 4 - np.clip(1 - q, 0, None)**3
    if name == "quintic_spline":
        return np.clip(3 - q, 0, None)**5 - 6 * np.clip(2 - q, 0, None)**5 + 15 * np.clip(1 - q, 0, None)**5
    return rest**4 * (1 + 2 * q) if name == "wendland_c2" else rest**6 * (1 + 3 * q + 35 / 12 * q * q)


def exact_psi0(name, dimension, nodes_per_h):
    """(sum over the lattice of |dW/deta|)^(1/dimension), Owen (2010), eq. 1; the slope by central differences."""
    reach = range(-int(SUPPORT[name] * nodes_per_h) - 1, int(SUPPORT[name] * nodes_per_h) + 2)
    sites = np.array(list(itertools.product(reach, repeat=dimension)))
    eta = np.linalg.norm(sites, axis=1) / nodes_per_h
    eta, step = eta[eta > 0], 1e-5
    return np.abs((kernel(name, eta + step) - kernel(name, eta - step)) / (2 * step)).sum() ** (1 / dimension)


class Psi0(Case):
    """Resolution: 100 n_h."""
    exact = "sums over the square and cubic lattice (Owen 2010, eq. 1 and Fig. 3), worked out again"
    quick, full = (130, 200), (100, 120, 130, 150, 175, 200, 225, 250, 275, 300, 350, 400)
    rotation = boost = mixed_margin = "nothing moves"
    small = {"time.max_steps": 1}
    bounds = (Bound("psi0", "relative", 1e-5, why="the table between its entries"),
              Bound("h", "relative", 1e-5, why="the same"))

    def __init__(self, kernel_name, dimension):
        self.kernel, self.dimension = kernel_name, dimension
        self.name = f"psi0_{kernel_name}_{dimension}d"
        self.title = f"zeroth moment of a lattice, {kernel_name}, {dimension}D"

    def settings(self, resolution):
        edge = 2 * int(SUPPORT[self.kernel] * resolution / 100) + 4  # m; more than the width of the support
        settings = {"numerics.kernel": self.kernel, "numerics.nodes_per_h": resolution / 100,
                    "scene.dimension": self.dimension, "bodies.gas.size": (edge,) * self.dimension + ("m",),
                    "boundary.min": (-edge / 2,) * self.dimension + ("m",),
                    "boundary.max": (edge / 2,) * self.dimension + ("m",)}
        if self.dimension == 3:
            settings |= {"boundary.z": "periodic", "bodies.gas.shape": "box"}
        return settings

    def errors(self, run, resolution):
        state, nodes_per_h = run.final, resolution / 100
        psi0 = state["zeroth_moment"] ** (1 / self.dimension)
        exact = exact_psi0(self.kernel, self.dimension, nodes_per_h)
        return {("psi0", "relative"): np.abs(psi0 / exact - 1).max(),
                ("h", "relative"): np.abs(state["smoothing_length"] / nodes_per_h - 1).max()}


CASES = [Psi0(kernel_name, dimension) for kernel_name in SUPPORT for dimension in (2, 3)]
