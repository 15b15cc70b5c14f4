"""How fast a rubber ring stops ringing after the bounce: python3 ring_down.py RUN_FOLDER, of a run such as
ejecta run inputs/rubber_balls_2d.toml --set time.end=20ms --set output.snapshots=400
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from harness import Run  # noqa: E402

APART = 4.5e-3  # s


def oscillation(state):
    """Kinetic energy of the first ring beside that of its motion and spin [J], and the speed of its motion [m/s]."""
    own = state["body"] == 0
    m, x, v = state["mass"][own], state["position"][own], state["velocity"][own]
    mean = np.average(v, axis=0, weights=m)
    arm, left = x - np.average(x, axis=0, weights=m), v - mean
    spin = np.sum(m * (arm[:, 0] * left[:, 1] - arm[:, 1] * left[:, 0])) / np.sum(m * (arm**2).sum(axis=1))
    left = left - spin * np.stack([-arm[:, 1], arm[:, 0]], axis=1)
    return 0.5 * np.sum(m * (left**2).sum(axis=1)), np.linalg.norm(mean)


def main():
    states = [s for s in Run(Path(sys.argv[1])).states if s.time > APART]
    time = np.array([s.time for s in states])
    energy, speed = np.array([oscillation(s) for s in states]).T
    peaks = [k for k in range(2, len(energy) - 2) if energy[k] == energy[k - 2:k + 3].max()]
    slope = np.polyfit(time[peaks], np.log(energy[peaks]), 1)[0]
    period = 2 * np.mean(np.diff(time[peaks]))  # twice in a period the ring is round, and fast
    print(f"period {period * 1e3:.2f} ms, energy falls by {1 - np.exp(slope * period):.1%} in it, over "
          f"{len(peaks) / 2:g} periods; the ring leaves with {speed[-1]:.1f} m/s")


main()
