"""What is run for the figures of speed against error: problems, and what is varied. Data only."""
from dataclasses import dataclass


@dataclass(frozen=True)
class Study:
    """A verification case at several resolutions, and the error that its figures show."""
    case: str
    title: str
    quantity: str
    norm: str
    unit: str
    ladder: tuple
    quick: tuple
    without: tuple = ()  # names of axes that make no sense for it


@dataclass(frozen=True)
class Axis:
    """One choice: {label: settings on top of those of the scene}. The others are compared with the first label."""
    name: str
    title: str
    variants: dict
    of: str = ""  # the one case whose choice it is; none: of all that have no choice of their own


@dataclass(frozen=True)
class ToleranceStudy:
    """What the tolerance of the distension does to a whole run: solver and tolerance at one resolution."""
    case: str
    resolution: int
    quick: int
    quantity: str
    norm: str
    unit: str
    solvers: tuple
    tolerances: tuple


STUDIES = (
    Study("sod", "Sod's shock tube", "density", "L1", "kg/m^3", (50, 100, 200, 400), (25, 50, 100)),
    Study("noh_planar", "Noh, planar", "density", "L1", "kg/m^3", (25, 50, 100, 200), (25, 50, 100),
          without=("correction",)),  # the scene leaves the density at the start to summation
    Study("noh_cylindrical", "Noh, cylindrical", "density", "L1", "kg/m^3", (25, 50, 100), (20, 30, 40)),
    Study("sedov_cylindrical", "Sedov, cylindrical", "density", "L1", "kg/m^3", (20, 40, 80), (15, 25, 35)),
    Study("sedov_spherical", "Sedov, spherical", "density", "L1", "kg/m^3", (10, 15, 20), (10, 12, 15)),
    Study("compaction_shock_458", "Compaction shock", "density", "L1", "kg/m^3", (100, 200, 500), (50, 100, 200)),
)

BLAST = "hybrid_blast"
STUDIES += tuple(Study(BLAST, f"Blast of 1 kt, {title}", quantity, norm, "1", (10, 20, 40), (10, 20))
                 for title, quantity, norm in (("density of the shell at 1 ms", "density at 1000 us", "L1"),
                                               ("radius of the shock at 1 ms", "shock radius at 1000 us", "relative"),
                                               ("largest density", "peak density", "relative")))

# For all: a step ends at the time of every frame, drawn or not, which would hide what the time-step factor does.
COMMON = {"insitu.frames": 2}

KERNEL, N_H = "numerics.kernel", "numerics.nodes_per_h"
AXES = (
    Axis("precision", "Precision of the pair passes", {
        "double": {"numerics.precision": "double"},
        "mixed": {"numerics.precision": "mixed"}}),
    Axis("nodes_per_h", "Particles per smoothing length n_h, Wendland C2", {
        f"n_h {n:g}": {KERNEL: "wendland_c2", N_H: n} for n in (1.3, 1.5, 2.0)}),
    Axis("kernel", "Kernel, each with its usual n_h", {
        "quintic spline, 1.3": {KERNEL: "quintic_spline", N_H: 1.3},
        "cubic spline, 1.3": {KERNEL: "cubic_spline", N_H: 1.3},
        "Wendland C2, 1.5": {KERNEL: "wendland_c2", N_H: 1.5},
        "Wendland C4, 2.0": {KERNEL: "wendland_c4", N_H: 2.0}}),
    Axis("correction", "Density by continuity: gradient correction", {
        "off": {"numerics.density": "continuity", "numerics.gradient_correction": False},
        "on": {"numerics.density": "continuity", "numerics.gradient_correction": True}}),
    Axis("courant", "Time-step factor", {
        f"{c:g}": {"numerics.courant": c} for c in (0.25, 0.1, 0.4, 0.5)}),
    Axis("method", "Particles everywhere, at the shock alone, or none", {
        "particles": {"numerics.scheme": "gsph", "numerics.density": "summation", "boundary.max": (52, 52, "m")},
        "hybrid, ratio 2": {"hybrid.ratio": 2},
        "hybrid, ratio 4": {"hybrid.ratio": 4},
        "grid": {"numerics.scheme": "fvm"}}, of=BLAST),
)


def axes_of(study):
    """What is varied in a study."""
    own = [axis for axis in AXES if axis.of == study.case]
    return own or [axis for axis in AXES if not axis.of and axis.name not in study.without]


TOLERANCE = ToleranceStudy("compaction_shock_458", 200, 100, "density", "L1", "kg/m^3",
                           ("safe_newton", "bisection", "newton"),
                           (1e-7, 1e-8, 1e-9, 1e-10, 1e-12, 1e-14))  # the program takes no looser ones
