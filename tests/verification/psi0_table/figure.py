"""Fig. 3 of Owen (2010) for every kernel: python3 psi0_table/figure.py FILE.png, from tests/verification; seconds.

Lines: exact sums over the lattice. Points: what the program makes of a lattice (runs of the case beside this file).
"""
import sys
import tempfile
from pathlib import Path

import matplotlib
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from harness import execute  # noqa: E402
from psi0_table.case import CASES, SUPPORT, exact_psi0  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def measured(case, resolution, workspace):
    state = execute(case.scene_file, case.settings(resolution), workspace / f"{case.name}_{resolution}").final
    return state["smoothing_length"][0], state["zeroth_moment"][0] ** (1 / case.dimension)


def main():
    figure, panels = plt.subplots(1, 2, figsize=(9, 4), sharey=True)
    n = np.arange(1, 3.01, 0.05)
    with tempfile.TemporaryDirectory() as folder:
        for case in CASES:
            panel, colour = panels[case.dimension - 2], f"C{list(SUPPORT).index(case.kernel)}"
            scale = exact_psi0(case.kernel, case.dimension, 2)  # kernels here are without their normalisation
            panel.plot(n, [exact_psi0(case.kernel, case.dimension, k) / scale for k in n], color=colour, lw=1)
            h, psi0 = np.array([measured(case, r, Path(folder)) for r in (100, 130, 150, 175, 200, 250, 300)]).T
            panel.plot(h, psi0 / scale, "o", color=colour, ms=4, label=case.kernel.replace("_", " "))
            panel.set(title=f"{case.dimension}D", xlabel="h / spacing")
    panels[0].set_ylabel(r"$\Psi_0(n_h)\,/\,\Psi_0(2)$")
    panels[0].legend(title="points: program; lines: exact")
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=110)


if __name__ == "__main__":
    main()
