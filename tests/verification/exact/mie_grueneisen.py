"""Mie and Grueneisen's equation of state about a straight Hugoniot us = c0 + S1 up, in the form of Steinberg (1996)."""
from dataclasses import dataclass

from harness.run import number


@dataclass(frozen=True)
class MieGrueneisen:
    density: float  # at rest [kg/m^3]
    c0: float  # [m/s]
    S1: float
    gamma0: float
    b: float

    @staticmethod
    def of(scene, material):
        """With the constants of resolved.toml."""
        eos = scene["materials"][material]["eos"]
        return MieGrueneisen(*(number(eos[key]) for key in MieGrueneisen.__dataclass_fields__))

    def pressure(self, rho, e):
        mu = rho / self.density - 1
        stiffness = self.density * self.c0**2 * mu
        if mu <= 0:
            return stiffness + self.gamma0 * self.density * e
        form = (1 + (1 - self.gamma0 / 2) * mu - self.b / 2 * mu**2) / (1 - (self.S1 - 1) * mu)**2
        return stiffness * form + (self.gamma0 + self.b * mu) * self.density * e
