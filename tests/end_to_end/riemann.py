"""Exact solution of the shock tube of an ideal gas (Toro 2009, Riemann Solvers and Numerical Methods, chapter 4)."""
import math
from dataclasses import dataclass


@dataclass
class Gas:
    density: float  # kg/m^3
    velocity: float  # m/s
    pressure: float  # Pa


class ShockTube:
    """The wall at x = 0 between two gases is removed at t = 0."""

    def __init__(self, left, right, gamma):
        self.left, self.right, self.gamma = left, right, gamma
        low, high = 1e-12 * min(left.pressure, right.pressure), 100 * max(left.pressure, right.pressure)
        for _ in range(200):
            p = 0.5 * (low + high)
            if self._change(left, p) + self._change(right, p) + right.velocity - left.velocity > 0:
                high = p
            else:
                low = p
        self.pressure = p  # between the waves
        self.velocity = 0.5 * (left.velocity + right.velocity + self._change(right, p) - self._change(left, p))

    def _sound(self, gas):
        return math.sqrt(self.gamma * gas.pressure / gas.density)

    def _change(self, gas, p):
        """Change of velocity across the wave that takes a gas to pressure p (eqs 4.6, 4.7)."""
        g = self.gamma
        if p > gas.pressure:
            a, b = 2 / ((g + 1) * gas.density), (g - 1) / (g + 1) * gas.pressure
            return (p - gas.pressure) * math.sqrt(a / (p + b))
        return 2 * self._sound(gas) / (g - 1) * ((p / gas.pressure) ** ((g - 1) / (2 * g)) - 1)

    def behind(self, gas):
        """The gas after its wave has passed (eqs 4.50, 4.53)."""
        g, ratio = self.gamma, self.pressure / gas.pressure
        k = (g - 1) / (g + 1)
        density = gas.density * ((ratio + k) / (k * ratio + 1) if ratio > 1 else ratio ** (1 / g))
        return Gas(density, self.velocity, self.pressure)

    def shock_speed(self):
        """Of the wave to the right, which must be a shock (eq. 4.59)."""
        g = self.gamma
        ratio = self.pressure / self.right.pressure
        return self.right.velocity + self._sound(self.right) * math.sqrt((g + 1) / (2 * g) * ratio + (g - 1) / (2 * g))

    def at(self, speed):
        """State at x/t = speed, for a rarefaction to the left and a shock to the right (section 4.5)."""
        g, left = self.gamma, self.left
        if speed > self.shock_speed():
            return self.right
        if speed > self.velocity:
            return self.behind(self.right)
        after, c = self.behind(left), self._sound(left)
        if speed < left.velocity - c:
            return left
        if speed > self.velocity - self._sound(after):
            return after
        fan = 2 / (g + 1) + (g - 1) / ((g + 1) * c) * (left.velocity - speed)
        return Gas(left.density * fan ** (2 / (g - 1)), 2 / (g + 1) * (c + (g - 1) / 2 * left.velocity + speed),
                   left.pressure * fan ** (2 * g / (g - 1)))
