"""Flaws of Weibull's distribution, n(eps) = k eps^m per volume of solid, dealt to the N particles of a body.

Dealing flaw after flaw to particles at random until each has one takes N (ln N + 0.577) flaws (Benz & Asphaug 1994,
Icarus 107, 98). Seen from one particle that is a Poisson process: for the weakest flaw of a particle k V eps^m is
exponentially distributed, the count has the mean ln N + 0.577, and of the strongest of n flaws n times the logarithm of
(eps_max/eps)^m is exponentially distributed again, eps_max being the strain at which all have been dealt.
"""
import numpy as np


def mean_count(particles):
    return np.log(particles) + np.euler_gamma


def weakest(strain, m, k, volume):
    """Exponentially distributed; by logarithms, as k reaches 1e61."""
    return np.exp(np.log(k) + np.log(volume) + m * np.log(strain))


def strongest(strain, count, m, k, volume, particles):
    """Exponentially distributed."""
    return count * (np.log(mean_count(particles)) - np.log(weakest(strain, m, k, volume)))


def kolmogorov_distance(values):
    """Largest distance between the distribution of values and the exponential one; about 0.87/sqrt(N) by chance, more
    than 1.95/sqrt(N) once in a thousand."""
    exact, n = -np.expm1(-np.sort(values)), len(values)
    above, below = np.arange(1, n + 1) / n - exact, exact - np.arange(n) / n
    return float(max(above.max(), below.max()))
