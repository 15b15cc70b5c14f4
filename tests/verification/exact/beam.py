"""Bending of a free plate in plane strain: Timoshenko's beam, which knows of shear and of the inertia of rotation."""
from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq


@dataclass(frozen=True)
class FreePlate:
    """Its lowest symmetric mode; all values per metre of width."""
    length: float
    thickness: float
    density: float
    bulk_modulus: float
    shear_modulus: float

    @property
    def poisson(self):
        K, G = self.bulk_modulus, self.shear_modulus
        return (3 * K - 2 * G) / (2 * (3 * K + G))

    @property
    def stiffness(self):
        """E I with the modulus of plane strain, E/(1 - nu^2), and I = H^3/12 (Landau & Lifshitz, section 11)."""
        young = 2 * self.shear_modulus * (1 + self.poisson)
        return young / (1 - self.poisson**2) * self.thickness**3 / 12

    def thin_frequency(self):
        """rad/s: omega^2 = E I k^4/(rho H), tan(kL/2) + tanh(kL/2) = 0 (Landau & Lifshitz, section 25)."""
        half = brentq(lambda a: np.tan(a) + np.tanh(a), 2, 3)
        return np.sqrt(self.stiffness / (self.density * self.thickness)) * (2 * half / self.length) ** 2

    def frequency(self):
        """rad/s, from the equations of Timoshenko (1921, Philos. Mag. 41, 744) for deflection w, rotation p, moment M
        and force Q: Q = kappa G H (w' - p), M = E I p', Q' = -rho H omega^2 w, M' = -Q - rho I omega^2 p, between the
        centre, p = Q = 0, and the end, M = Q = 0."""
        nu = self.poisson / (1 - self.poisson)  # of the plane
        shear = 5 * (1 + nu) / (6 + 5 * nu) * self.shear_modulus * self.thickness
        mass, inertia = self.density * self.thickness, self.density * self.thickness**3 / 12

        def mismatch(omega):  # scaled so that all entries are of order one
            L, S = self.length, self.stiffness
            slope = np.array([[0, 1, 0, S / (shear * L**2)],
                              [0, 0, 1, 0],
                              [0, -inertia * omega**2 * L**2 / S, 0, -1],
                              [-mass * omega**2 * L**4 / S, 0, 0, 0]])  # of (w/L, p, M L/S, Q L^2/S) over x/L
            end = expm(slope / 2)
            return end[2, 0] * end[3, 2] - end[2, 2] * end[3, 0]

        return brentq(mismatch, 0.7 * self.thin_frequency(), 1.1 * self.thin_frequency(), rtol=1e-12)
