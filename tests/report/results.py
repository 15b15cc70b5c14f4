"""Reads the tables of a campaign and compares curves of error against cost."""
import csv
import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

CORE_SECONDS, PARTICLE_STEPS = "core_seconds", "particle_steps"


def typed(cell):
    for kind in (int, float):
        try:
            return kind(cell)
        except ValueError:
            pass
    return {"True": True, "False": False}.get(cell, cell)


def read_csv(file):
    """Rows as dictionaries with numbers; no rows if there is no such file."""
    if not file.exists():
        return []
    with open(file, newline="") as lines:
        return [{key: typed(cell) for key, cell in row.items()} for row in csv.DictReader(lines)]


@dataclass
class Results:
    meta: dict
    errors: list
    solver: list
    tolerance: list
    profiles: dict  # case -> [(axis label, resolution, label, x, computed, exact)]

    @classmethod
    def read(cls, folder):
        folder, profiles = Path(folder), {}
        if (folder / "profiles.npz").exists():
            for key, values in np.load(folder / "profiles.npz").items():
                case, axis, resolution, _, label = key.split("|")
                profiles.setdefault(case, []).append((axis, int(resolution), label, *values))
        return cls(json.loads((folder / "run.json").read_text()), *(
            read_csv(folder / f"{name}.csv") for name in ("errors", "solver", "tolerance")), profiles)

    def curve(self, study, axis, label):
        """The rows of one variant, coarse to fine; empty if it was not run."""
        return [row for row in self.errors
                if row["part"] == "speed" and f"{axis.name}={label}" in row["variants"].split(";")
                and (row["case"], row["quantity"], row["norm"]) == (study.case, study.quantity, study.norm)]

    def curves(self, study, axis):
        found = {label: self.curve(study, axis, label) for label in axis.variants}
        return {label: rows for label, rows in found.items() if rows}


def cost_at(rows, error, cost):
    """Least cost at which a curve reaches an error, by interpolation of the logarithms; nan if it does not reach it.

    Where a finer run is no better, it counts for nothing. A curve that starts below the error (`at_once`) costs at most
    what its first run costs, which is returned.
    """
    front = []
    for row in sorted(rows, key=lambda row: row[cost]):
        if row["error"] > 0 and (not front or row["error"] < front[-1]["error"]):
            front.append(row)
    for before, row in zip([None, *front], front):
        if row["error"] <= error:
            if before is None:
                return row[cost]
            share = math.log(before["error"] / error) / math.log(before["error"] / row["error"])
            return before[cost] * (row[cost] / before[cost]) ** share
    return math.nan


def at_once(rows, error):
    return rows[0]["error"] <= error


@dataclass
class Comparison:
    """A variant beside the first of its axis."""
    label: str
    rows: list
    error: float           # at the finest resolution
    relative_error: float  # to that of the first variant, at the finest resolution of both
    order: float           # fitted to the ladder
    cost: dict             # core-seconds and particle-steps at the finest resolution
    at_equal_error: dict   # the same to reach the target, relative to the first variant; nan: not reached
    at_most: bool          # the coarsest run is better than the target: it costs less than said

    def ratio(self, cost):
        """For people."""
        value = self.at_equal_error[cost]
        return "–" if math.isnan(value) else f"{'at most ' if self.at_most else ''}{value:.2f}"


def compare(curves):
    """Target error and comparisons. The target is the error of the first variant at its second finest resolution."""
    reference = next(iter(curves.values()))
    target = reference[max(len(reference) - 2, 0)]["error"]
    of_reference = {row["resolution"]: row["error"] for row in reference}
    return target, [
        Comparison(label, rows, rows[-1]["error"],
                   next((row["error"] / of_reference[row["resolution"]] for row in reversed(rows)
                         if row["resolution"] in of_reference), math.nan), rows[-1]["fitted_order"],
                   {cost: rows[-1][cost] for cost in (CORE_SECONDS, PARTICLE_STEPS)},
                   {cost: cost_at(rows, target, cost) / cost_at(reference, target, cost)
                    for cost in (CORE_SECONDS, PARTICLE_STEPS)}, rows is not reference and at_once(rows, target))
        for label, rows in curves.items()]
