"""Blast wave of a point explosion in cold gas (Sedov 1959, Similarity and Dimensional Methods in Mechanics, ch. 4)."""
import numpy as np
from scipy.integrate import quad, solve_ivp


class Sedov:
    """Energy [J, per metre if nu = 2] in gas of unit density. Plane (both sides count), cylinder, sphere: nu = 1, 2, 3.

    With R ~ t^(2/(nu+2)) and u = R' f(x), rho = g(x), p = R'^2 h(x), x = r/R, the equations of gas dynamics become
      (f - x) g' + g f' + (nu - 1) g f / x = 0,
      (f - x) f' + h'/g = nu f / 2,
      (f - x) (h'/h - gamma g'/g) = nu,
    to be integrated inwards from the strong shock at x = 1.
    """

    def __init__(self, nu, gamma, energy=1.0):
        self.nu, self.gamma, self.energy = nu, gamma, energy
        start = 2 / (gamma + 1), (gamma + 1) / (gamma - 1), 2 / (gamma + 1)
        self._solution = solve_ivp(self._slopes, (1, 1e-2), start, method="LSODA", rtol=1e-11, atol=1e-20,
                                   dense_output=True)
        content, _ = quad(self._energy_density, 1e-2, 1, epsabs=1e-12, epsrel=1e-10)
        content += self.central_pressure() / (gamma - 1) * 1e-2 ** nu / nu  # what is left of it is at rest
        surface = {1: 2, 2: 2 * np.pi, 3: 4 * np.pi}[nu]
        self.alpha = surface * (2 / (nu + 2)) ** 2 * content  # E = alpha rho R^(nu + 2) / t^2

    def _slopes(self, x, y):
        f, g, h = y
        d, nu = f - x, self.nu
        # Mass gives g' and entropy h' in terms of f'; momentum then gives f'.
        df = (nu * f / 2 - (nu * h / d - self.gamma * h * (nu - 1) * f / (x * d)) / g) / (d - self.gamma * h / (d * g))
        dg = -g * (df + (nu - 1) * f / x) / d
        return df, dg, h * (nu / d + self.gamma * dg / g)

    def _energy_density(self, x):
        f, g, h = self._solution.sol(x)
        return (g * f * f / 2 + h / (self.gamma - 1)) * x ** (self.nu - 1)

    def radius(self, t):
        return (self.energy * t * t / self.alpha) ** (1 / (self.nu + 2))

    def time(self, radius):
        return np.sqrt(self.alpha * radius ** (self.nu + 2) / self.energy)

    def central_pressure(self):
        """In units of the density ahead times the square of the shock speed."""
        return float(self._solution.sol(1e-2)[2])

    def at(self, r, t):
        """Density, radial velocity and pressure."""
        radius = self.radius(t)
        speed = 2 / (self.nu + 2) * radius / t
        x = np.asarray(r) / radius
        inside = x < 1
        f, g, h = self._solution.sol(np.clip(x, 1e-2, 1))
        f = np.where(x < 1e-2, f * x / 1e-2, f)
        return np.where(inside, g, 1), np.where(inside, speed * f, 0), np.where(inside, speed ** 2 * h, 0)
