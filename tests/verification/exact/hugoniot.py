"""States behind a plane shock: the jump conditions of Rankine and Hugoniot with an equation of state."""
from dataclasses import dataclass

from scipy.optimize import brentq

from exact.tillotson import Tillotson

UNITS = {"g/cm^3": 1e3, "GPa": 1e9, "MJ/kg": 1e6, "km/s": 1e3}


def from_library(eos, equation=Tillotson):
    """The equation of state in the table [eos] of the file of a material, with the units it is written in."""
    def in_si(value):
        if not isinstance(value, str):
            return float(value)
        size, unit = value.split()
        return float(size) * UNITS[unit]

    return equation(*(in_si(eos[key]) for key in equation.__dataclass_fields__))


@dataclass(frozen=True)
class Shock:
    """A shock into cold matter at rest, from zero pressure."""
    particle_speed: float  # m/s
    speed: float           # m/s
    pressure: float        # Pa
    density: float         # kg/m^3

    @classmethod
    def behind_piston(cls, eos, u, densest=20):
        """Mass rho0 U = rho (U - u), momentum P = rho0 U u, energy e = u^2/2, and the equation of state, which holds up to
        `densest` times its density at rest."""
        rho0 = eos.density

        def excess(rho):
            return eos.pressure(rho, u**2 / 2) - rho0 * rho / (rho - rho0) * u**2

        rho = brentq(excess, rho0 * (1 + 1e-9), densest * rho0, xtol=1e-9, rtol=1e-14)
        speed = rho / (rho - rho0) * u
        return cls(u, speed, rho0 * speed * u, rho)
