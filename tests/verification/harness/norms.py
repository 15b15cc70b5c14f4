"""Norms of errors, and the order at which they fall."""
import numpy as np


def l1(value, exact, weight):
    """Mean absolute error, weighted (by volume, as a rule)."""
    return float(np.sum(weight * np.abs(value - exact)) / np.sum(weight))


def l2(value, exact, weight):
    return float(np.sqrt(np.sum(weight * (value - exact) ** 2) / np.sum(weight)))


def linf(value, exact):
    return float(np.max(np.abs(value - exact)))


def relative(value, exact):
    return float(abs(value / exact - 1))


def order(resolutions, errors):
    """Slope of the least-squares line through log error against log resolution, with its sign turned."""
    resolutions, errors = np.asarray(resolutions, float), np.asarray(errors, float)
    if len(errors) < 2 or not np.all(errors > 0):
        return float("nan")
    return float(-np.polyfit(np.log(resolutions), np.log(errors), 1)[0])


def binned(x, values, width):
    """Means of x and values in bins of a width; empty bins are left out."""
    _, bin_of = np.unique(np.floor(x / width), return_inverse=True)
    count = np.bincount(bin_of)
    return np.bincount(bin_of, x) / count, np.bincount(bin_of, values) / count


def fall(x, values, level):
    """Rightmost x at which a profile falls through a level; nan if it does not."""
    k = np.flatnonzero((values[:-1] >= level) & (values[1:] < level))
    if len(k) == 0:
        return float("nan")
    k = k[-1]
    return float(x[k] + (x[k + 1] - x[k]) * (values[k] - level) / (values[k] - values[k + 1]))
