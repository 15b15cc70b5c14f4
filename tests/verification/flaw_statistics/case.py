"""The flaws that particles are given: Weibull's distribution, in the volume of the solid, by chance of their own."""
import numpy as np

from exact.weibull import kolmogorov_distance, mean_count, strongest, weakest
from harness import Bound, Case, relative
from harness.run import number

SPACING = 0.001


class FlawStatistics(Case):
    """Resolution: particles along the edge of a cubic block. What is left is chance, which falls as 1/sqrt(N)."""
    exact = "Poisson process of Weibull's flaws in the solid matter of each particle"
    quick = (8, 16, 32)
    full = (8, 16, 32, 64)
    rotation = "flaws belong to places: a turned block has others"
    boost = "y"
    mixed_margin = "flaws know nothing of the precision of pairs"

    # What chance exceeds once in a thousand; n particles along the edge are N = n^3.
    bounds = (
        Bound("weakest flaw", "Kolmogorov distance", {n: 1.95 / n ** 1.5 for n in full}, 1.0),
        Bound("strongest flaw", "Kolmogorov distance", {n: 1.95 / n ** 1.5 for n in full}, 1.0),
        Bound("weakest flaw of 64 blocks", "Kolmogorov distance", 1.95 / 8, why="always 64"),
        Bound("mean count", "relative", {n: 3.3 / n ** 1.5 / mean_count(n ** 3) ** 0.5 for n in full}, why="chance"),
        Bound("neighbours", "correlation", {n: 3.3 / n ** 1.5 for n in full}, why="chance"),
    )

    def __init__(self, seed):
        self.seed = seed
        self.name = f"flaw_statistics_{seed}"
        self.title = f"flaws of pumice, seed {seed}"

    def settings(self, resolution):
        edge = resolution * SPACING
        return {"bodies.block.size": (edge, edge, edge, "m"), "random.seed": self.seed}

    def errors(self, run, resolution):
        state, damage = run.final, run.scene["materials"]["pumice"]["damage"]
        m, k, particles = damage["weibull_m"], number(damage["weibull_k"]), len(state)
        solid = state["mass"] / number(run.scene["materials"]["pumice"]["eos"]["density"])
        count, strain = state["flaw_count"], state["flaw_strain"]
        weak = weakest(strain, m, k, solid)
        several = count > 1
        largest = strain[several] * count[several] ** (1 / state["flaw_exponent"][several])
        strong = strongest(largest, count[several], m, k, solid[several], particles)
        cube = weak[np.lexsort(state["position"].T)].reshape([resolution] * 3)
        uniform = np.exp(-cube)
        alike = [1 - np.mean(np.diff(uniform, axis=axis) ** 2) / (2 * uniform.var()) for axis in range(3)]
        blocks = cube.reshape(4, resolution // 4, 4, resolution // 4, 4, resolution // 4).min(axis=(1, 3, 5)).ravel()
        return {("weakest flaw", "Kolmogorov distance"): kolmogorov_distance(weak),
                ("strongest flaw", "Kolmogorov distance"): kolmogorov_distance(strong),
                ("weakest flaw of 64 blocks", "Kolmogorov distance"): kolmogorov_distance(
                    (resolution // 4) ** 3 * blocks),
                ("mean count", "relative"): relative(count.mean(), mean_count(particles)),
                ("neighbours", "correlation"): float(np.abs(alike).max())}


CASES = [FlawStatistics(seed) for seed in (1, 2, 3)]
