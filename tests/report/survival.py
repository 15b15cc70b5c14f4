"""The survival table: impacts of every shipped material into every other, judged by the program `survival`.

`./ejecta report --survival` calls this; it writes survival.csv, a row a run, and survival.md.
"""
import csv
import subprocess
import sys
from collections import Counter

SETS = {"quick": ["--quick"], "2d": ["--2d"], "all": ["--2d", "--variants"]}
FAILURES_NAMED = 60


def run_table(program, which, file):
    """Runs the sets, a process each, and joins their tables; says how far it is."""
    with open(file, "w") as table:
        for k, words in enumerate(SETS[which]):
            with subprocess.Popen([program, words], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                  text=True) as process:
                for number, line in enumerate(process.stdout):
                    if number > 0 or k == 0:
                        table.write(line)
                    if number % 100 == 0:
                        print(f"\rsurvival {words}: {number} runs", end="", file=sys.stderr, flush=True)
            print(file=sys.stderr)
            if process.returncode not in (0, 1):
                sys.exit(f"report: {program} {words} ended with exit code {process.returncode}")


def read(file):
    with open(file, newline="") as lines:
        return list(csv.DictReader(lines))


def failed(rows):
    return [row for row in rows if row["outcome"] != "survived"]


def table(head, rows):
    lines = ["| " + " | ".join(map(str, row)) + " |" for row in (head, ["---"] * len(head), *rows)]
    return "\n".join(lines) + "\n"


def per_thousand(rows):
    return f"{1000 * len(failed(rows)) / len(rows):.1f}" if rows else ""


def by(rows, key):
    """Runs, failures, failures per thousand and what they were, for each value of a column."""
    values = sorted({row[key] for row in rows}, key=lambda value: (len(value) * value.isdigit(), value))
    lines = []
    for value in values:
        group = [row for row in rows if row[key] == value]
        kinds = Counter(row["outcome"] for row in failed(group))
        lines.append([value, len(group), len(failed(group)), per_thousand(group),
                      ", ".join(f"{kind} {count}" for kind, count in kinds.most_common())])
    return table([key, "runs", "failed", "per thousand", "how"], lines)


def matrix(rows):
    """Failed runs of a ball (row) into a target (column); empty where all were survived."""
    balls, targets = (sorted({row[key] for row in rows}) for key in ("ball", "target"))
    counts = Counter((row["ball"], row["target"]) for row in failed(rows))
    legend = ", ".join(f"{k} {name}" for k, name in enumerate(targets, 1))
    lines = [[ball, *(counts[ball, target] or "" for target in targets), sum(counts[ball, t] for t in targets)]
             for ball in balls]
    lines.append(["all", *(sum(counts[ball, target] for ball in balls) or "" for target in targets), len(failed(rows))])
    return f"Columns: {legend}.\n\n" + table(["ball", *range(1, len(targets) + 1), "all"], lines)


def extremes(rows):
    lines = []
    for key, worst in (("energy error [1]", max), ("least energy [v^2/2]", min), ("fastest [v]", max),
                       ("thinnest [m/spacing^d]", min), ("densest [m/spacing^d]", max), ("steps", max),
                       ("short steps", max)):
        size = abs if key.startswith("energy error") else float
        row = worst(rows, key=lambda row: size(float(row[key])))
        lines.append([key, row[key], name(row)])
    return table(["of the runs that were survived", "worst", "in"], lines)


def name(row):
    return f"{row['ball']} into {row['target']} {row['speed [km/s]']} {row['variant']}"


def page(rows, conditions):
    lost = failed(rows)
    parts = [f"# Survival\n\n{len(rows)} impacts, {len(lost)} not survived: **{per_thousand(rows)} per thousand**. "
             f"Commit {conditions['commit']}, {conditions['date']}, {conditions['machine']}.\n\n"
             "A ball hits a target that is 18 spacings across (2D; 10 in 3D). A run is survived if the core does not "
             "give up, total energy is kept to 1e-9 of the impact's, no specific energy falls below -1e-3 v^2/2, "
             "nothing flies faster than 3 v (5 v with a gas), and density stays within a factor of 3 of mass over "
             "spacing^d wherever a particle has neighbours on all sides.\n"]
    parts += [by(rows, "speed [km/s]"), by(rows, "variant")]
    flat = [row for row in rows if row["variant"] == "2d"]
    if failed(flat) and len(flat) > 1000:
        parts.append("Failures of seven speeds, discs:\n\n" + matrix(flat))
    survived = [row for row in rows if row["outcome"] == "survived"]
    if survived:
        parts.append(extremes(survived))
    if lost:
        parts.append(f"`build/tests/report/survival --scene \"{name(lost[0])}\" > x.toml; build/ejecta run x.toml` "
                     f"shows the first of these ({min(len(lost), FAILURES_NAMED)} of {len(lost)}):\n\n" +
                     table(["run", "outcome", "at", "what the core said"],
                           [[name(row), row["outcome"], row["time reached [1]"], row["message"][:160].replace("|", "/")]
                            for row in lost[:FAILURES_NAMED]]))
    return "\n".join(parts)


def order(row):
    return row["variant"], row["ball"], row["target"], int(row["speed [km/s]"])


def survival(options, conditions):
    """Runs what options.survival asks for (unless only to be drawn again) and writes table and page."""
    file = options.out / "survival.csv"
    if not options.draw:
        run_table(options.survival_program, options.survival, file)
    rows = sorted(read(file), key=order)
    (options.out / "survival.md").write_text(page(rows, conditions))
    print(f"report: {options.out / 'survival.md'}")
