"""What a verification case is."""
import importlib
import inspect
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


@dataclass(frozen=True)
class Bound:
    """What is asked of one error: limits at resolutions {100: 0.0065} or one for all, and the least order."""
    quantity: str
    norm: str
    limits: dict | float
    order: float | None = None  # over the whole ladder
    why: str = ""  # where the limits come from; why no order is asked, if none is
    up_to: float = float("inf")  # the order is that of the resolutions up to this one

    def limit(self, resolution):
        """The limit at a resolution, or None."""
        return self.limits.get(resolution) if isinstance(self.limits, dict) else self.limits

    def __str__(self):
        limits = self.limits.items() if isinstance(self.limits, dict) else [("all", self.limits)]
        order = "no order asked" if self.order is None else f"order >= {self.order}"
        if self.order is not None and self.up_to < float("inf"):
            order += f" up to {self.up_to}"
        return ", ".join(f"<= {limit:.4g} at {r}" for r, limit in limits) + f", {order}"


class Case:
    """One problem with a known answer. Subclasses set the attributes and define settings() and errors()."""
    name: str               # unique, lower case
    title: str              # one line
    exact: str              # the exact solution and its source
    scene = "scene.toml"    # beside case.py
    quick: tuple = ()       # resolutions of an ordinary test run: seconds
    full: tuple = ()        # resolutions of the long test and of the report
    bounds: tuple = ()      # of Bound
    energy = 1e-12          # largest relative drift of total energy during any run
    momentum = 1e-12        # the same of linear momentum, along axes without walls
    mass = 1e-14            # the same of mass
    # Small run for the invariances: settings on top of those of the coarsest resolution, and what applies.
    small = {"time.max_steps": 40}
    tolerance = 1e-10       # of rotated and boosted runs, relative to the largest value of each field
    rotation = True         # turned by 90 degrees about z; or a text: why that makes no sense
    boost = ""              # axis ("x", "y", "z") of the boost; or a text: why that makes no sense
    boost_speed = 1.0       # m/s, of the order of the speeds in the problem
    mixed_margin = 0.05     # mixed precision may change each error by this fraction of it; or a text: why not
    mixed_drift = 1e-7      # largest relative drift of energy and momentum in mixed precision

    def settings(self, resolution):
        """Settings of the scene for this resolution, as for --set."""
        raise NotImplementedError

    def errors(self, run, resolution):
        """{(quantity, norm): error} of a finished run."""
        raise NotImplementedError

    profile_axis = "x [m]"

    def profiles(self, run):
        """For a figure: [("density [kg/m^3]", x, computed, exact), ...], arrays with a value per particle."""
        return []

    def check_exact(self):
        """Asserts that the exact solution itself gives the numbers that are printed elsewhere."""

    @property
    def scene_file(self):
        return Path(inspect.getfile(type(self))).parent / self.scene

    @property
    def folder(self):
        return Path(inspect.getfile(type(self))).parent.name


class GridCase(Case):
    """One that finite volumes solve, or the same problem for them: class GridSod(GridCase, Sod)."""
    boost = "a flow through the cells is smeared as one that is at rest is not: boosts change the truncation error"
    mixed_margin = "a grid knows one precision"
    mass = 1e-12            # what came and went through faces is part of the sum


def load_cases(word=None):
    """All cases, or those of a folder or a name."""
    folders = sorted(file.parent.name for file in ROOT.glob("*/case.py"))
    if word in folders:
        folders, word = [word], None
    cases = [case for folder in folders for case in importlib.import_module(f"{folder}.case").CASES]
    return [case for case in cases if word in (None, case.name)]
