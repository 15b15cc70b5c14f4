"""What the report says: blocks with figures, tables and sentences, every number of them taken from the results."""
import csv
from collections import defaultdict

import figures
from page import Figure, Heading, Items, Table, Text
from results import CORE_SECONDS, PARTICLE_STEPS, compare
from sentences import sentences, solver_sentences, tolerance_sentences
from studies import AXES, STUDIES, TOLERANCE
from verdicts import bound_of, first_of_families, verdict, worst_of_families


class Report:
    """Draws into a folder and collects the blocks of the page."""

    def __init__(self, results, cases, folder):
        self.results, self.cases, self.folder = results, {case.name: case for case in cases}, folder
        meta = results.meta
        self.caption = (f"{meta['machine']}, 1 thread; Ejecta commit {meta['commit']}, {meta['compiler']}; "
                        f"{meta['date']}")
        self.blocks = []

    def add(self, *blocks):
        self.blocks += blocks

    def figure(self, draw, name, text, *arguments):
        draw(self.folder / f"{name}.png", *arguments, self.caption)
        self.add(Figure(f"{name}.png", text))

    def table(self, name, header, rows):
        """On the page, and as CSV and Markdown by itself."""
        block = Table(header, rows)
        with open(self.folder / f"{name}.csv", "w", newline="") as out:
            csv.writer(out).writerows([header, *rows])
        self.add(block)

    def build(self):
        self.introduction()
        self.speed()
        self.solver()
        self.tolerance()
        self.verification()
        return self.blocks

    def introduction(self):
        meta = self.results.meta
        self.add(
            Heading("Ejecta: errors, orders and what they cost", 1),
            Text(f"Commit {meta['commit']}, {meta['compiler']}; {meta['machine']}; {meta['date']}. Written by "
                 f"`./ejecta report {meta['options']}` in {meta['minutes']:.0f} minutes. Load average of the machine "
                 f"before and after: {meta['load'][0]:.1f} and {meta['load'][1]:.1f}"
                 + (": **it had other work to do, so times are rough**." if max(meta["load"]) > 1.7 else ".")),
            Text("All runs are those of the ordinary program on the scenes of `tests/verification`, one at a time, on "
                 "one thread. L1 is the mean of |computed - exact| over the particles of the region that the case "
                 "names, weighted by their volume, in units of the quantity. Core-seconds are the wall time of the "
                 "time loop; runs of up to two seconds are done three times and the median counts. The variants of a "
                 "problem take turns, so that whatever else happens on the machine happens to all of them. A particle-"
                 "step is one particle advanced by one step. Orders are slopes of least squares through log error "
                 "against log resolution. `errors.csv` holds a line per error of every run."))
        if meta["failures"]:
            self.add(Text("**What went wrong:**"), Items(meta["failures"]))
        if meta["skipped"]:
            self.add(Text(f"Not there, therefore left out: {', '.join(meta['skipped'])}."))

    def speed(self):
        panels = [(axis, [(study, curves) for study in STUDIES if (curves := self.results.curves(study, axis))])
                  for axis in AXES]
        panels = [(axis, found) for axis, found in panels if found]
        if not panels:
            return
        self.add(Heading("Speed against error"), Text(
            "Each curve is a ladder of resolutions: first against core-seconds, which a user pays, then against "
            "particle-steps, which the method asks for on any machine. The dotted guide is first order in the spacing, "
            "the best that shocks allow. Costs are compared at equal error: that of the first variant at its second "
            "finest resolution, interpolated in the others between their own runs (never beyond them: – if the finest "
            "one does not get there, \"at most\" if the coarsest is better already). Steps need not end at the times "
            "of frames here, so that their number is that of the time-step factor."))
        for axis, found in panels:
            self.add(Heading(axis.title, 3), Items(sentences(axis, found)))
            self.figure(figures.work_precision, axis.name, f"{axis.title}: error against core-seconds", axis, found,
                        CORE_SECONDS)
            self.figure(figures.work_precision, f"{axis.name}_{PARTICLE_STEPS}",
                        f"{axis.title}: error against particle-steps", axis, found, PARTICLE_STEPS)
            rows = []
            for study, curves in found:
                target, comparisons = compare(curves)
                for c in comparisons:
                    rows.append([study.title, c.label, c.rows[-1]["resolution"], c.error, c.order,
                                 c.cost[CORE_SECONDS], c.cost[PARTICLE_STEPS], target, c.ratio(CORE_SECONDS),
                                 c.ratio(PARTICLE_STEPS)])
            self.table(f"{axis.name}_table", ["problem", "variant", "finest resolution", "its error", "order",
                       "core-seconds", "particle-steps", "equal error", "core-seconds there, relative",
                       "particle-steps there, relative"], rows)

    def solver(self):
        rows = self.results.solver
        if not rows:
            return
        self.add(Heading("P-alpha: finding the distension"), Text(
            f"{rows[0]['states']} random states of pumice a crush curve, cold to hot, from the onset of crushing to "
            "far beyond full compaction; tolerances 1e-1 to 1e-15. Errors are against bisection down to neighbouring "
            "numbers. Times are medians over 25 blocks of states at which the methods take turns. Newton without a "
            "bracket is drawn for the states for which it converges."))
        self.add(Items(solver_sentences(rows)))
        self.figure(figures.solver, "solver", "Error of a root of the distension against its cost", rows)
        chosen = [row for row in rows if row["tolerance"] in (1e-4, 1e-8, 1e-12)]
        self.table("solver_table", ["crush curve", "method", "tolerance", "fails", "largest error", "evaluations",
                                    "time of a root [ns]"],
                   [[row["curve"], row["method"], f"{row['tolerance']:.0e}",
                     f"{100 * row['failures'] / row['states']:.1f} %", row["largest error [1]"],
                     row["evaluations a root [1]"], row["time a root [ns]"]] for row in chosen])

    def tolerance(self):
        rows = self.results.tolerance
        if not rows:
            return
        self.add(Heading("What the tolerance of the distension does to a run"), Text(
            "The compaction shock with every solver and tolerance. The change is the largest difference of a "
            f"particle's distension or pressure from the run of safe Newton with {min(TOLERANCE.tolerances):.0e}, "
            "relative to the largest value."))
        self.add(Items(tolerance_sentences(rows)))
        self.figure(figures.tolerance, "tolerance", "Compaction shock: tolerance of the distension", TOLERANCE, rows)
        self.table("tolerance_table", ["solver", "tolerance", f"{TOLERANCE.quantity} error [{TOLERANCE.unit}]",
                   "change of distension", "change of pressure", "energy drift", "core-seconds"],
                   [[figures.METHOD_NAMES[row["solver"]], f"{row['tolerance']:.0e}", row["error"],
                     row["distension_difference"], row["pressure_difference"], row["energy_drift"], row["core_seconds"]]
                    for row in rows])

    def verification(self):
        rows = [row for row in self.results.errors if row["part"] == "verification"]
        if not rows:
            return
        self.add(Heading("Verification"))
        drawn = [name for name in self.results.profiles if name in self.cases]
        for name in first_of_families(drawn, self.cases):
            case = self.cases[name]
            self.add(Heading(case.title, 3), Text(f"Exact: {case.exact}."))
            self.figure(figures.profiles, f"profiles_{name}", f"{case.title}: particles and exact solution",
                        case.title, self.results.profiles[name])
        by_error = defaultdict(list)  # (case, quantity, norm) -> rows, coarse to fine
        for row in rows:
            if row["case"] in self.cases:
                by_error[row["case"], row["quantity"], row["norm"]].append(row)
        lines = [verdict(self.cases[case], quantity, norm, ladder)
                 for (case, quantity, norm), ladder in by_error.items()]
        self.add(Heading("Errors and orders", 3), Text(
            "Errors from the coarsest to the finest resolution, the order fitted to them, and what the test of the "
            "case asks. Of families of many cases the worst is shown; `verification_table.csv` holds all."))
        self.convergence(by_error)
        header = ["case", "error", "resolutions", "errors", "order", "asked", "met"]
        with open(self.folder / "verification_table.csv", "w", newline="") as out:
            csv.writer(out).writerows([header, *lines])
        self.add(Table(header, worst_of_families(lines, self.cases)))
        met = sum(line[-1] == "yes" for line in lines)
        self.add(Text(f"{met} of {len(lines)} errors meet what is asked of them."))

    def convergence(self, by_error):
        panels = defaultdict(dict)
        for (name, quantity, norm), ladder in by_error.items():
            bound = bound_of(self.cases[name], quantity, norm)
            if len(ladder) > 1 and bound and bound.order is not None and all(row["error"] > 0 for row in ladder):
                panels[name][f"{quantity} {norm}"] = ladder
        shown, a_figure = first_of_families(panels, self.cases), 12
        for k, start in enumerate(range(0, len(shown), a_figure), 1):
            self.figure(figures.convergence, f"convergence_{k}", "Error against resolution",
                        [(name, panels[name]) for name in shown[start:start + a_figure]])
