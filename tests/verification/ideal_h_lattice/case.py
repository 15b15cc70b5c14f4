"""Ideal H: the smoothing tensors that particles choose on lattices whose answer is known, and under endless shear."""
import numpy as np

from harness import Bound, Case
from harness.run import number

TURN = np.array([[1, -1, 0], [1, 1, 0], [0, 0, np.sqrt(2)]]) / np.sqrt(2)  # by 45 degrees about z
STRETCH = np.diag([2, 0.5, 1])
MAPS = {"as_built": np.eye(3), "turned": TURN, "distorted": STRETCH, "turned_distorted": TURN @ STRETCH}


def metrics(state):
    """G = H H of every particle: its ellipsoid is x.G x = 1."""
    g = state["smoothing_metric"].T
    rows = [[0, 2], [2, 1]] if len(g) == 3 else [[0, 3, 4], [3, 1, 5], [4, 5, 2]]
    return np.moveaxis(g[np.array(rows)], -1, 0)


def axes(metric):
    """Half axes from the longest to the shortest, and their directions as columns."""
    values, directions = np.linalg.eigh(metric)
    return 1 / np.sqrt(values), directions


class AtRest(Case):
    """Nothing moves, so no invariance of the motion is of interest; those of H are measured as errors."""
    exact = "lattices map circles on ellipses: axes n_h times the spacing along each (Owen 2010, Fig. 5)"
    rotation = "the jitter is drawn by place; discs turned by 45 degrees are among those measured"
    boost = mixed_margin = "nothing moves"

    def settings(self, resolution):
        return {"insitu.enabled": False}


class Lattices(AtRest):
    """Resolution: 100 n_h."""
    inner = 6.5  # spacings from the centre, before distortion

    def settings(self, resolution):
        return {**super().settings(resolution), "numerics.nodes_per_h": resolution / 100}

    def errors(self, run, resolution):
        worst = {key: 0.0 for key in self.limits()}
        for body in run.scene["bodies"]:
            name = body["name"].removesuffix("_jitter")
            if name == body["name"]:
                measured = self.perfect(run, name, resolution / 100)
            else:
                measured = self.jittered(run, body["name"], name)
            for key, value in measured.items():
                worst[key] = max(worst[key], value)
        return worst

    def inside(self, run, body, name):
        """Metrics and the exact map of particles far from the surface, and their mean spacing."""
        state, mask = run.final, run.body(body)
        n = run.dimension
        x, f = state["position"][mask], MAPS[name][:n, :n]
        site = (x - x.mean(axis=0)) @ np.linalg.inv(f).T
        spacing = np.mean(state.volume[mask]) ** (1 / n)
        near = np.abs(site).max(axis=1) if n == 3 else np.linalg.norm(site, axis=1)
        return metrics(state)[mask][near < self.inner * spacing], f, spacing

    def perfect(self, run, name, nodes_per_h):
        metric, f, spacing = self.inside(run, name, name)
        stretch, directions = axes(metric)
        exact, exact_directions = axes(np.linalg.inv(f @ f.T))
        aspect = stretch[:, 0] / stretch[:, -1]
        result = {("aspect", "relative"): np.abs(aspect * exact[-1] / exact[0] - 1).max(),
                  ("axes", "relative"): np.abs(stretch / (nodes_per_h * spacing * exact) - 1).max()}
        if exact[0] > exact[-1]:
            cosine = np.abs(directions[:, :, 0] @ exact_directions[:, 0])
            result["direction", "degrees"] = np.degrees(np.arccos(np.clip(cosine, 0, 1))).max()
        return result

    def jittered(self, run, body, name):
        metric, f, _ = self.inside(run, body, name)
        stretch, _ = axes(metric)
        aspect = stretch[:, 0] / stretch[:, -1]
        if name in ("as_built", "turned"):
            return {("aspect 1 with jitter", "largest"): aspect.max()}
        return {("aspect 4 with jitter", "largest"): aspect.max(), ("aspect 4 with jitter", "1/smallest"): 1 / aspect.min(),
                ("aspect 4 with jitter", "mean"): abs(aspect.mean() / 4 - 1)}

    @classmethod
    def limits(cls):
        return [(b.quantity, b.norm) for b in cls.bounds]

    band = "the band asked of the method; far from it, see the table"
    bounds = (
        Bound("aspect", "relative", 1e-10, why="the vote is exact on a lattice"),
        Bound("axes", "relative", 1e-5, why="the table of psi0 between its entries"),
        Bound("direction", "degrees", 0.01, why="symmetry"),
        Bound("aspect 1 with jitter", "largest", 1.3, why=band),
        Bound("aspect 4 with jitter", "largest", 4.8, why=band),
        Bound("aspect 4 with jitter", "1/smallest", 1 / 3, why=band),
        Bound("aspect 4 with jitter", "mean", 0.045, why="measured and 20 %; the jitter is 20 % of the compressed spacing"),
    )


class Lattices2D(Lattices):
    name = "ideal_h_lattice_2d"
    title = "square lattices, turned and distorted to aspect 4, without and with 10 % jitter"
    scene = "../../../inputs/ideal_h_lattice.toml"
    quick = full = (130, 150, 200)


class Lattices3D(Lattices):
    name = "ideal_h_lattice_3d"
    title = "cubic lattices, turned and distorted to aspect 4, without and with 10 % jitter"
    scene = "lattice_3d.toml"
    quick = full = (130, 150)
    inner = 3


class Round(AtRest):
    """Resolution: 100 n_h. SPH keeps what it has: distortion leaves the volume, so h stays as it was."""
    name = "ideal_h_lattice_sph"
    title = "the same square lattices with SPH"
    scene = "../../../inputs/ideal_h_lattice.toml"
    quick = full = (200,)
    bounds = (Bound("h where distorted", "relative", 0.17,
                    why="sums over a lattice seen through a circle; up to 0.145, where the circle reaches the surface"),
              Bound("h where round", "relative", 1e-4, why="exact sums"))

    def settings(self, resolution):
        return {**super().settings(resolution), "numerics.scheme": "sph"}

    def errors(self, run, resolution):
        state, errors = run.final, {}
        assert "smoothing_metric" not in state.names
        for key, body in (("where distorted", "distorted"), ("where round", "turned")):
            mask = run.body(body)
            x, spacing = state["position"][mask], np.mean(state.volume[mask]) ** 0.5
            inner = np.linalg.norm(x - x.mean(axis=0), axis=1) < 4 * spacing
            h = state["smoothing_length"][mask][inner]
            errors[f"h {key}", "relative"] = np.abs(h / (resolution / 100 * spacing) - 1).max()
        return errors


class Shear(Case):
    """Resolution: steps between votes. The largest mean aspect up to shear 20; neighbours kept."""
    exact = "none: the lattice is square again each time a row has moved on by a spacing, so a few are enough"
    scene = "shear.toml"
    rotation = "seen on the other lattices"
    boost = mixed_margin = "the motion is given"
    momentum = 1.0  # of a driven body
    small = {"time.max_steps": 20}
    depth = 8  # spacings from the middle
    name = "ideal_h_shear"
    title = "H with votes in endless shear, to 20"
    quick = full = (5,)
    bounds = (Bound("aspect", "largest mean", 7.1, why="5.9 measured; what moves with the flow comes to 402"),
              Bound("aspect", "largest", 7.5, why="the same of single particles"),
              Bound("h", "relative", 0.01, why="the number of neighbours stays"))

    def settings(self, resolution):
        return {"numerics.shape_interval": resolution}

    def errors(self, run, resolution):
        spacing = number(run.scene["resolution"]["spacing"])
        means, largest, h = [], [], []
        for state in run.states:
            inner = np.abs(state["position"][:, 1]) < self.depth * spacing
            long, short = axes(metrics(state)[inner])[0].T
            means.append((long / short).mean())
            largest.append((long / short).max())
            h.append(np.abs(state["smoothing_length"][inner] / (1.5 * spacing) - 1).max())
        return {("aspect", "largest mean"): max(means), ("aspect", "largest"): max(largest), ("h", "relative"): max(h)}


class Carried(Shear):
    """Resolution: the shear reached. H moved with the flow alone stays exact, and so grows without limit. At a shear of 20
    the aspect of 402 was missed by 27 % when it was last tried, and by nothing at 10."""
    name = "ideal_h_carried"
    title = "H without votes in endless shear"
    exact = "|H x| of fluid points stays: aspect 1 + g^2/2 + g sqrt(1 + g^2/4) at shear g"
    quick = full = (10,)
    depth = 3
    bounds = (Bound("aspect", "relative", 1e-10, why="round-off: the metric is carried exactly by the gradient"),)

    def settings(self, resolution):
        # Wide enough for ellipses that lean as far as a circle of the kernel's radius does.
        return {"numerics.shape_interval": 1000000, "time.end": (resolution, "s"), "output.snapshots": 1,
                "bodies.block.size": (1.28, 0.16, "m"), "boundary.min": (-0.64, -1, "m"), "boundary.max": (0.64, 1, "m")}

    def errors(self, run, resolution):
        state, g = run.final, resolution
        inner = np.abs(state["position"][:, 1]) < self.depth * number(run.scene["resolution"]["spacing"])
        long, short = axes(metrics(state)[inner])[0].T
        exact = 1 + g**2 / 2 + g * np.sqrt(1 + g**2 / 4)
        return {("aspect", "relative"): np.abs(long / short / exact - 1).max()}


CASES = [Lattices2D(), Lattices3D(), Round(), Shear(), Carried()]
