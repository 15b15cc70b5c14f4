"""Power of Monaghan's viscosity in a state, from its formula: what a run does not write down."""
import numpy as np
from scipy.spatial import cKDTree


def slope_wendland_c2(r, h):
    """dW/dr [1/m^4] of W = 21/(16 pi h^3) (1 - q/2)^4 (1 + 2 q), q = r/h, in 3D (Dehnen & Aly 2012)."""
    q = r / h
    return -105 / (16 * np.pi) * q * np.maximum(1 - q / 2, 0) ** 3 / h**4


def with_mirrors(x, v, reach):
    """Places and velocities with their images in the planes x = 0, y = 0, z = 0, and whose image each is."""
    source = np.arange(len(x))
    for axis in range(x.shape[1]):
        near = x[:, axis] < reach
        x, v, source = (np.concatenate([a, a[near]]) for a in (x, v, source))
        first = len(x) - near.sum()
        x[first:, axis] *= -1
        v[first:, axis] *= -1
    return x, v, source


def viscous_power(state, alpha, beta):
    """W: sum over pairs V_i V_j q_ij v_ij.x_ij (x_ij.grad W_ij)/r^2 (src/schemes/pair_pass.hpp), with mu of Monaghan
    (1992, section 4.1, with 0.01 h^2), without switches."""
    h, rho, c = (state[name] for name in ("smoothing_length", "density", "sound_speed"))
    volume = state.volume
    x, v, source = with_mirrors(state["position"], state["velocity"], 2 * h.max())
    pairs = cKDTree(x).query_pairs(2 * h.max(), output_type="ndarray")
    own = len(h)
    pairs = pairs[pairs.min(axis=1) < own]
    a, b = pairs.min(axis=1), pairs.max(axis=1)  # a is no image
    i, j = a, source[b]
    share = np.where(b < own, 1.0, 0.5)  # the other half belongs to the pair on the other side of the mirror
    dx, dv = x[a] - x[b], v[a] - v[b]
    r, approach = np.linalg.norm(dx, axis=1), np.minimum(np.sum(dx * dv, axis=1), 0)
    mean_h = (h[i] + h[j]) / 2
    mu = mean_h * approach / (r**2 + 0.01 * mean_h**2)
    mean_rho = 2 * rho[i] * rho[j] / (rho[i] + rho[j])
    q = mean_rho * (-alpha * (c[i] + c[j]) / 2 * mu + beta * mu**2)
    slope = (slope_wendland_c2(r, h[i]) + slope_wendland_c2(r, h[j])) / 2
    return float(np.sum(share * volume[i] * volume[j] * q * slope * approach / r))
