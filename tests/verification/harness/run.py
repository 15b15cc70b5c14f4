"""One run of the program, and the particles or cells and the tables it left."""
import csv
import json
import os
import re
import subprocess
import tomllib
from functools import cached_property
from pathlib import Path

import h5py
import numpy as np

from .grid_state import GridState

SOURCE = Path(__file__).resolve().parents[3]
PROGRAM = os.environ.get("EJECTA", str(SOURCE / "build" / "ejecta"))


class RunFailed(Exception):
    """The program ended with an error; the text is its own."""


class State:
    """All particles at one time, sorted by id: state["density"], state["velocity"] (one row a particle), state["id"].

    Stress deviators have the components xx, yy, xy in 2D and xx, yy, xy, xz, yz in 3D.
    """

    def __init__(self, file):
        self._file, self._cache = file, {}
        with h5py.File(file) as data:
            self.time, self.step = float(data.attrs["time"]), int(data.attrs["step"])
            self._order = np.argsort(data["labels/id"][:])
            # Names with a dot are not of particles.
            self.names = sorted({re.sub(r"_\d+$", "", name) for name in data["columns"] if "." not in name})

    def __getitem__(self, name):
        if name not in self._cache:
            with h5py.File(self._file) as data:
                columns = data["columns"]
                if name in data["labels"]:
                    values = data["labels"][name][:]
                elif name in columns:
                    values = columns[name][:]
                else:
                    parts = sorted(key for key in columns if re.fullmatch(rf"{name}_\d+", key))
                    if not parts:
                        raise KeyError(f"{name}: the state has {', '.join(self.names)}")
                    values = np.stack([columns[key][:] for key in parts], axis=-1)
            self._cache[name] = values[self._order]
        return self._cache[name]

    def __len__(self):
        return len(self._order)

    @property
    def volume(self):
        return self["mass"] / self["density"]


class Run:
    """A run folder."""

    def __init__(self, folder):
        self.folder = Path(folder)

    @cached_property
    def summary(self):
        return json.loads((self.folder / "summary.json").read_text())

    @cached_property
    def scene(self):
        """Every setting of the run (resolved.toml); quantities as text with their SI unit, see `number`."""
        return tomllib.loads((self.folder / "resolved.toml").read_text())

    @cached_property
    def history(self):
        """Columns of history.csv by their name without the unit."""
        with open(self.folder / "history.csv", newline="") as lines:
            header, *table = csv.reader(lines)
        names = [re.sub(r" \[.*\]$", "", name) for name in header]
        columns = dict(zip(names, zip(*table)))
        return {name: list(column) if name == "limited by" else np.array([float(cell or "nan") for cell in column])
                for name, column in columns.items()}

    @cached_property
    def final(self):
        return self.state(max((self.folder / "checkpoints").glob("*.h5")))

    def state(self, file):
        """What a full dump holds: particles, or the cells of a grid."""
        if not self.on_grid:
            return State(file)
        spacing = number(self.scene["resolution"]["spacing"]) * self.scene.get("hybrid", {}).get("ratio", 1)
        return GridState(file, spacing, next(iter(self.scene["materials"].values()))["eos"]["gamma"])

    @cached_property
    def states(self):
        """The snapshots (output.snapshots) in the order of time."""
        return [self.state(file) for file in sorted((self.folder / "snapshots").glob("*.h5"))]

    def body(self, name, state=None):
        """Mask of the particles of a body."""
        names = [body["name"] for body in self.scene["bodies"]]
        return (state or self.final)["body"] == names.index(name)

    @property
    def on_grid(self):
        return self.scene["numerics"]["scheme"] in ("fvm", "hybrid")

    @property
    def dimension(self):
        return self.scene["scene"]["dimension"]

    @property
    def core_seconds(self):
        """Time of all threads without in-situ work."""
        s = self.summary
        return s["wall_s"] * s["threads"] * (1 - s["insitu_share"])

    @property
    def particle_steps(self):
        """And steps of cells: those at rest are skipped, and a box that grows had fewer at first."""
        return round(self.summary["element_steps"])

    @property
    def energy_drift(self):
        """Largest relative error of total energy during the run."""
        return float(np.abs(self.history["energy error"]).max())

    @property
    def mass_drift(self):
        """Without what came and went through the faces of a grid."""
        if self.on_grid:
            return self.summary["mass_error_rel"]
        return float(np.ptp(self.history["mass"]) / self.history["mass"][0])

    @property
    def momentum_drift(self):
        """Largest change of linear momentum along the axes without walls, relative to a bound on the sum of m times the
        speeds of particles and of sound (Cauchy-Schwarz); nan if there is a wall on every axis. The books of a grid
        hold what faces took, walls or not."""
        if self.on_grid:
            return self.summary["momentum_error_rel"]
        boundary = self.scene["boundary"]
        free = [axis for axis in "xyz"[:self.dimension] if not any(
            boundary.get(key) in ("reflecting", "symmetry") for key in (axis, f"{axis}_min", f"{axis}_max"))]
        energy = self.history["kinetic energy"] + np.abs(self.history["internal energy"])
        scale = np.sqrt(2 * self.history["mass"] * energy).max()
        drifts = [np.abs(p - p[0]).max() for axis in free for p in [self.history[f"momentum {axis}"]]]
        return float(max(drifts) / scale) if drifts and scale > 0 else float("nan")


def number(text):
    """3.5 of "3.5 m": quantities of resolved.toml."""
    return float(str(text).split()[0])


def execute(scene, settings, folder, threads=1, timeout=3600):
    """Runs a scene with settings ({"time.end": "1 us", "bodies.a.size": [1, 2, "m"]}) into a folder."""
    words = []
    for key, value in settings.items():
        text = " ".join(map(str, value)) if isinstance(value, (list, tuple)) else str(value)
        words += ["--set", f"{key}={text.lower() if isinstance(value, bool) else text}"]
    environment = {**os.environ, "OMP_WAIT_POLICY": "passive"}
    result = subprocess.run([PROGRAM, "run", str(scene), "--out", str(folder), "--threads", str(threads), *words],
                            capture_output=True, text=True, timeout=timeout, env=environment)
    if result.returncode != 0:
        raise RunFailed(f"{Path(scene).name} ended with code {result.returncode}: {result.stderr.strip()[-2000:]}")
    return Run(folder)
