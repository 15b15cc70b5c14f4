"""Two shocks of an ideally plastic solid in uniaxial strain: an elastic precursor and a plastic shock behind it."""
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq


@dataclass(frozen=True)
class State:
    density: float   # kg/m^3
    stress: float    # -sigma_xx, Pa
    velocity: float  # of the particles, relative to the matter ahead of both shocks, m/s
    energy: float    # J/kg


@dataclass(frozen=True)
class Solid:
    eos: object      # pressure(density, energy), density
    shear_modulus: float
    yield_stress: float

    def deviator(self, rho):
        """-S_xx: 4/3 G ln(rho/rho0) from Hooke's law in rates, at most 2/3 Y (von Mises)."""
        return min(4 / 3 * self.shear_modulus * np.log(rho / self.eos.density), 2 / 3 * self.yield_stress)

    def behind(self, ahead, rho):
        """The state at density rho behind a shock: e = e_0 + (s + s_0)/2 (1/rho_0 - 1/rho), u = u_0 + sqrt((s - s_0)
        (1/rho_0 - 1/rho)), s = P + deviator."""
        squeeze = 1 / ahead.density - 1 / rho

        def excess(e):
            return e - ahead.energy - 0.5 * (self.eos.pressure(rho, e) + self.deviator(rho) + ahead.stress) * squeeze

        e = brentq(excess, ahead.energy - 1e3, ahead.energy + 1e7, xtol=1e-9, rtol=1e-14)
        stress = self.eos.pressure(rho, e) + self.deviator(rho)
        return State(rho, stress, ahead.velocity + np.sqrt((stress - ahead.stress) * squeeze), e)

    def two_shocks(self, particle_speed):
        """States ahead, between and behind, and the speeds of the two shocks relative to the matter ahead."""
        rest = State(self.eos.density, 0.0, 0.0, 0.0)
        limit = self.behind(rest, rest.density * np.exp(self.yield_stress / (2 * self.shear_modulus)))
        rho = brentq(lambda rho: self.behind(limit, rho).velocity - particle_speed, limit.density * (1 + 1e-9),
                     1.5 * limit.density, xtol=1e-9, rtol=1e-14)
        final = self.behind(limit, rho)
        return (rest, limit, final), (self.speed(rest, limit), self.speed(limit, final))

    @staticmethod
    def speed(ahead, behind):
        return ahead.velocity + (behind.velocity - ahead.velocity) / (1 - ahead.density / behind.density)
