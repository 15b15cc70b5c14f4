"""Scenes against what they cost: stages, columns, bytes per particle and, with --time, time per particle-step.

    EJECTA=build/ejecta python3 tests/cost/cost.py [--time] [--csv FILE]

Everything but the times is exact. Times are those of one thread, the least of three short runs."""
import argparse
import csv
import os
import re
import sys
import tempfile
from pathlib import Path

os.environ.setdefault("EJECTA_SOURCE", str(Path(__file__).resolve().parents[2]))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "end_to_end"))
import ejecta_run  # noqa: E402
from features import ALGORITHM, CASES, bytes_of  # noqa: E402

STEPS, REPETITIONS = 40, 3
EVERY_STEP = ["time step", "integration", "health"]  # what a step does beside its stages


def check(case):
    """Stages in order, columns with their components, estimated bytes per particle, as `ejecta check` prints them."""
    done = ejecta_run.ejecta("check", case.scene, *ejecta_run.settings(case.all_settings))
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    sections = re.split(r"^(?=\w)", done.stdout, flags=re.M)
    text = {section.split("\n", 1)[0]: section for section in sections}
    stages = re.findall(r"^  (\w[\w ]*?) +reads", text["stages"], re.M)
    columns = {name: int(n) for name, n in re.findall(r"^  (\w+) +(\d+) x", text["columns"], re.M)}
    return stages, columns, int(re.search(r"(\d+) bytes a particle", text["estimate"])[1])


def run(case, folder, **settings):
    """Runs the scene on one thread; returns the summary and the seconds of each timer."""
    settings = {**case.all_settings, **{key.replace("__", "."): value for key, value in settings.items()}}
    done = ejecta_run.ejecta("run", case.scene, "--out", folder, "--threads", 1, *ejecta_run.settings(settings),
                             environment={"OMP_WAIT_POLICY": "passive"})
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    timers = ejecta_run.Table(folder / "timers.csv")
    return ejecta_run.summary(folder), dict(zip(timers["name"], timers.numbers("wall time")))


def time_per_particle_step(case):
    """Nanoseconds of one particle in one step, by stage."""
    best = {}
    for repetition in range(REPETITIONS):
        with tempfile.TemporaryDirectory(prefix="ejecta_cost_") as folder:
            done, seconds = run(case, Path(folder) / "run", time__max_steps=STEPS)
        for name, value in seconds.items():
            per_step = 1e9 * value / (done["particles"] * done["steps"])
            best[name] = min(best.get(name, per_step), per_step)
    return best


def row(case, timed):
    stages, columns, _ = check(case)
    with tempfile.TemporaryDirectory(prefix="ejecta_cost_") as folder:
        memory, _ = run(case, Path(folder) / "run", time__max_steps=1)
    cells = {"scene": case.name, "stages": len(stages), "columns": sum(columns.values()),
             "columns [byte/particle]": bytes_of(columns),
             "all memory [byte/particle]": round(memory["bytes_per_particle"])}
    if timed:
        times = time_per_particle_step(case)
        cells["time [ns/particle/step]"] = round(sum(times[name] for name in (*stages, *EVERY_STEP)))
        cells |= {f"{name} [ns]": round(times.get(name, 0), 1) for name in (*ALGORITHM, *EVERY_STEP)}
    return cells


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--time", action="store_true", help="measure times too (machine idle, about a minute)")
    options.add_argument("--csv", type=Path, help="write the table to this file")
    options = options.parse_args()
    rows = []
    for case in CASES:
        rows.append(row(case, options.time))
        shown = [f"{value:>12}" for value in list(rows[-1].values())[1:6]]
        if case is CASES[0]:
            heads = ("stages", "columns", "their bytes", "all bytes", "ns/step")[:len(shown)]
            print(f"{'scene':<38}" + "".join(f"{head:>12}" for head in heads))
        print(f"{case.name:<38}" + "".join(shown), flush=True)
    if options.csv:
        with open(options.csv, "w", newline="") as file:
            table = csv.DictWriter(file, rows[0].keys())
            table.writeheader()
            table.writerows(rows)


if __name__ == "__main__":
    main()
