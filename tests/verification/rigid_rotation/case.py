"""Rigid rotation: a body on which nothing acts turns and turns."""
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from harness import Bound, Case
from harness.run import number

OMEGA, LENGTH = 2 * np.pi / 100, 2.0  # 1/s, m
LINK = 1.6  # pieces are friends nearer than this many spacings: more than the diagonal of the lattice
PLANE = '["-0.0628318530717959*y", "0.0628318530717959*x"]'
SHAPES = {  # scene; what is set beside the spacing (lengths in m); the turn is about z
    "sphere": ("scene.toml", {}),
    "block": ("block.toml", {}),
    "rod": ("block.toml", {"bodies.body.size": (LENGTH, LENGTH / 3, LENGTH / 3, "m")}),
    "disc": ("scene.toml", {"scene.dimension": 2, "bodies.body.shape": "disc", "bodies.body.profile.velocity": PLANE}),
    "square": ("block.toml", {"scene.dimension": 2, "bodies.body.shape": "rectangle",
                              "bodies.body.size": (LENGTH, LENGTH, "m"), "bodies.body.profile.velocity": PLANE}),
}


class Rotation(Case):
    """Resolution: particles across (along the longest edge)."""
    exact = "angular momentum, energy of rotation and shape stay what they are"
    full = (6, 10)
    boost = "x"
    mixed_margin = "the errors are round-off where they are as they must be"
    bounds = (
        Bound("angular momentum", "relative", 1e-6, why="conserved: no order"),
        Bound("energy of rotation", "relative", 1e-3, why="no force does work; what is left is breathing under the load"),
        Bound("moment of inertia", "relative", 5e-3, why="centrifugal stretch of 0.004 times a number below 1"),
        Bound("pieces too many", "count", 0, why="it breaks or not"),
    )

    def __init__(self, shape, scheme, strength):
        self.scheme, self.strength = scheme, strength
        self.scene, self.body = SHAPES[shape]
        self.name = f"rotation_{shape}_{scheme}{'' if strength else '_elastic'}"
        self.title = f"{shape}, ten turns, {scheme}, {'yield stress' if strength else 'elastic without limit'}"
        slow = scheme == "asph" and shape in ("sphere", "block")
        self.quick = (6,) if strength and not slow else ()

    def settings(self, resolution):
        strength = {} if self.strength else {"materials.jelly.strength.model": "none"}
        return {"resolution.spacing": (LENGTH / resolution, "m"), "numerics.scheme": self.scheme, **self.body,
                **strength}

    def errors(self, run, resolution):
        """Over the second half of the run, by the snapshots."""
        start = 2 * run.history["kinetic energy"][0] / OMEGA  # angular momentum of rigid rotation
        inertia = start / OMEGA
        late = run.states[len(run.states) // 2:]
        momentum, energy, moment = np.array([self.turning(s) for s in late]).T
        spacing = number(run.scene["resolution"]["spacing"])
        return {("angular momentum", "relative"): np.abs(momentum / start - 1).max(),
                # That of a rigid body with the moment of inertia it now has.
                ("energy of rotation", "relative"): np.abs(energy * 2 * moment / start**2 - 1).max(),
                ("moment of inertia", "relative"): np.abs(moment / inertia - 1).max(),
                ("pieces too many", "count"): float(self.pieces(run.final["position"], spacing) - 1)}

    def turning(self, state):
        """Angular momentum about z, kinetic energy, moment of inertia."""
        (x, y), (u, v), m = state["position"].T[:2], state["velocity"].T[:2], state["mass"]
        energy = 0.5 * np.sum(m * np.sum(state["velocity"]**2, axis=1))
        return np.sum(m * (x * v - y * u)), energy, np.sum(m * (x * x + y * y))

    def pieces(self, x, spacing):
        pairs = cKDTree(x).query_pairs(LINK * spacing, output_type="ndarray")
        links = coo_matrix((np.ones(len(pairs)), pairs.T), shape=(len(x), len(x)))
        return connected_components(links, directed=False)[0]


CASES = [Rotation(shape, scheme, strength)
         for shape in SHAPES for scheme in ("sph", "asph") for strength in (True, False)]
