"""Figures of the campaign: curves by gnuplot, pictures of two runs side by side by ffmpeg."""
import csv
import subprocess

# What the largest fragment weighs [share of the target] and its speed [m/s] where it is known, and who says so.
REFERENCES = {
    "pumice_impact": {"laboratory": (0.0996, None), "GASPHiA note": (0.0835, None)},
    "basalt_impact": {"laboratory": (0.31, 1.35), "SPH study": (0.30, 1.35), "MPM study": (0.246, 2.06)},
}
TITLES = {
    "pumice_impact": "Nylon ball into porous pumice, 2.58 km/s",
    "basalt_impact": "Nylon ball into basalt, 3.2 km/s",
}
VIEWS = ["slice", "cutaway", "fragments"]


def gnuplot(file, title, commands):
    """Draws FILE.png from FILE.gp, which stays beside it."""
    head = ['set terminal pngcairo size 900,600 font "DejaVu Sans,11"', f'set output "{file.with_suffix(".png")}"',
            f'set title "{title}" noenhanced', "set grid", 'set datafile separator ","']
    script = file.with_suffix(".gp")
    script.write_text("\n".join(head + commands) + "\n")
    subprocess.run(["gnuplot", str(script)], check=True)


def label(case):
    return f"{case.configuration}, {case.spacing:g} mm"


def reference_lines(scene, vertical):
    """What the largest fragment weighs elsewhere, as dashed lines with their names."""
    commands = []
    for k, (who, share) in enumerate((who, share) for who, (share, _) in REFERENCES[scene].items()):
        if vertical:
            line = f"first {share}, graph 0 to first {share}, graph 1"
            place = f"first {share}, graph {0.97 - 0.06 * k} right offset -0.5,0"
        else:
            line = f"graph 0, first {share} to graph 1, first {share}"
            place = f"graph {0.01 + 0.2 * k}, first {share} offset 0,0.5"
        commands += [f"set arrow from {line} nohead dashtype {k + 2} linecolor rgb 'gray30'",
                     f"set label '{who} {100 * share:g} %' at {place}"]
    return commands


def curves(cases, out, table, rest):
    """Plot clauses, one a run, each of a table in its folder."""
    return [f"'{out / case.name / table}' skip 1 {rest} linewidth 2 title '{label(case)}'" for case in cases]


def draw_distributions(scene, cases, out, folder):
    """N(>= m) of every run with the first seed."""
    plots = curves(cases, out, "fragment_distribution.csv", "using 2:3 with steps")
    if scene == "basalt_impact":  # only the slope is known of the laboratory's fine fragments
        plots.append("0.6*x**-0.6 with lines dashtype 4 linecolor rgb 'gray50' title 'laboratory: slope -3/5'")
    gnuplot(folder / f"{scene}_distribution", TITLES[scene],
            ["set logscale xy", "set format '%g'", "set key bottom left", "set xrange [1e-5:1]", "set yrange [0.8:*]",
             "set xlabel 'fragment mass / target mass'",
             "set ylabel 'fragments at least as heavy'", *reference_lines(scene, True),
             "plot " + ", ".join(plots)])


def draw_histories(scene, cases, out, folder):
    """Mass of the largest fragment against time."""
    plots = curves(cases, out, "largest_fragment.csv", "using ($1*1e6):2 with lines")
    gnuplot(folder / f"{scene}_history", TITLES[scene],
            ["set xlabel 'time [us]'", "set ylabel 'largest fragment / target mass'", "set yrange [0:1]",
             "set key top right", *reference_lines(scene, False), "plot " + ", ".join(plots)])


def draw_resolution(scene, rows, folder):
    """Mass of the largest fragment against spacing, one point a seed."""
    points = []
    coarsest = max(row["spacing [mm]"] for row in rows)
    highest = max(*(share for share, _ in REFERENCES[scene].values()), *(row["largest [%]"] / 100 for row in rows))
    for k, configuration in enumerate(dict.fromkeys(row["configuration"] for row in rows)):
        data = folder / f"{scene}_{configuration}_resolution.csv"
        with open(data, "w", newline="") as text:
            csv.writer(text).writerows((row["spacing [mm]"], row["largest [%]"] / 100) for row in rows
                                       if row["configuration"] == configuration)
        points.append(f"'{data}' using ($1*{1 + 0.01 * k}):2 with points pointtype {7 + 2 * k} pointsize 1.4 "
                      f"title '{configuration}'")
    gnuplot(folder / f"{scene}_resolution", TITLES[scene],
            ["set xlabel 'particle spacing [mm]'", "set ylabel 'largest fragment / target mass'",
             f"set xrange [0:{1.2 * coarsest}]", f"set yrange [0:{1.2 * highest}]",
             *reference_lines(scene, False), "plot " + ", ".join(points)])


def last_image(run, view):
    with open(run / "images/data.csv", newline="") as text:
        files = [cell for row in csv.reader(text) for cell in row if cell.startswith(view + "_") or f"/{view}_" in cell]
    return run / "images" / files[-1] if files else None


def draw_pictures(scene, cases, out, folder):
    """The last pictures of the finest runs that drew any, a row a configuration; few colours keep the file small."""
    finest = {}
    for case in cases:
        if "insitu.enabled" not in case.settings:
            finest.setdefault(case.configuration, {})[case.spacing] = case
    if not finest:
        return
    spacing = min(set.intersection(*(set(runs) for runs in finest.values())), default=None)
    if spacing is None:
        return
    images = [last_image(out / runs[spacing].name, view) for runs in finest.values() for view in VIEWS]
    if any(image is None for image in images):
        return
    inputs = [word for image in images for word in ("-i", str(image))]
    rows = [f"{''.join(f'[{len(VIEWS) * r + k}]' for k in range(len(VIEWS)))}hstack={len(VIEWS)}[row{r}]"
            for r in range(len(finest))]
    stack = "".join(f"[row{r}]" for r in range(len(finest)))
    join = f"{stack}vstack={len(finest)}" if len(finest) > 1 else f"{stack}null"
    small = f"{join},scale=1500:-1:flags=area,split[a][b];[a]palettegen=max_colors=96[p];[b][p]paletteuse=dither=none"
    subprocess.run(["ffmpeg", "-loglevel", "error", "-y", *inputs, "-filter_complex", ";".join([*rows, small]),
                    "-frames:v", "1", str(folder / f"{scene}_pictures.png")], check=True)


def draw(done, rows, out, folder):
    """All figures of the finished cases; `rows` are their outcomes in the same order."""
    for scene in dict.fromkeys(case.scene for case in done if case.main):
        first = [case for case in done if case.scene == scene and case.seed == 1 and case.main]
        if first:
            draw_distributions(scene, first, out, folder)
            draw_histories(scene, first, out, folder)
            draw_pictures(scene, first, out, folder)
        draw_resolution(scene, [row for case, row in zip(done, rows) if case.scene == scene and case.main], folder)
