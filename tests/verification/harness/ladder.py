"""A case at several resolutions: errors, orders and what they cost."""
import csv
import dataclasses
import shutil
from dataclasses import dataclass

from .norms import order
from .run import execute


@dataclass
class Measurement:
    """One run of a case, after its files are gone."""
    resolution: int
    errors: dict     # (quantity, norm) -> error
    scene: dict      # every setting
    summary: dict
    core_seconds: float
    particle_steps: int
    energy_drift: float
    momentum_drift: float
    mass_drift: float


@dataclass
class Row:
    """One error in a form for machines."""
    case: str
    quantity: str
    norm: str
    resolution: int
    dimension: int
    scheme: str
    density: str
    kernel: str
    nodes_per_h: float
    gradient_correction: str  # auto, true, false; of grids this and the three above are empty
    courant: float
    precision: str
    threads: int
    particles: int  # or cells, at the end
    steps: int
    error: float
    order: float  # against the next coarser resolution; nan for the coarsest
    core_seconds: float
    particle_steps: int


def measure(case, resolution, workspace, settings=None, threads=1, keep=False):
    """Runs a case at a resolution, with further settings, in a folder of the workspace that is removed afterwards."""
    folder = workspace / f"{case.name}_{resolution}"
    run = execute(case.scene_file, {**case.settings(resolution), **(settings or {})}, folder, threads)
    try:
        return Measurement(resolution, case.errors(run, resolution), run.scene, run.summary, run.core_seconds,
                           run.particle_steps, run.energy_drift, run.momentum_drift, run.mass_drift)
    finally:
        if not keep:
            shutil.rmtree(folder)


def rows(case, measurements):
    """A row per quantity, norm and resolution."""
    result = []
    for key in measurements[0].errors if measurements else ():
        for coarse, m in zip([None, *measurements], measurements):
            numerics, error = m.scene["numerics"], m.errors[key]
            if numerics["scheme"] in ("fvm", "hybrid"):
                courant = m.scene["grid"].get("courant", 0.8 if m.summary["dimension"] == 2 else 0.45)
                method = "", "", float("nan"), "", courant
            else:
                method = (numerics["density"], numerics["kernel"], numerics["nodes_per_h"],
                          str(numerics["gradient_correction"]).lower(), numerics["courant"])
            result.append(Row(
                case.name, *key, m.resolution, m.summary["dimension"], numerics["scheme"], *method, numerics["precision"],
                m.summary["threads"], m.summary.get("cells") or m.summary["particles"], m.summary["steps"], error,
                order([coarse.resolution, m.resolution], [coarse.errors[key], error]) if coarse else float("nan"),
                m.core_seconds, m.particle_steps))
    return result


def write_rows(file, all_rows):
    with open(file, "w", newline="") as out:
        writer = csv.writer(out)
        writer.writerow([f.name for f in dataclasses.fields(Row)])
        writer.writerows(dataclasses.astuple(row) for row in all_rows)
