"""Reads the folders of finished runs; writes the tables, and has figures.py draw."""
import csv
import json
import math
import re
import shutil
import statistics
import subprocess
import tomllib

import figures

THRESHOLDS = [0.5, 0.9, 0.99, 1.01]  # fragments.damage_threshold; beyond 1 damage cuts no links at all
SETTLED = 0.1  # of the last value
CORE = {"distance": 0.3, "filling": 0.5}  # within this many radii of the target's centre; at least so much of its ellipsoid
LINKING = re.compile(r"linking length ([\d.]+): (\d+), largest ([\d.]+) %, dust ([\d.]+) %")


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


def finished(folder):
    return (folder / "summary.json").exists() and summary(folder)["exit"] == 0


def table(file):
    """A CSV file as columns of numbers, keyed by the header without its units; what is no number is NaN."""
    with open(file, newline="") as text:
        rows = list(csv.reader(text))
    names = [name.split(" [")[0] for name in rows[0]]

    def number(cell):
        try:
            return float(cell)
        except ValueError:
            return math.nan

    return {name: [number(row[k]) for row in rows[1:]] for k, name in enumerate(names)}


def settled_at(history):
    """Time [us] from which on the largest fragment stays within SETTLED of its last value."""
    time, largest = history["time"], history["largest fragment mass fraction"]
    late = len(largest)
    while late > 0 and abs(largest[late - 1] - largest[-1]) <= SETTLED * largest[-1]:
        late -= 1
    return 1e6 * time[min(late, len(time) - 1)]


def by_linking_length(log):
    """{linking length: largest fragment in per cent} as the run has logged it; the last word counts."""
    return {float(m[1]): float(m[3]) for m in LINKING.finditer(log.read_text())}


def metres(text):
    """A length as resolved.toml writes it: "0.03 m"."""
    return float(text.split()[0])


def ball(folder):
    """Radius [m] and centre [m] of the target as the run started with it."""
    with open(folder / "resolved.toml", "rb") as text:
        target = next(b for b in tomllib.load(text)["bodies"] if b["name"] == "target")
    return metres(target["radius"]), [metres(c) for c in target["center"]]


def place(piece, time, target):
    """Where in the target a piece has sat: the distance of its centre from the target's in radii, run back to the start
    with its velocity, and how much of the ellipsoid of its semi-axes it fills. A shell has a large ellipsoid."""
    radius, center = target
    back = [piece[f"centre {a}"] - time * piece[f"velocity {a}"] - c for a, c in zip("xyz", center)]
    ellipsoid = math.prod(piece[f"semi-axis {a}"] for a in "abc") / radius**3
    return math.hypot(*back) / radius, piece["mass fraction"] / ellipsoid if ellipsoid > 0 else math.nan


def speed(piece):
    return math.hypot(*(piece[f"velocity {axis}"] for axis in "xyz"))


def is_core(distance, filling):
    return distance < CORE["distance"] and filling > CORE["filling"]


def word_for(distance, filling):
    """The core, a shell, or a chunk that is neither."""
    return "core" if is_core(distance, filling) else "shell" if filling < CORE["filling"] else "chunk"


def outcome(case, folder):
    """What one run says, one row of the tables."""
    s, pieces = summary(folder), table(folder / "fragments.csv")
    history, largest = table(folder / "history.csv"), table(folder / "largest_fragment.csv")
    links = by_linking_length(folder / "run.log")
    dust = pieces["number"].index(0)
    whole = [{name: column[k] for name, column in pieces.items()}
             for k in range(len(pieces["number"])) if k != dust]  # the heaviest comes first
    places = [place(piece, s["time_s"], ball(folder)) for piece in whole]
    core = next((piece for piece, where in zip(whole, places) if is_core(*where)), None)
    return {
        "scene": case.scene,
        "configuration": case.configuration,
        "lattice": case.lattice,
        "spacing [mm]": case.spacing,
        "seed": case.seed,
        "particles": s["particles"],
        "precision": s["precision"],
        "time [us]": round(1e6 * s["time_s"], 1),
        "largest [%]": round(100 * s["largest_fragment_mass_fraction"], 2),
        "its speed [m/s]": round(speed(whole[0]), 2) if whole else "",
        "it is": word_for(*places[0]) if whole else "",
        "its distance [radii]": round(places[0][0], 2) if whole else "",
        "it fills": round(places[0][1], 2) if whole else "",
        "core [%]": round(100 * core["mass fraction"], 2) if core else 0,
        "core speed [m/s]": round(speed(core), 2) if core else "",
        "second [%]": round(100 * whole[1]["mass fraction"], 2) if len(whole) > 1 else 0,
        "fragments": s["fragments"],
        "dust [%]": round(100 * pieces["mass fraction"][dust], 1),
        "damaged [%]": round(100 * history["damaged mass fraction"][-1], 1),
        "settled at [us]": round(settled_at(largest), 0),
        **{f"largest at b = {b} [%]": value for b, value in sorted(links.items())},
        "energy error": f"{s['energy_error_rel']:.1e}",
        "wall [s]": round(s["wall_s"]),
        "steps": s["steps"],
    }


def by_threshold(case, folder, binary, scratch):
    """{damage threshold: (largest [%], dust [%])} of the final state: a restart at the end of the run only counts
    fragments again. None where the program refuses the value."""
    answer = {}
    for threshold in THRESHOLDS:
        copy = scratch / f"{case.name}_{threshold}"
        if not finished(copy):
            shutil.rmtree(copy, ignore_errors=True)
            shutil.copytree(folder, copy, ignore=shutil.ignore_patterns("images", "*.mp4", "summary.json", "monitor"))
            command = [str(binary), "run", str(folder / "resolved.toml"), "--out", str(copy), "--restart",
                       "--threads", "1", "--set", f"fragments.damage_threshold={threshold}",
                       "--set", "insitu.enabled=false"]
            with open(scratch / (copy.name + ".log"), "w") as log:
                subprocess.run(command, stdout=log, stderr=subprocess.STDOUT)
        if finished(copy):
            pieces = table(copy / "fragments.csv")
            dust = pieces["mass fraction"][pieces["number"].index(0)]
            answer[threshold] = (100 * summary(copy)["largest_fragment_mass_fraction"], 100 * dust)
    return answer


def write_table(rows, file, title):
    """The same rows as FILE.csv and FILE.md."""
    names = list(dict.fromkeys(name for row in rows for name in row))
    with open(file.with_suffix(".csv"), "w", newline="") as text:
        writer = csv.DictWriter(text, names, restval="")
        writer.writeheader()
        writer.writerows(rows)
    lines = [f"**{title}**", "", "| " + " | ".join(names) + " |", "|" + "---|" * len(names)]
    lines += ["| " + " | ".join(str(row.get(name, "")) for name in names) + " |" for row in rows]
    file.with_suffix(".md").write_text("\n".join(lines) + "\n")


def spread(values):
    deviation = f" +- {statistics.stdev(values):.2f}" if len(values) > 1 else ""
    return f"{statistics.mean(values):.2f}{deviation}"


def averages(rows):
    """One row for each scene, configuration, lattice and spacing: mean and standard deviation over the seeds; below
    those of a scene what others have found."""
    groups = {}
    for row in rows:
        groups.setdefault((row["scene"], row["configuration"], row["lattice"], row["spacing [mm]"]), []).append(row)
    answer = []
    for (scene, configuration, lattice, spacing), group in groups.items():
        answer.append({"scene": scene, "configuration": configuration, "lattice": lattice, "spacing [mm]": spacing,
                       "seeds": len(group), "particles": group[0]["particles"]} |
                      {name: spread([row[name] for row in group if row[name] != ""])
                       for name in ("largest [%]", "its speed [m/s]", "its distance [radii]", "it fills", "core [%]",
                                    "second [%]", "fragments", "dust [%]", "steps", "wall [s]")
                       if any(row[name] != "" for row in group)} |
                      {"it is": ", ".join(sorted({row["it is"] for row in group}))})
    for scene in dict.fromkeys(row["scene"] for row in rows):
        for who, (share, pace) in figures.REFERENCES[scene].items():
            answer.append({"scene": scene, "configuration": who, "largest [%]": f"{100 * share:g}",
                           "its speed [m/s]": pace or ""})
    return sorted(answer, key=lambda row: row["scene"])


def write(done, out, binary):
    """All tables and figures of the finished cases, in out/results."""
    folder = out / "results"
    folder.mkdir(parents=True, exist_ok=True)
    if not done:
        return
    rows = [outcome(case, out / case.name) for case in done]
    write_table(rows, folder / "runs", "All runs")
    write_table(averages(rows), folder / "averages", "Mean and standard deviation over the seeds")
    scratch = out / "thresholds"
    scratch.mkdir(exist_ok=True)
    counted = []
    for case in (c for c in done if c.seed == 1 and c.main):
        for threshold, (largest, dust) in by_threshold(case, out / case.name, binary, scratch).items():
            counted.append({"scene": case.scene, "configuration": case.configuration, "spacing [mm]": case.spacing,
                            "damage threshold": threshold, "largest [%]": round(largest, 2),
                            "dust [%]": round(dust, 1)})
    write_table(counted, folder / "thresholds", "What the damage threshold does to the same final state")
    figures.draw(done, rows, out, folder)
