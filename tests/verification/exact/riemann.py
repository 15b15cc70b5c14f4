"""Exact solution of the shock tube of an ideal gas (Toro 2009, Riemann Solvers and Numerical Methods, chapter 4)."""
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq


@dataclass(frozen=True)
class Gas:
    density: float  # kg/m^3
    velocity: float  # m/s
    pressure: float  # Pa


class ShockTube:
    """The wall at x = 0 between two gases is removed at t = 0. Any pair of shocks and rarefactions, no vacuum."""

    def __init__(self, left, right, gamma):
        self.left, self.right, self.gamma = left, right, gamma
        low, high = 1e-12 * min(left.pressure, right.pressure), 1e3 * max(left.pressure, right.pressure)
        total = lambda p: self._change(left, p) + self._change(right, p) + right.velocity - left.velocity
        self.pressure = brentq(total, low, high, xtol=1e-300, rtol=1e-14)  # between the waves (eq. 4.5)
        self.velocity = 0.5 * (left.velocity + right.velocity + self._change(right, self.pressure)
                               - self._change(left, self.pressure))

    def _sound(self, gas):
        return np.sqrt(self.gamma * gas.pressure / gas.density)

    def _change(self, gas, p):
        """Change of velocity across the wave that takes a gas to pressure p (eqs 4.6, 4.7)."""
        g = self.gamma
        if p > gas.pressure:
            a, b = 2 / ((g + 1) * gas.density), (g - 1) / (g + 1) * gas.pressure
            return (p - gas.pressure) * np.sqrt(a / (p + b))
        return 2 * self._sound(gas) / (g - 1) * ((p / gas.pressure) ** ((g - 1) / (2 * g)) - 1)

    def behind(self, gas):
        """The gas after its wave has passed (eqs 4.50, 4.53)."""
        g, ratio = self.gamma, self.pressure / gas.pressure
        k = (g - 1) / (g + 1)
        density = gas.density * ((ratio + k) / (k * ratio + 1) if ratio > 1 else ratio ** (1 / g))
        return Gas(density, self.velocity, self.pressure)

    def _edges(self, gas, side):
        """Speeds of the outer and the inner edge of a wave; side is -1 for the left one. They agree in a shock."""
        g, ratio, c = self.gamma, self.pressure / gas.pressure, self._sound(gas)
        if ratio > 1:
            speed = gas.velocity + side * c * np.sqrt((g + 1) / (2 * g) * ratio + (g - 1) / (2 * g))  # eq. 4.59
            return speed, speed
        return gas.velocity + side * c, self.velocity + side * self._sound(self.behind(gas))

    def shock_speed(self):
        """Of the wave to the right."""
        return self._edges(self.right, 1)[0]

    def at(self, speed):
        """Density, velocity and pressure at x/t = speed (section 4.5), for arrays."""
        speed, g = np.asarray(speed, float), self.gamma
        density, velocity, pressure = (np.empty_like(speed) for _ in range(3))
        for gas, side, mask in ((self.left, -1, speed < self.velocity), (self.right, 1, speed >= self.velocity)):
            outer, inner = self._edges(gas, side)
            after, c = self.behind(gas), self._sound(gas)
            fan = 2 / (g + 1) + (g - 1) / ((g + 1) * c) * side * (speed - gas.velocity)  # c/c0, eqs 4.56, 4.63
            fan = np.maximum(fan, 0)
            inside = mask & (side * (speed - inner) > 0)  # the wave and what is ahead of it
            ahead = mask & (side * (speed - outer) > 0)
            for values, behind, in_fan, before in (
                    (density, after.density, gas.density * fan ** (2 / (g - 1)), gas.density),
                    (velocity, after.velocity, gas.velocity + side * 2 * c / (g - 1) * (fan - 1), gas.velocity),
                    (pressure, after.pressure, gas.pressure * fan ** (2 * g / (g - 1)), gas.pressure)):
                values[mask] = behind
                values[inside] = in_fan[inside]
                values[ahead] = before
        return density, velocity, pressure
