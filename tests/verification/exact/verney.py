"""Verney's problem: a shell of incompressible, ideally plastic matter flows inwards and stops when all of its kinetic
energy has become plastic work (Howell & Ball 2002, J. Comput. Phys. 175, 128)."""
from dataclasses import dataclass

import numpy as np
from scipy.integrate import quad, solve_ivp


@dataclass(frozen=True)
class Shell:
    """A sphere (dimension d = 3) or, in plane strain, a tube (d = 2) that starts with v = -u0 (inner/r)^(d - 1).

    Matter keeps its volume: r^d = r0^d - c, the same c for all. The equivalent plastic strain is k ln(r0/r), with k = 2
    for the sphere (rates -2 v/r, v/r, v/r along r and across) and k = 2/sqrt(3) for the tube (rates -v/r, v/r, 0).
    """
    inner: float    # radius at the start, m
    outer: float
    density: float  # kg/m^3
    strength: float  # yield stress, Pa
    dimension: int = 3

    @property
    def k(self):
        return 2 if self.dimension == 3 else 2 / np.sqrt(3)

    def radius(self, r0, final_inner):
        d = self.dimension
        return (r0**d - self.inner**d + final_inner**d) ** (1 / d)

    def speed_to_stop_at(self, final_inner):
        """u0 [m/s]: half density u0^2 int (inner/r)^(2d - 2) r^(d - 1) dr = Y int k ln(r0/r) r0^(d - 1) dr0."""
        d = self.dimension
        work = self.strength * quad(lambda r: self.k * np.log(r / self.radius(r, final_inner)) * r ** (d - 1),
                                    self.inner, self.outer, epsabs=0, epsrel=1e-12)[0]
        mass = quad(lambda r: self.inner ** (2 * d - 2) * r ** (1 - d), self.inner, self.outer, epsrel=1e-12)[0]
        return float(np.sqrt(2 * work / (self.density * mass)))

    def motion(self, u0, time):
        """Inner radius [m] at times, and when it stops [s]. At the speed u = -da/dt of the inner radius a the kinetic
        energy is half density u^2 a^(2d - 2) int r^(1 - d) dr over the shell; the plastic power takes it away."""
        d = self.dimension
        shell = self.outer**d - self.inner**d

        def inertia(a):
            b = (a**d + shell) ** (1 / d)
            return a ** (2 * d - 2) * (1 / a - 1 / b if d == 3 else np.log(b / a))

        def rates(_, y):
            a, u = y
            b = (a**d + shell) ** (1 / d)
            slope = (inertia(a * (1 + 1e-6)) - inertia(a * (1 - 1e-6))) / (2e-6 * a)
            power = self.strength * self.k * u * a ** (d - 1) * np.log(b / a)  # int Y k (u a^(d-1)/r^d) r^(d-1) dr
            return [-u, (-power / self.density + 0.5 * u**3 * slope) / (u * inertia(a))]

        stop = lambda _, y: y[1] - 1e-6 * u0
        stop.terminal = True
        path = solve_ivp(rates, (0, max(time)), [self.inner, u0], events=stop, rtol=1e-10, atol=1e-12,
                         dense_output=True)
        return path.sol(np.minimum(time, path.t[-1]))[0], path.t[-1]
