"""Gas dynamics in one dimension by a Godunov scheme, for problems without a closed solution.

MUSCL-Hancock (Toro 2009, section 14.4) with van Leer's limiter on density, velocity and pressure, and the HLLC solver
with Davis' wave speeds (sections 10.4, 10.5), between reflecting walls.
"""
from functools import lru_cache

import numpy as np


@lru_cache
def two_blast_waves(cells, time=0.038, gamma=1.4):
    """Woodward & Colella (1984): cell centres, density, velocity and pressure at the time."""
    x = (np.arange(cells) + 0.5) / cells
    w = np.array([np.ones(cells), np.zeros(cells), np.where(x < 0.1, 1000.0, np.where(x > 0.9, 100.0, 0.01))])
    return x, *advance(w, 1 / cells, time, gamma)


def advance(w, dx, end, gamma, courant=0.4):
    """Takes density, velocity and pressure w of cells of width dx to a time."""
    u, time = conserved(w, gamma), 0.0
    while time < end:
        dt = min(courant * dx / np.max(np.abs(w[1]) + np.sqrt(gamma * w[2] / w[0])), end - time)
        g = np.concatenate([mirror(w[:, 1::-1]), w, mirror(w[:, :-3:-1])], axis=1)  # two more cells behind each wall
        a, b = g[:, 1:-1] - g[:, :-2], g[:, 2:] - g[:, 1:-1]
        slope = np.where(a * b > 0, 2 * a * b / np.where(a * b > 0, a + b, 1), 0)
        left, right = g[:, 1:-1] - slope / 2, g[:, 1:-1] + slope / 2
        half = dt / (2 * dx) * (flux(left, gamma) - flux(right, gamma))
        left, right = (primitive(conserved(side, gamma) + half, gamma) for side in (left, right))
        f = hllc(right[:, :-1], left[:, 1:], gamma)
        u = u + dt / dx * (f[:, :-1] - f[:, 1:])
        w, time = primitive(u, gamma), time + dt
    return w


def mirror(w):
    return w * np.array([[1], [-1], [1]])


def conserved(w, gamma):
    return np.array([w[0], w[0] * w[1], w[2] / (gamma - 1) + w[0] * w[1] ** 2 / 2])


def primitive(u, gamma):
    return np.array([u[0], u[1] / u[0], (gamma - 1) * (u[2] - u[1] ** 2 / u[0] / 2)])


def flux(w, gamma):
    energy = w[2] / (gamma - 1) + w[0] * w[1] ** 2 / 2
    return np.array([w[0] * w[1], w[0] * w[1] ** 2 + w[2], w[1] * (energy + w[2])])


def hllc(a, b, gamma):
    """Flux between states a on the left and b on the right."""
    ca, cb = np.sqrt(gamma * a[2] / a[0]), np.sqrt(gamma * b[2] / b[0])
    sa, sb = np.minimum(a[1] - ca, b[1] - cb), np.maximum(a[1] + ca, b[1] + cb)
    da, db = a[0] * (sa - a[1]), b[0] * (sb - b[1])
    contact = (b[2] - a[2] + a[1] * da - b[1] * db) / (da - db)

    def star(w, s, d):
        u, density = conserved(w, gamma), d / (s - contact)
        energy = u[2] / w[0] + (contact - w[1]) * (contact + w[2] / d)
        return flux(w, gamma) + s * (density * np.array([np.ones_like(s), contact, energy]) - u)

    return np.where(sa > 0, flux(a, gamma), np.where(contact > 0, star(a, sa, da),
                    np.where(sb > 0, star(b, sb, db), flux(b, gamma))))
