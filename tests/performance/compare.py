#!/usr/bin/python3
"""Which of two builds is faster: both take turns in one run, so that what else the machine does spoils neither.

  compare.py BEFORE AFTER [--filter REGEX] [--rounds N]

BEFORE and AFTER: ejecta_benchmarks of two builds. The table gives the medians of processor time per item of either, and
the median, least and greatest of the ratios before / after of neighbouring runs: above 1 the second build is faster. A
ratio of which the least is below 1 and the greatest above says nothing yet: more rounds. One thread on one core."""
import argparse
import json
import os
import subprocess
import sys
from statistics import median


def times(program, pattern):
    """{benchmark: processor time per item [ns]} of one run."""
    command = [program, "--benchmark_format=json", f"--benchmark_filter={pattern}"]
    run = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    if run.returncode != 0:
        sys.exit(f"{program}: ended with {run.returncode}: {run.stderr.strip()}")
    if not run.stdout.strip():
        sys.exit(f"--filter: expected the name of a benchmark or a part of it, got {pattern}: {run.stderr.strip()}")
    return {b["name"]: 1e9 / b["items_per_second"] for b in json.loads(run.stdout)["benchmarks"] if "items_per_second" in b}


def compare(before, after, pattern, rounds):
    """Rows of name, ns per item before, after, and the ratios of the rounds."""
    seen = []
    for k in range(rounds):
        order = (0, 1) if k % 2 == 0 else (1, 0)  # neither is always the second, on a warm core
        seen.append({which: times((before, after)[which], pattern) for which in order})
    for name in seen[0][0]:
        if name in seen[0][1]:
            a, b = ([run[which][name] for run in seen] for which in (0, 1))
            yield name, median(a), median(b), [x / y for x, y in zip(a, b)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before")
    parser.add_argument("after")
    parser.add_argument("--filter", default="pair_rates/3d/wendland_c2/double|step/3d/double|stage/", metavar="REGEX")
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    print(f"{'benchmark':58} {'before':>9} {'after':>9} {'ratio':>7}   least to greatest")
    for name, a, b, ratios in compare(options.before, options.after, options.filter, options.rounds):
        print(f"{name:58} {a:6.1f} ns {b:6.1f} ns {median(ratios):7.3f}   {min(ratios):.3f} to {max(ratios):.3f}")


if __name__ == "__main__":
    main()
