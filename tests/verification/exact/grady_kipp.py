"""Brittle rock pulled apart at a steady rate: the law of Grady & Kipp (1980, Int. J. Rock Mech. 17, 147)."""
import math
from dataclasses import dataclass

import numpy as np

from harness.run import number


@dataclass(frozen=True)
class Rock:
    """Elastic, without yielding, with flaws k eps^m per volume (per area in plane strain)."""
    density: float  # kg/m^3
    shear: float  # G [Pa]
    bulk: float  # K [Pa]
    m: float
    k: float  # 1/m^3, 1/m^2
    crack_share: float  # of the longitudinal wave speed

    @staticmethod
    def of(scene, material):
        parts = scene["materials"][material]
        elastic, damage = parts["elastic"], parts["damage"]
        return Rock(number(parts["eos"]["density"]), number(elastic["shear_modulus"]), number(elastic["bulk_modulus"]),
                    damage["weibull_m"], number(damage["weibull_k"]), damage["crack_speed_factor"])

    @property
    def young(self):
        return 9 * self.bulk * self.shear / (3 * self.bulk + self.shear)

    @property
    def modulus(self):
        """M = K + 4/3 G: stress over strain where the matter cannot give way sideways."""
        return self.bulk + 4 / 3 * self.shear

    @property
    def crack_speed(self):
        return self.crack_share * math.sqrt(self.modulus / self.density)

    def open_flaws(self, rate, time):
        """Per volume. A bar held across and drawn out at the rate has the stress sigma = M rate t, its largest principal
        stress. What opens flaws is the strain sigma/E: M/E (basalt 1.07) times that of the bar."""
        return self.k * (self.modulus / self.young * rate * time) ** self.m

    def damage(self, rate, time, dimension):
        """Share of the volume in the spheres around the cracks that opened at t' < t,
             D = 4 pi/3 c_g^3 int_0^t n'(t') (t - t')^3 dt' = 4 pi/3 c_g^3 n(t) t^3 6/((m + 1) (m + 2) (m + 3)),
        as n grows as t^m and m int_0^1 x^(m-1) (1 - x)^3 dx = 6/((m + 1) (m + 2) (m + 3)); in plane strain in the discs,
             D = pi c_g^2 n(t) t^2 2/((m + 1) (m + 2))."""
        m, reach = self.m, self.crack_speed * time
        if dimension == 3:
            share = 4 * math.pi / 3 * reach ** 3 * 6 / ((m + 1) * (m + 2) * (m + 3))
        else:
            share = math.pi * reach ** 2 * 2 / ((m + 1) * (m + 2))
        return share * self.open_flaws(rate, time)

    def strength(self, rate, dimension):
        """(largest stress [Pa], its time [s]): of M rate t (1 - D), D = a t^p, p = m + dimension, it is where
        (p + 1) a t^p = 1."""
        p = self.m + dimension
        time = ((p + 1) * self.damage(rate, 1.0, dimension)) ** (-1 / p)
        return self.modulus * rate * time * p / (p + 1), time

    def integrated_damage(self, rate, time, dimension, cracks=20000):
        """D by the integral itself, to check the closed form."""
        opened = time * (np.arange(cracks) + 0.5) / cracks
        number = self.m * self.open_flaws(rate, opened) / opened * time / cracks
        radius = self.crack_speed * (time - opened)
        return float(np.sum(number * (4 * math.pi / 3 * radius ** 3 if dimension == 3 else math.pi * radius ** 2)))
