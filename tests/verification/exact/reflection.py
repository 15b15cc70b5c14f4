"""Reflection of a planar shock by two shocks, steady where both meet the wall (von Neumann 1943), in an ideal gas."""
import numpy as np
from scipy.optimize import brentq, minimize_scalar


def oblique(mach, wave, gamma):
    """Behind a shock at this angle [rad] to a stream: (deflection [rad], ratio of pressures, Mach number)."""
    normal2 = (mach * np.sin(wave)) ** 2
    deflection = np.arctan(2 / np.tan(wave) * (normal2 - 1) / (mach ** 2 * (gamma + np.cos(2 * wave)) + 2))
    pressure = 1 + 2 * gamma / (gamma + 1) * (normal2 - 1)
    behind2 = (1 + 0.5 * (gamma - 1) * normal2) / (gamma * normal2 - 0.5 * (gamma - 1))
    return deflection, pressure, np.sqrt(behind2) / np.sin(wave - deflection)


def regular(mach, angle, gamma):
    """Pressure behind the reflected shock over that ahead of the incident one, which makes this angle [rad] with the wall;
    None where two shocks cannot turn the stream back along the wall. `mach` of the incident shock."""
    deflection, first, behind = oblique(mach / np.sin(angle), angle, gamma)
    if behind <= 1:
        return None
    least = np.arcsin(1 / behind)
    steepest = minimize_scalar(lambda w: -oblique(behind, w, gamma)[0], bounds=(least, np.pi / 2), method="bounded").x
    if oblique(behind, steepest, gamma)[0] < deflection:
        return None
    wave = brentq(lambda w: oblique(behind, w, gamma)[0] - deflection, least, steepest)
    return first * oblique(behind, wave, gamma)[1]


def detachment(mach, gamma):
    """The largest angle [rad] between shock and wall at which two shocks are enough."""
    low, high = np.radians(5), np.radians(85)
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if regular(mach, middle, gamma) is None else (middle, high)
    return low


def normal(mach, gamma):
    """Ratio of pressures of a normal shock."""
    return 1 + 2 * gamma / (gamma + 1) * (mach ** 2 - 1)
