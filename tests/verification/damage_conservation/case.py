"""Crushing and cracking in a small impact: damage never heals, and the order of the bodies does not matter."""
import tempfile
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from harness import Bound, Case
from harness.run import execute
from harness.transform import toml


class DamageConservation(Case):
    """Resolution: particles per millimetre."""
    name = "damage_conservation"
    title = "nylon into pumice on basalt: damage grows, energy and momentum stay, the order of bodies does not matter"
    exact = "damage never heals; the laws of conservation; flaws belong to places"
    quick = (1,)
    full = (1, 2, 4)
    boost, boost_speed = "x", 1000.0
    # Flaws belong to places, and a turned scene has others: turned and moving runs break by crushing alone.
    small = {"time.max_steps": 40, "materials.pumice.damage.model": "none", "materials.basalt.damage.model": "none"}
    mixed_margin = "all limits are of round-off or exact"
    bounds = (
        Bound("damage", "largest decrease", 0.0, why="exact"),
        Bound("damage", "outside 0 to 1", 0.0, why="exact"),
        Bound("flaws", "bodies backwards", 0.0, why="exact"),
        Bound("damage", "bodies backwards", 1e-8, why="round-off of sums in another order, amplified by the flow"),
        Bound("pressure", "bodies backwards", 1e-8, why="the same, relative to the largest"),
    )

    def settings(self, resolution):
        return {"resolution.spacing": (1 / resolution, "mm")}

    def errors(self, run, resolution):
        damage = np.array([state["damage"] for state in run.states])
        broken = np.mean(damage[-1] > 0.5)
        assert broken > 0.2, f"only {broken:.0%} broken: the scene shows nothing"
        errors = {("damage", "largest decrease"): float(max(np.max(damage[:-1] - damage[1:]), 0)),
                  ("damage", "outside 0 to 1"): float(max(damage.max() - 1, -damage.min(), 0))}
        one, other = run.final, self.backwards(run)
        _, partner = cKDTree(other["position"]).query(one["position"])
        assert len(np.unique(partner)) == len(one), "particles of the two runs are elsewhere"
        apart = {name: float(np.abs(one[name] - other[name][partner]).max())
                 for name in ("flaw_strain", "damage", "pressure")}
        errors["flaws", "bodies backwards"] = max(value for name, value in apart.items() if name.startswith("flaw"))
        errors["damage", "bodies backwards"] = apart["damage"]
        errors["pressure", "bodies backwards"] = apart["pressure"] / float(np.abs(one["pressure"]).max())
        return errors

    def backwards(self, run):
        """The last state of the same scene with its bodies listed in the opposite order."""
        with tempfile.TemporaryDirectory() as folder:
            scene = Path(folder) / "backwards.toml"
            scene.write_text(toml({**run.scene, "bodies": run.scene["bodies"][::-1]}))
            final = execute(scene, {}, Path(folder) / "run").final
            for name in ("position", "flaw_strain", "damage", "pressure"):
                final[name]  # read before the folder is gone
            return final


CASES = [DamageConservation()]
