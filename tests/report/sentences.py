"""What to conclude, in words whose numbers come from the results."""
import math
from collections import defaultdict

from figures import METHOD_NAMES
from page import show
from results import CORE_SECONDS, compare, cost_at
from studies import TOLERANCE


def sentences(axis, found):
    """How much each variant costs at equal error, and how large its error is at equal resolution."""
    texts = []
    reference, *others = axis.variants
    for label in others:
        ratios, errors, missed = [], [], []
        for study, curves in found:
            if reference not in curves or label not in curves:
                continue
            mine = next(c for c in compare(curves)[1] if c.label == label)
            if math.isnan(mine.at_equal_error[CORE_SECONDS]):
                missed.append(study.title)
            else:
                ratios.append(f"{mine.ratio(CORE_SECONDS)} ({study.title})")
            errors.append(f"{mine.relative_error:.2f} ({study.title})")
        if not errors:
            continue
        text = f"**{label}** against **{reference}**: "
        text += f"at equal error the core-seconds times {', '.join(ratios)}; " if ratios else ""
        text += f"does not reach that error in {', '.join(missed)}; " if missed else ""
        texts.append(text + f"at the finest resolution of both the error times {', '.join(errors)}.")
    return texts


def solver_sentences(rows, error=1e-10):
    texts = []
    for curve in dict.fromkeys(row["curve"] for row in rows):
        mine = defaultdict(list)
        for row in rows:
            if row["curve"] == curve:
                mine[row["method"]].append({**row, "error": row["largest error [1]"]})
        time, evaluations = ({method: cost_at(ladder, error, column) for method, ladder in mine.items()}
                             for column in ("time a root [ns]", "evaluations a root [1]"))
        fails = max(row["failures"] / row["states"] for row in mine["Newton"])
        others = ", ".join(f"{method} {time[method]:.0f} ns and {evaluations[method]:.1f} "
                           f"({time[method] / time['safe Newton']:.1f} times the time)"
                           for method in ("TOMS 748", "bisection"))
        texts.append(f"Crush curve: {curve}; largest error {error:.0e}: safe Newton takes "
                     f"{time['safe Newton']:.0f} ns and {evaluations['safe Newton']:.1f} evaluations, {others}. "
                     f"Newton without a bracket fails for {100 * fails:.0f} % of the states.")
    return texts


def tolerance_sentences(rows):
    texts, best = [], next(row for row in rows if row["solver"] == TOLERANCE.solvers[0])
    for solver in TOLERANCE.solvers:
        mine = sorted((row for row in rows if row["solver"] == solver), key=lambda row: -row["tolerance"])
        if mine:
            loose, tight = mine[0], mine[-1]
            name, best_name = METHOD_NAMES[solver], METHOD_NAMES[best["solver"]]
            texts.append(
                f"**{name}**: from a tolerance of {loose['tolerance']:.0e} to {tight['tolerance']:.0e} the error goes "
                f"from {show(loose['error'])} to {show(tight['error'])} {TOLERANCE.unit} and the largest change of the "
                f"pressure from {show(loose['pressure_difference'])} to {show(tight['pressure_difference'])} of the "
                f"largest pressure; the time of a run is multiplied by "
                f"{tight['core_seconds'] / loose['core_seconds']:.2f} and is then "
                f"{tight['core_seconds'] / best['core_seconds']:.2f} times that of {best_name} at "
                f"{best['tolerance']:.0e}.")
    return texts
