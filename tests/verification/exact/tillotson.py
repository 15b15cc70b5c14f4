"""Tillotson's equation of state of a run (Tillotson 1962; Melosh 1989, Impact Cratering, app. II)."""
import math
from dataclasses import dataclass

from harness.run import number


@dataclass(frozen=True)
class Tillotson:
    density: float  # at rest [kg/m^3]
    a: float
    b: float
    A: float  # [Pa]
    B: float  # [Pa]
    E0: float  # [J/kg]
    E_iv: float  # [J/kg]
    E_cv: float  # [J/kg]
    alpha: float
    beta: float

    @staticmethod
    def of(scene, material):
        """With the constants of resolved.toml."""
        eos = scene["materials"][material]["eos"]
        return Tillotson(*(number(eos[key]) for key in Tillotson.__dataclass_fields__))

    def pressure(self, rho, e):
        """The cold part goes to zero with the density: in expansion max(A, B) takes the place of B."""
        eta = rho / self.density
        mu, thermal = eta - 1, self.b * rho * e / (1 + max(e, 0.0) / (self.E0 * eta * eta))
        stiffness = self.A + (self.B if mu >= 0 else max(self.A, self.B)) * mu
        condensed = self.a * rho * e + thermal + (mu * stiffness if stiffness > 0 else 0.0)
        if eta >= 1 or e <= self.E_iv:
            return condensed
        z = 1 / eta - 1
        fade = math.exp(-self.alpha * z * z)
        expanded = self.a * rho * e + fade * (thermal + self.A * mu * math.exp(-self.beta * z))
        share = min((e - self.E_iv) / (self.E_cv - self.E_iv), 1.0)
        return (1 - share) * condensed + share * expanded

    def slopes(self, rho, e):
        """dP/drho at constant e and dP/de at constant rho, by central differences."""
        d_rho, d_e = 1e-6 * self.density, 1e-6 * self.E0
        return ((self.pressure(rho + d_rho, e) - self.pressure(rho - d_rho, e)) / (2 * d_rho),
                (self.pressure(rho, e + d_e) - self.pressure(rho, e - d_e)) / (2 * d_e))

    def sound_speed(self, rho, e):
        by_rho, by_e = self.slopes(rho, e)
        return math.sqrt(by_rho + self.pressure(rho, e) * by_e / rho ** 2)
