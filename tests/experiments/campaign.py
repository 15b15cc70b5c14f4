#!/usr/bin/python3
"""Runs the impact experiments one after the other and puts them beside the laboratory.

    tests/experiments/campaign.py --binary build/ejecta --out DIR [--quick | --trial] [--threads 2] [--only NAME]

One folder a run in DIR; a run that is already finished there is not repeated, so the same line goes on after an
interruption. Tables (CSV and Markdown) and figures (gnuplot, ffmpeg) end up in DIR/results.
--quick: the coarsest spacing with one seed. --trial: one seed of everything at 3 mm, to try the campaign itself.
--only: runs whose name contains NAME; --report: no runs, results only.
"""
import argparse
import os
import subprocess
import sys
from pathlib import Path

import results
from cases import cases

ROOT = Path(__file__).resolve().parents[2]


def log_of(folder):
    return folder.parent / (folder.name + ".log")


def run(case, binary, folder, threads):
    """One run, its messages in <folder>.log. True if its folder holds a finished run afterwards."""
    if results.finished(folder):
        return True
    command = [str(binary), "run", str(ROOT / "inputs" / (case.scene + ".toml")), "--out", str(folder), "--overwrite",
               "--threads", str(threads)]
    for key, value in case.settings.items():
        command += ["--set", f"{key}={value}"]
    print(f"{case.name}: {' '.join(command)}", flush=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
    with open(log_of(folder), "w") as log:
        # Threads that wait asleep leave the cores to others; spinning ones are slow where cores are shared.
        environment = os.environ | {"OMP_WAIT_POLICY": "passive"}
        code = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, env=environment).returncode
    if code != 0:
        print(f"{case.name}: exit {code}, see {log_of(folder)}", file=sys.stderr)
    return code == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", type=Path, default=ROOT / "build/ejecta")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--only", default="")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--trial", action="store_true")
    parser.add_argument("--report", action="store_true", help="no new runs")
    options = parser.parse_args()

    chosen = [c for c in cases(options.quick, options.trial) if options.only in c.name]
    if not chosen:
        parser.error(f"no case is called {options.only}")
    binary, out = options.binary.resolve(), options.out.resolve()
    failed = 0
    if not options.report:
        for case in chosen:
            failed += not run(case, binary, out / case.name, options.threads)
    done = [c for c in chosen if results.finished(out / c.name)]
    results.write(done, out, binary)
    for table in ("averages", "runs"):
        if done:
            print((out / "results" / f"{table}.md").read_text())
    print(f"{len(done)} of {len(chosen)} runs finished; results in {out / 'results'}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
