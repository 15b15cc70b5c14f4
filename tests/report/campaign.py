"""Runs everything, one run at a time, and writes what was measured: tables of numbers, no figures.

    errors.csv     a line per error of a run        profiles.npz  particles and exact solutions
    solver.csv     zero finders of the distension   tolerance.csv runs with loose and tight tolerances
    run.json       machine, commit, load, failures
"""
import csv
import dataclasses
import re
import shutil
import subprocess
import sys
from statistics import median

import numpy as np
from harness import Run, RunFailed, execute, measure, order, rows

from studies import COMMON, STUDIES, TOLERANCE, axes_of

SHORT = 2.0  # s; runs up to this are repeated, and their median counts
REPEATS = 3


def log(text):
    print(text, file=sys.stderr, flush=True)


def describe(failure):
    """The line of the program's log that is an error, or what went wrong in the evaluation."""
    if not isinstance(failure, RunFailed):
        return f"{type(failure).__name__}: {failure}"
    words = re.search(r"^[\d:]+ E (.*)$", str(failure), re.MULTILINE)
    return words[1] if words else str(failure).splitlines()[-1]


def write_csv(file, table):
    with open(file, "w", newline="") as out:
        writer = csv.DictWriter(out, table[0])
        writer.writeheader()
        writer.writerows(table)


def error_table(case, measurements, **more):
    """harness.Row of each error, and what this report adds."""
    fitted = {key: order([m.resolution for m in measurements], [m.errors[key] for m in measurements])
              for key in measurements[0].errors}
    of = {m.resolution: m for m in measurements}
    return [{**more, **dataclasses.asdict(row), "fitted_order": fitted[row.quantity, row.norm],
             "energy_drift": of[row.resolution].energy_drift, "momentum_drift": of[row.resolution].momentum_drift}
            for row in rows(case, measurements)]


def verification(cases, full, workspace, failures):
    """Errors of every case on its ladder; profiles of the coarsest and the finest run."""
    table, profiles = [], {}
    for case in cases:
        log(f"verification: {case.name}")
        ladder, measurements = case.full if full else case.quick, []
        for resolution in ladder:
            folder = workspace / f"{case.name}_{resolution}"
            try:
                measurements.append(measure(case, resolution, workspace, keep=True))
                if resolution in (ladder[0], ladder[-1]):
                    for k, (label, x, computed, exact) in enumerate(case.profiles(Run(folder))):
                        by_x = np.argsort(x, kind="stable")
                        profiles[f"{case.name}|{case.profile_axis}|{resolution}|{k}|{label}"] = np.stack(
                            [x[by_x], computed[by_x], exact[by_x]])
            except Exception as failure:  # whatever is wrong with one case must not take the others' results along
                failures.append(f"{case.name} at {resolution}: {describe(failure)}")
            shutil.rmtree(folder, ignore_errors=True)
        if measurements:
            table += error_table(case, measurements, part="verification", variants="", settings="", repeats=1)
    return table, profiles


def speed(study, case, axes, quick, workspace, failures):
    """All variants of all axes of a study, taking turns, so that other work on the machine hits them alike."""
    ladder = study.quick if quick else study.ladder
    scene = measure(case, ladder[0], workspace).scene
    names, settings = {}, {}  # by what a variant comes to: two that come to the same are run once
    for axis in axes:
        for label, changes in axis.variants.items():
            changed = {k: v for k, v in changes.items() if value(scene, k) != v}
            key = text(changed)
            names.setdefault(key, []).append(f"{axis.name}={label}")
            settings[key] = changed
    series = {key: [] for key in settings}
    for resolution in ladder:
        log(f"speed: {case.name} at {resolution}, {len(settings)} variants")
        turns = {key: [] for key in settings}
        for _ in range(REPEATS):
            for key in list(turns):
                try:
                    turns[key].append(measure(case, resolution, workspace, {**COMMON, **settings[key]}))
                except Exception as failure:
                    failures.append(f"{case.name} at {resolution} with {text(settings[key])}: {describe(failure)}")
                    shutil.rmtree(workspace / f"{case.name}_{resolution}", ignore_errors=True)
                    del turns[key]
            if max((turn[-1].core_seconds for turn in turns.values()), default=SHORT) >= SHORT:
                break
        for key, turn in turns.items():
            if any(m.errors != turn[0].errors for m in turn):
                failures.append(f"{case.name} at {resolution}: repeating the run changes its errors")
            seconds = median(m.core_seconds for m in turn)
            series[key].append((dataclasses.replace(turn[0], core_seconds=seconds), len(turn)))
    return [row for key, turns in series.items() if turns
            for row in error_table(case, [m for m, _ in turns], part="speed", variants=";".join(names[key]),
                                   settings=text(settings[key]), repeats=min(count for _, count in turns))]


def value(scene, key):
    """Of a resolved scene; nothing if it has none."""
    for word in key.split("."):
        scene = scene.get(word, {})
    return scene


def text(settings):
    def words(value):
        if isinstance(value, tuple):
            return " ".join(map(str, value))
        return str(value).lower() if isinstance(value, bool) else str(value)
    return " ".join(f"{key}={words(value)}" for key, value in settings.items()) or "the scene's own settings"


def tolerance(case, quick, workspace, failures):
    """Runs with each solver and tolerance: error, distance from the tightest run, time."""
    study, table, fields = TOLERANCE, [], {}
    resolution = study.quick if quick else study.resolution
    variants = [(s, t) for s in study.solvers for t in study.tolerances]
    seconds = {variant: [] for variant in variants}
    for repeat in range(REPEATS):
        log(f"tolerance: {case.name} at {resolution}, {len(variants)} variants, turn {repeat + 1}")
        for solver, tol in list(seconds):
            folder = workspace / "tolerance"
            try:
                run = execute(case.scene_file, {**case.settings(resolution), "numerics.distension_solver": solver,
                                                "numerics.distension_tolerance": tol}, folder)
            except RunFailed as failure:
                failures.append(f"{case.name} with {solver}, tolerance {tol:g}: {describe(failure)}")
                shutil.rmtree(folder, ignore_errors=True)
                del seconds[solver, tol]
                continue
            seconds[solver, tol].append(run.core_seconds)
            if repeat == 0:
                fields[solver, tol] = {name: run.final[name] for name in ("distension", "pressure")}
                table.append({"solver": solver, "tolerance": tol, "error": case.errors(run, resolution)[
                    study.quantity, study.norm], "steps": run.summary["steps"], "energy_drift": run.energy_drift})
            shutil.rmtree(folder)
    tightest = fields.get((study.solvers[0], min(study.tolerances)))
    for row in table:
        mine = fields[row["solver"], row["tolerance"]]
        for name in ("distension", "pressure"):
            row[f"{name}_difference"] = float(np.abs(mine[name] - tightest[name]).max()
                                              / np.abs(tightest[name]).max()) if tightest else float("nan")
        row["core_seconds"] = median(seconds[row["solver"], row["tolerance"]])
    return table


def solver(program, quick):
    log("solver: random states")
    result = subprocess.run([program, "20000" if quick else "200000"], capture_output=True, text=True, check=True)
    return result.stdout


def run_campaign(options, parts, cases, workspace, meta):
    """Writes the tables that the chosen parts give into options.out. `parts` are words of report.py --only."""
    out, failures, table = options.out, meta["failures"], []
    stamp = {"commit": meta["commit"], "machine": meta["machine"]}
    if "verification" in parts and options.verify != "none":
        found, profiles = verification(cases, options.verify == "full", workspace, failures)
        table += found
        np.savez_compressed(out / "profiles.npz", **profiles)
    by_name = {case.name: case for case in cases}
    for study in {study.case: study for study in STUDIES}.values():  # those of one case differ by what they show
        wanted = [axis for axis in axes_of(study) if axis.name in parts]
        if wanted and study.case in by_name:
            try:
                table += speed(study, by_name[study.case], wanted, options.quick, workspace, failures)
            except Exception as failure:
                failures.append(f"{study.case}: {describe(failure)}")
    if table:
        write_csv(out / "errors.csv", [{**row, **stamp} for row in table])
    if "tolerance" in parts and TOLERANCE.case in by_name:
        found = tolerance(by_name[TOLERANCE.case], options.quick, workspace, failures)
        if found:
            write_csv(out / "tolerance.csv", [{**row, **stamp} for row in found])
    if "solver" in parts and options.solver_work:
        (out / "solver.csv").write_text(solver(options.solver_work, options.quick))
