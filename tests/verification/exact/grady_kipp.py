"""Brittle rock pulled apart at a uniform rate: Grady & Kipp's law, and what particles with flaws of their own do."""
import math
from dataclasses import dataclass

import numpy as np

from harness.run import number

from .tillotson import Tillotson


@dataclass(frozen=True)
class Rock:
    """Elastic, without yielding, with flaws k eps^m."""
    eos: Tillotson
    shear: float  # G [Pa]
    bulk: float  # K [Pa]
    m: float
    k: float  # [1/m^3]
    crack_share: float  # of the longitudinal wave speed

    @staticmethod
    def of(scene, material):
        elastic, damage = (scene["materials"][material][part] for part in ("elastic", "damage"))
        return Rock(Tillotson.of(scene, material), number(elastic["shear_modulus"]), number(elastic["bulk_modulus"]),
                    damage["weibull_m"], number(damage["weibull_k"]), damage["crack_speed_factor"])

    @property
    def young(self):
        return 9 * self.bulk * self.shear / (3 * self.bulk + self.shear)

    def longitudinal_speed(self, rho, e):
        return math.sqrt(self.eos.sound_speed(rho, e) ** 2 + 4 / 3 * self.shear / self.eos.density)

    def strength(self, rate):
        """Largest stress at a rate of uniaxial strain: every flaw grows into a round crack that relieves a sphere of
        its own size (Grady & Kipp 1980, Int. J. Rock Mech. 17, 147; as in Melosh, Ryan & Asphaug 1992, J. Geophys. Res.
        97, 14735)."""
        m, crack_speed = self.m, self.crack_share * self.longitudinal_speed(self.eos.density, 0)
        alpha = 8 * math.pi * crack_speed ** 3 * self.k / ((m + 1) * (m + 2) * (m + 3))
        modulus = self.bulk + 4 / 3 * self.shear
        return modulus * (m + 3) * (m + 4) ** (-(m + 4) / (m + 3)) * alpha ** (-1 / (m + 3)) * rate ** (3 / (m + 3))

    def pulled_apart(self, flaws, radius, rate, end, steps=1500):
        """Particles that do not feel each other, stretched with v_x = rate x: times, mean stress, damage at `end`.

        Each has its own flaws (strain of the weakest, exponent, count). Its strain is that of the undamaged solid,
        sigma_xx/E; (strain/weakest)^exponent flaws are open, each lengthens the crack D^(1/3) by c_g/R_s per time, but
        to (open/count)^(1/3) at most (Benz & Asphaug 1994, Icarus 107, 98). R_s grows with the cube root of the volume.
        All have the mean energy, as heat is of no account. Heun's method.
        """
        weakest, exponent, count = flaws
        energy, crack, dt = 0.0, np.zeros(len(count)), end / steps

        def state(time, energy, crack):
            stretch = 1 + rate * time
            rho, deviator = self.eos.density / stretch, 4 / 3 * self.shear * math.log(stretch)
            undamaged = deviator - self.eos.pressure(rho, energy)
            strain = undamaged / self.young
            active = np.where(strain >= weakest, np.minimum(count, np.maximum(strain / weakest, 1) ** exponent), 0)
            growth = active * self.crack_share * self.longitudinal_speed(rho, energy) / (radius * stretch ** (1 / 3))
            stress = np.mean(1 - crack ** 3) * undamaged
            return stress, stress * rate / stretch / rho, np.where(crack < np.cbrt(active / count), growth, 0)

        times, stresses = dt * np.arange(steps + 1), [0.0]
        for before, after in zip(times[:-1], times[1:]):
            _, heating, growth = state(before, energy, crack)
            _, heating_1, growth_1 = state(after, energy + dt * heating, np.minimum(crack + dt * growth, 1))
            energy = energy + dt / 2 * (heating + heating_1)
            crack = np.minimum(crack + dt / 2 * (growth + growth_1), 1)
            stresses.append(state(after, energy, crack)[0])
        return times, np.array(stresses), crack ** 3
