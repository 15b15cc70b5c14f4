#!/usr/bin/python3
"""ASPH and SPH on one bursting tube for the same core time: how damaged were the links of the steel that broke?

    EJECTA=build/ejecta tests/experiments/tube_links.py --out DIR [--seeds 3] [--sph 0.8] [--flaws 0.01]

The scene is inputs/he_tube_2d.toml: ASPH at its spacing, SPH at that spacing and at one at which a run takes as long
(--sph, as a share of it), each with corrected gradients and forces and without; --flaws makes the steel's flaws so many
times as many, so that it stretches further before it breaks. Runs already finished in DIR are not
repeated. Prints the table of docs/results.md. A link is a pair of particles of steel a spacing apart at the start; it is
broken where they are out of each other's reach, and its damage is the larger one of both. Needs numpy, scipy and h5py.
"""
import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/verification"))
from harness.links import SUPPORT, broken_links, lattice_links  # noqa: E402
from harness.run import PROGRAM, Run, number  # noqa: E402

SPACING, FLAWS = 1.0, 2.64e9  # mm; k of the steel, 1/m^2: those of the scene
TIMES = (10, 15, 20, 40)  # us


def run(folder, scheme, share, corrected, seed, flaws):
    """A run on one core; its user time [s] is kept beside its results."""
    if not (folder / "core_seconds").exists():
        command = [PROGRAM, "run", ROOT / "inputs/he_tube_2d.toml", "--out", folder, "--threads", "1", "--overwrite"]
        for key, value in {"numerics.scheme": scheme, "numerics.gradient_correction": str(corrected).lower(),
                           "materials.aermet_100.damage.weibull_k": f"{flaws * FLAWS} 1/m^3",
                           "random.seed": seed, "resolution.spacing": f"{share * SPACING} mm", "insitu.enabled": "false",
                           "output.times": json.dumps([f"{t} us" for t in TIMES])}.items():
            command += ["--set", f"{key}={value}"]
        before = os.times()
        done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "OMP_WAIT_POLICY": "passive"})
        if done.returncode != 0:
            sys.exit(f"{folder}: exit {done.returncode}\n{done.stderr}")
        after = os.times()
        (folder / "core_seconds").write_text(str(after.children_user - before.children_user))
    return Run(folder), float((folder / "core_seconds").read_text())


def links_of(result):
    """Links of the steel at the start, of a run of one step."""
    folder = result.folder / "start"
    if not folder.exists():
        subprocess.run([PROGRAM, "run", result.folder / "resolved.toml", "--out", folder, "--threads", "1",
                        "--set", "time.max_steps=1", "--set", "output.times=[]"], check=True, capture_output=True)
    tube = result.scene["bodies"][1]
    assert tube["name"] == "tube"
    spacing = number(result.scene["resolution"]["spacing"]) * tube["spacing_factor"]
    return lattice_links(Run(folder).final, spacing, body=1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--sph", type=float, default=0.8)
    parser.add_argument("--flaws", type=float, default=1)
    options = parser.parse_args()
    print("| scheme | particles through the wall | corrected | core seconds | pieces | largest [%] | dust [%] | links broken | "
          + " | ".join(f"sound by {t} us [%]" for t in TIMES) + " | median damage |")
    for corrected in (True, False):
        for scheme, share in (("asph", 1), ("sph", 1), ("sph", options.sph)):
            rows = []
            for seed in range(1, options.seeds + 1):
                folder = options.out / f"{scheme}_{share:g}_{corrected}_{options.flaws:g}_{seed}"
                result, seconds = run(folder, scheme, share, corrected, seed, options.flaws)
                links, support = links_of(result), SUPPORT[result.scene["numerics"]["kernel"]]
                tube = result.summary["bodies"]["tube"]
                broken = [broken_links(state, links, support) for state in result.states]
                rows.append([seconds, tube["fragments"], 100 * tube["largest_fragment_mass_fraction"],
                             100 * tube["dust_mass_fraction"], 100 * len(broken[-1]) / len(links),
                             *(100 * np.mean(d < 0.5) if len(d) else np.nan for d in broken), np.median(broken[-1])])
            through = 3 / (SPACING * share * 0.5)
            print(f"| {scheme} | {through:.3g} | {'yes' if corrected else 'no'} | "
                  + " | ".join(spread(column) for column in zip(*rows)) + " |", flush=True)


def spread(values):
    low, high = (f"{v:.3g}" for v in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


if __name__ == "__main__":
    main()
