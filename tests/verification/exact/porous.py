"""P-alpha porosity: the crush curve of a run, and the waves that a wall sends into a bar of its material.

P = P_s(alpha rho, e)/alpha with the solid's P_s (Carroll & Holt 1972, J. Appl. Phys. 43, 1626). The pores of the
program are rigid up to P_e: alpha = alpha0 there, so that its elastic waves are those of the solid.
"""
import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from harness.run import number

from .tillotson import Tillotson


@dataclass(frozen=True)
class CrushCurve:
    """alpha(P) = 1 + first ((P_t - P)/(P_t - P_e))^n1 [below P_t] + second ((P_s - P)/(P_s - P_e))^n2 (Jutzi, Benz &
    Michel 2008, Icarus 198, 242), both amplitudes scaled so that the curve starts at the alpha0 of the body."""
    alpha0: float
    elastic: float  # P_e [Pa]
    transition: float  # P_t
    solid: float  # P_s
    first: float
    second: float
    n1: int
    n2: int

    @staticmethod
    def quadratic(alpha0, elastic, solid):
        return CrushCurve(alpha0, elastic, elastic, solid, 0.0, alpha0 - 1, 1, 2)

    @staticmethod
    def two_power(alpha0, alpha_e, alpha_t, elastic, transition, solid, n1, n2):
        scale = (alpha0 - 1) / (alpha_e - 1)
        first, second = scale * (alpha_e - alpha_t), scale * (alpha_t - 1)
        return CrushCurve(alpha0, elastic, transition, solid, first, second, n1, n2)

    @staticmethod
    def of(scene, material):
        p = scene["materials"][material]["porosity"]
        alpha0, elastic = p["initial_distension"], number(p["elastic_pressure"])
        solid = number(p["solid_pressure"])
        if p["model"] == "quadratic":
            return CrushCurve.quadratic(alpha0, elastic, solid)
        return CrushCurve.two_power(alpha0, p["reference_distension"], p["transition_distension"], elastic,
                                    number(p["transition_pressure"]), solid, p["n1"], p["n2"])

    def alpha(self, pressure):
        """On the way up, for a number or an array."""
        p = np.clip(pressure, self.elastic, self.solid)
        value = 1 + self.second * ((self.solid - p) / (self.solid - self.elastic)) ** self.n2
        if self.first:
            rest = np.maximum(self.transition - p, 0)
            value = value + self.first * (rest / (self.transition - self.elastic)) ** self.n1
        return value

    def slope(self, pressure):
        """d(alpha)/dP while pores are being crushed [1/Pa]."""
        if not self.elastic <= pressure < self.solid:
            return 0.0
        width = self.solid - self.elastic
        value = -self.n2 * self.second / width * ((self.solid - pressure) / width) ** (self.n2 - 1)
        if self.first and pressure < self.transition:
            width = self.transition - self.elastic
            value -= self.n1 * self.first / width * ((self.transition - pressure) / width) ** (self.n1 - 1)
        return value


@dataclass(frozen=True)
class Matter:
    """A uniform state; velocities are those in the body that the wave came from, which is at rest ahead of it."""
    density: float  # pores included [kg/m^3]
    energy: float  # [J/kg]
    pressure: float  # [Pa]
    alpha: float
    velocity: float  # [m/s]


class PorousBody:
    """A cold bar of bulk density rho_s/alpha0 that a wall runs into."""

    def __init__(self, eos, curve):
        self.eos, self.curve = eos, curve
        self.rest = Matter(eos.density / curve.alpha0, 0.0, 0.0, curve.alpha0, 0.0)

    @staticmethod
    def of(scene, material):
        return PorousBody(Tillotson.of(scene, material), CrushCurve.of(scene, material))

    def shock_to(self, ahead, pressure, alpha=None):
        """Behind a shock into a state (Rankine-Hugoniot), with the distension of the curve unless given. For a fixed
        pressure density is single-valued, even where the Hugoniot bends back to lower densities."""
        alpha = float(self.curve.alpha(pressure)) if alpha is None else alpha

        def energy(rho):
            return ahead.energy + (ahead.pressure + pressure) / 2 * (1 / ahead.density - 1 / rho)

        def excess(rho):
            return self.eos.pressure(alpha * rho, energy(rho)) / alpha - pressure

        rho = brentq(excess, ahead.density, 4 * self.eos.density, xtol=1e-300, rtol=1e-15)
        jump = math.sqrt((pressure - ahead.pressure) * (1 / ahead.density - 1 / rho))
        return Matter(rho, energy(rho), pressure, alpha, ahead.velocity + jump)

    def elastic_limit(self):
        """Behind the precursor, a jump to P_e at constant distension."""
        return self.shock_to(self.rest, self.curve.elastic, self.curve.alpha0)

    def rate_form(self, density, energy, substeps=16):
        """Distension along a path of states, piecewise straight, by its rate (Jutzi, Benz & Michel 2008):
        d(alpha)/dt = d(alpha)/dP [alpha dP_s/drho_s drho/dt + dP_s/de de/dt] / (alpha + d(alpha)/dP (P - rho
        dP_s/drho_s)) on the curve, never positive; 0 below it. Runge-Kutta of fourth order from alpha0 on."""
        alpha, result = self.curve.alpha0, [self.curve.alpha0]
        for rho, e, d_rho, d_e in zip(density, energy, np.diff(density), np.diff(energy)):
            rate = lambda share, a: self._crush_rate(rho + share * d_rho, e + share * d_e, a, d_rho, d_e)
            step = 1 / substeps
            for share in np.arange(substeps) * step:
                k1 = rate(share, alpha)
                k2 = rate(share + step / 2, alpha + step / 2 * k1)
                k3 = rate(share + step / 2, alpha + step / 2 * k2)
                k4 = rate(share + step, alpha + step * k3)
                alpha = max(1.0, alpha + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4))
            result.append(alpha)
        return np.array(result)

    def _crush_rate(self, rho, e, alpha, d_rho, d_e):
        pressure = self.eos.pressure(alpha * rho, e) / alpha
        if self.curve.alpha(pressure) > alpha:
            return 0.0
        if pressure >= self.curve.solid:
            return 1 - alpha
        slope, (by_rho, by_e) = self.curve.slope(pressure), self.eos.slopes(alpha * rho, e)
        return min(0.0, slope * (alpha * by_rho * d_rho + by_e * d_e) / (alpha + slope * (pressure - rho * by_rho)))

    def waves(self, speed):
        """[(speed of the wave, state behind it), ...] from the foremost to the state at a wall that runs in with this
        speed: an elastic precursor and a compaction shock, or a shock alone if it would overtake the precursor."""
        limit = self.elastic_limit()
        if speed <= limit.velocity:
            raise ValueError(f"{speed} m/s is an elastic wave alone")
        final = self._at_speed(limit, speed)
        precursor, shock = wave_speed(self.rest, limit), wave_speed(limit, final)
        if shock < precursor:
            return [(precursor, limit), (shock, final)]
        final = self._at_speed(self.rest, speed)
        return [(wave_speed(self.rest, final), final)]

    def _at_speed(self, ahead, speed):
        lowest = max(ahead.pressure, self.curve.elastic) * (1 + 1e-12) + 1e-6
        highest = 1e3 * (ahead.density * speed ** 2 + ahead.pressure)
        reach = lambda log_p: self.shock_to(ahead, math.exp(log_p)).velocity - speed
        log_p = brentq(reach, math.log(lowest), math.log(highest), xtol=1e-14, rtol=1e-14)
        return self.shock_to(ahead, math.exp(log_p))


def wave_speed(ahead, behind):
    """Of the jump between two states, seen from where the velocities are seen from: momentum and mass."""
    return ahead.velocity + (behind.pressure - ahead.pressure) / (ahead.density * (behind.velocity - ahead.velocity))


def wall_profiles(body, waves, speed, state):
    """[(label, x, computed, exact), ...] of a bar that came from the right at `speed`; its end met x = 0 at time 0."""
    x = state["position"][:, 0]
    behind = [body.rest, *(matter for _, matter in waves)]
    passed = sum(x < (wave - speed) * state.time for wave, _ in waves)

    def exact(name):
        return np.array([getattr(matter, name) for matter in behind])[passed]

    return [("density [kg/m^3]", x, state["density"], exact("density")),
            ("velocity [m/s]", x, state["velocity"][:, 0], exact("velocity") - speed),
            ("pressure [Pa]", x, state["pressure"], exact("pressure")),
            ("alpha", x, state["distension"], exact("alpha"))]
