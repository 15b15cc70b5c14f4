"""Noh's problem: cold gas runs with unit speed into a wall, an axis or a point (Noh 1987, J. Comput. Phys. 72, 78)."""
import numpy as np


class Noh:
    """Dimension nu is 1 (plane), 2 (cylinder) or 3 (sphere); unit density at the start."""

    def __init__(self, nu, gamma=5 / 3):
        self.nu, self.gamma = nu, gamma
        self.shock_speed = (gamma - 1) / 2
        self.density = ((gamma + 1) / (gamma - 1)) ** nu
        self.pressure = (gamma - 1) * self.density / 2

    def at(self, r, t):
        """Density, speed inwards, pressure and specific energy at distances r > 0 from the wall."""
        shocked = r < self.shock_speed * t
        return (np.where(shocked, self.density, (1 + t / r) ** (self.nu - 1)), np.where(shocked, 0.0, 1.0),
                np.where(shocked, self.pressure, 0.0), np.where(shocked, 0.5, 0.0))
