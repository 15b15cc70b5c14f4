"""Figures of the report, drawn from the tables."""
import math
import textwrap

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from results import CORE_SECONDS, PARTICLE_STEPS

# Okabe & Ito (2008): told apart by the colour-blind, too; the markers differ as well.
COLOURS = ("#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00")
MARKERS = ("o", "s", "^", "D", "v", "P")
COST_LABELS = {CORE_SECONDS: "cost [core-seconds]", PARTICLE_STEPS: "cost [particle-steps]"}
plt.rcParams.update({"font.size": 10, "axes.grid": True, "grid.alpha": 0.3, "legend.frameon": False,
                     "axes.titlesize": 10, "lines.markersize": 5, "savefig.dpi": 120, "figure.dpi": 120})


def grid(count, columns, size=(4.2, 3.3)):
    """A figure with `count` axes."""
    columns = min(columns, count)
    lines = math.ceil(count / columns)
    figure, axes = plt.subplots(lines, columns, figsize=(size[0] * columns, size[1] * lines + 0.5), squeeze=False)
    for unused in axes.flat[count:]:
        unused.set_visible(False)
    return figure, list(axes.flat)


def save(figure, file, title, caption, legend=None, markerscale=1):
    """Title above; a legend for all (that of the axes `legend`), machine and commit below. Margins are in inches."""
    width, height = figure.get_size_inches()
    bottom = 0.3
    figure.suptitle(textwrap.fill(title, int(11 * width)), fontsize=12, y=1 - 0.08 / height, va="top")
    figure.text(0.5, 0.08 / height, textwrap.fill(caption, int(19 * width)), ha="center", va="bottom", fontsize=7,
                color="0.3")
    if legend:
        handles, labels = legend.get_legend_handles_labels()
        columns = max(1, min(len(labels), int(width / 1.7)))
        figure.legend(handles, labels, loc="lower center", bbox_to_anchor=(0.5, bottom / height), ncol=columns,
                      fontsize=9, markerscale=markerscale)
        bottom += 0.22 * math.ceil(len(labels) / columns) + 0.1
    for text in figure.texts + [figure._suptitle]:
        text.set_in_layout(False)
    figure.tight_layout(rect=(0, bottom / height, 1, 1 - 0.35 / height))
    figure.savefig(file, metadata={"Title": title, "Description": caption})
    plt.close(figure)


def logarithmic(axes, *which):
    for name in which or "xy":
        axis = getattr(axes, f"{name}axis")
        getattr(axes, f"set_{name}scale")("log")
        low, high = getattr(axes, f"get_{name}lim")()
        if high / low < 1000:  # few decades: label more than powers of ten
            fine = (1, 2, 5) if high / low > 6 else (1, 2, 3, 5) if high / low > 3 else (1, 1.5, 2, 2.5, 3, 4, 5, 7)
            axis.set_major_locator(LogLocator(subs=fine))
            axis.set_major_formatter(FuncFormatter(tick))
            axis.set_minor_formatter(NullFormatter())


def tick(value, _):
    if 1e-3 <= value < 1e4:
        return f"{value:g}"
    mantissa, power = f"{value:.1e}".replace(".0e", "e").split("e")
    return ("" if mantissa == "1" else rf"{mantissa}$\cdot$") + f"$10^{{{int(power)}}}$"


def guide(axes, slope, text, x, y):
    """A line of a slope in log-log below the data."""
    x = np.array([min(x), max(x)])
    axes.plot(x, 0.8 * min(y) * (x / x[1]) ** slope, color="0.6", linestyle=":", linewidth=1.2, zorder=0, label=text)


def growth(rows):
    """Exponent with which particle-steps grow with the resolution: 2 for a strip of fixed rows, else dimension + 1."""
    first, last = rows[0], rows[-1]
    if first is last:
        return 1
    return math.log(last[PARTICLE_STEPS] / first[PARTICLE_STEPS]) / math.log(last["resolution"] / first["resolution"])


def work_precision(file, axis, panels, cost, caption):
    """A panel per problem, error against cost. panels: [(study, curves)]."""
    figure, axes = grid(len(panels), 3, (3.8, 3.1) if len(panels) > 1 else (6, 4))
    for ax, (study, curves) in zip(axes, panels):
        points = [(row[cost], row["error"]) for rows in curves.values() for row in rows]
        for label, rows in curves.items():
            k = list(axis.variants).index(label)
            ax.plot([row[cost] for row in rows], [row["error"] for row in rows], color=COLOURS[k],
                    marker=MARKERS[k], markerfacecolor="none" if k else COLOURS[k], linewidth=1.3, label=label)
        guide(ax, -1 / growth(next(iter(curves.values()))), "first order in the spacing", *zip(*points))
        logarithmic(ax)
        ax.set(title=study.title, xlabel=COST_LABELS[cost],
               ylabel=textwrap.fill(f"{study.quantity} {study.norm} error [{study.unit}]", 30))
    most = max(range(len(panels)), key=lambda k: len(panels[k][1]))
    save(figure, file, axis.title, caption, legend=axes[most])


def convergence(file, panels, caption):
    """Error against resolution of each case. panels: [(case name, {label: rows})]."""
    figure, axes = grid(len(panels), 4, (3.1, 2.8))
    for ax, (name, curves) in zip(axes, panels):
        lowest = 1
        for k, (label, rows) in enumerate(curves.items()):
            x, y = (np.array([row[key] for row in rows]) for key in ("resolution", "error"))
            lowest = min(lowest, (y / y[0]).min(), (x[0] / x[-1]) ** 2)
            ax.plot(x, y / y[0], color=COLOURS[k % 6], marker=MARKERS[k % 6], linewidth=1.3,
                    label=f"{label} ({rows[-1]['fitted_order']:.2f})")
        ax.plot(x, x[0] / x, ":", x, (x[0] / x) ** 2, "--", color="0.5", linewidth=1, zorder=0)
        ax.set_ylim(0.8 * lowest ** (1 + 0.25 * len(curves)), ax.get_ylim()[1])  # room for the legend
        logarithmic(ax)
        ax.set_xticks(x, [str(resolution) for resolution in x])
        ax.minorticks_off()
        ax.set(title=name, xlabel="resolution", ylabel="error / coarsest [1]")
        ax.legend(fontsize=7, loc="lower left")
    save(figure, file, "Error against resolution; in brackets the order; dotted: first, dashed: second order", caption)


def profiles(file, title, panels, caption):
    """Particles of the coarsest and the finest run, and the exact solution."""
    labels = list(dict.fromkeys(label for _, _, label, *_ in panels))
    columns = {1: 1, 2: 2, 4: 2}.get(len(labels), 3)
    figure, axes = grid(len(labels), columns, {1: (7.5, 4), 2: (4.2, 3.3), 3: (3.2, 2.8)}[columns])
    resolutions = sorted({resolution for _, resolution, *_ in panels})
    for axis, resolution, label, x, computed, exact in sorted(panels, key=lambda panel: panel[1]):
        ax, finest = axes[labels.index(label)], resolution == resolutions[-1]
        ax.plot(x, computed, ".", color=COLOURS[1] if finest else COLOURS[5], markersize=2 if finest else 4,
                zorder=2 if finest else 1, label=f"resolution {resolution}")
        if finest:
            ax.plot(x, exact, color="black", linewidth=1, zorder=3, label="exact")
        ax.set(xlabel=axis, ylabel=label)
    save(figure, file, title, caption, legend=axes[0], markerscale=2.5)


METHOD_ORDER = ("safe Newton", "TOMS 748", "bisection", "Newton")
METHOD_NAMES = {"safe_newton": "safe Newton", "bisection": "bisection", "newton": "Newton"}


def solver(file, rows, caption):
    """Largest error of a root against its time and against evaluations, a row per crush curve."""
    curves = list(dict.fromkeys(row["curve"] for row in rows))
    figure, axes = grid(2 * len(curves), 2)
    for line, curve in enumerate(curves):
        for column, (work, label) in enumerate((("time a root [ns]", "time of a root [ns]"),
                                                ("evaluations a root [1]", "evaluations of the equation of state"))):
            ax = axes[2 * line + column]
            for k, method in enumerate(METHOD_ORDER):
                mine = [row for row in rows if (row["curve"], row["method"]) == (curve, method)]
                failed = max(row["failures"] / row["states"] for row in rows if row["method"] == method)
                ax.plot([row[work] for row in mine], [row["largest error [1]"] for row in mine], color=COLOURS[k],
                        marker=MARKERS[k], markerfacecolor="none", linewidth=1.3,
                        label=method + (f" (fails for {100 * failed:.0f} %)" if failed else ""))
            logarithmic(ax)
            ax.set(title=f"Pumice, crush curve: {curve}", xlabel=label)
            if column == 0:
                ax.set_ylabel("largest error of the distension [1]")
    save(figure, file, "P-alpha: error of a root against its cost, tolerances 1e-1 to 1e-15", caption, legend=axes[0])


def tolerance(file, study, rows, caption):
    """What tolerance and solver do to a whole run."""
    panels = (("error", f"{study.quantity} {study.norm} error [{study.unit}]"),
              ("distension_difference", "distension: change / largest [1]"),
              ("pressure_difference", "pressure: change / largest [1]"), (CORE_SECONDS, "cost [core-seconds]"))
    figure, axes = grid(len(panels), 2)
    for ax, (column, label) in zip(axes, panels):
        for k, name in enumerate(study.solvers):
            mine = [row for row in rows if row["solver"] == name and row[column] > 0]
            ax.plot([row["tolerance"] for row in mine], [row[column] for row in mine], color=COLOURS[k],
                    marker=MARKERS[k], markerfacecolor="none", linewidth=1.3, label=METHOD_NAMES[name])
        ax.set_xscale("log")
        if column == CORE_SECONDS:
            ax.set_ylim(0, None)
        else:
            logarithmic(ax, "y")
        ax.set(xlabel="tolerance of the distension [1]", ylabel=label)
    save(figure, file, "Compaction shock: tolerance of the distension", caption, legend=axes[0])
