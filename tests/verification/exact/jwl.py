"""Products of an explosive by Jones, Wilkins and Lee: the state of Chapman and Jouguet, and what follows it."""
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq


@dataclass(frozen=True)
class Jwl:
    """Pressures on an isentrope are A exp(-R1 V) + B exp(-R2 V) + C V^-(1 + omega), V = density / (density now)."""
    density: float           # of the explosive [kg/m^3]
    A: float                 # Pa
    B: float
    R1: float
    R2: float
    omega: float
    E0: float                # J/m^3
    detonation_speed: float = float("nan")  # as it is given [m/s]

    def pressure(self, V, E):
        """At an energy per volume of explosive [J/m^3]."""
        cold = sum(K * (1 - self.omega / (R * V)) * np.exp(-R * V) for K, R in ((self.A, self.R1), (self.B, self.R2)))
        return cold + self.omega * E / V

    def hugoniot(self, V):
        return brentq(lambda P: self.pressure(V, self.E0 + P * (1 - V) / 2) - P, 0, 1e13)

    @cached_property
    def cj(self):
        """V, P, D and the speed of the products: where isentrope and line of Rayleigh touch."""
        def apart(V):
            P = self.hugoniot(V)
            return -self.slope(V, P) - P / (1 - V)

        V = brentq(apart, 0.6, 0.9, xtol=1e-14)
        P = self.hugoniot(V)
        D = np.sqrt(P / (self.density * (1 - V)))
        return V, P, D, D * (1 - V)

    def slope(self, V, P):
        """dP/dV at constant entropy, dE = -P dV."""
        E = (P - self.pressure(V, 0)) * V / self.omega
        step = 1e-5
        return (self.pressure(V + step, E - P * step) - self.pressure(V - step, E + P * step)) / (2 * step)

    @cached_property
    def C(self):
        V, P, *_ = self.cj
        return (P - self.A * np.exp(-self.R1 * V) - self.B * np.exp(-self.R2 * V)) * V ** (1 + self.omega)

    def isentrope(self, V):
        """Pressure and speed of sound on the isentrope through the state of Chapman and Jouguet."""
        P = self.A * np.exp(-self.R1 * V) + self.B * np.exp(-self.R2 * V) + self.C * V ** -(1 + self.omega)
        fall = (self.A * self.R1 * np.exp(-self.R1 * V) + self.B * self.R2 * np.exp(-self.R2 * V)
                + (1 + self.omega) * self.C * V ** -(2 + self.omega))
        return P, V * np.sqrt(fall / self.density)

    def energy(self, V):
        """Energy per volume of explosive on that isentrope [J/m^3]."""
        return (self.A / self.R1 * np.exp(-self.R1 * V) + self.B / self.R2 * np.exp(-self.R2 * V)
                + self.C / self.omega * V ** -self.omega)

    @cached_property
    def _wave(self):
        """Behind the front: u + c = x/t, du = -c dV/V along the isentrope, down to rest (Taylor 1950)."""
        V, _, _, u = self.cj
        done = lambda V, y: y[0]
        done.terminal = True
        found = solve_ivp(lambda V, y: [-self.isentrope(V)[1] / V], (V, 20), [u], rtol=1e-11, atol=1e-8,
                          dense_output=True, events=done)
        volumes = np.linspace(V, found.t[-1], 4001)
        speeds = found.sol(volumes)[0]
        return volumes, speeds, speeds + self.isentrope(volumes)[1]

    def taylor_wave(self, x, t):
        """V, pressure and velocity at x [m], t [s] after a rigid wall at x = 0 was lit; ahead of the front V = 1, at rest.

        Speeds of the wave are tabulated at 4000 volumes: the error of an interpolation is below 1e-6."""
        volumes, speeds, rays = self._wave
        order = np.argsort(rays)
        ray = np.clip(np.asarray(x) / t, rays.min(), rays.max())
        V = np.interp(ray, rays[order], volumes[order])
        u = np.interp(ray, rays[order], speeds[order])
        burnt = np.asarray(x) <= self.cj[2] * t
        return np.where(burnt, V, 1), np.where(burnt, self.isentrope(V)[0], 0), np.where(burnt, u, 0)


def gurney_speed(root_2E, metal_over_explosive, shape):
    """Speed of the case by Gurney (1943): sqrt(2 E) (M/C + k)^(-1/2) [m/s], k = 1/3, 1/2, 3/5 of a slab between two
    plates, a cylinder and a sphere."""
    return root_2E / np.sqrt(metal_over_explosive + {"slab": 1 / 3, "cylinder": 1 / 2, "sphere": 3 / 5}[shape])
