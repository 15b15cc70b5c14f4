"""Links of a stretched body: pairs of neighbours on the starting lattice, and how damaged they were when they came apart.

A link is broken when its two particles are out of each other's reach, |H_i x| and |H_j x| both beyond the support of the
kernel: from then on nothing passes between them directly. Its damage is the larger of the two largest eigenvalues of D.
Fracture is numerical where links without damage break.
"""
import numpy as np
from scipy.spatial import cKDTree

SUPPORT = {"cubic_spline": 2, "wendland_c2": 2, "wendland_c4": 2, "quintic_spline": 3}  # radius in h


def lattice_links(start, spacing, body=0):
    """Index pairs (one row a link) of particles a spacing apart, of matter that can break (the body with this label) on
    one side at least."""
    links = cKDTree(start["position"]).query_pairs(1.2 * spacing, output_type="ndarray")
    return links[(start["body"][links] == body).any(axis=1)]


def reach(state, i, x):
    """|H x| of the particles i."""
    if "smoothing_metric" not in state.names:
        return np.linalg.norm(x, axis=1) / state["smoothing_length"][i]
    g = state["smoothing_metric"][i]
    across = [(0, 1, 2)] if x.shape[1] == 2 else [(0, 1, 3), (0, 2, 4), (1, 2, 5)]
    squares = sum(g[:, k] * x[:, k] ** 2 for k in range(x.shape[1]))
    return np.sqrt(squares + sum(2 * g[:, k] * x[:, a] * x[:, b] for a, b, k in across))


def broken_links(state, links, support):
    """Damage of the links that are broken in a state."""
    i, j = links.T
    x = state["position"][i] - state["position"][j]
    apart = np.minimum(reach(state, i, x), reach(state, j, x)) > support
    return np.maximum(state["damage"][i], state["damage"][j])[apart]
