"""Figures of the campaign: curves by gnuplot, pictures of two runs side by side by ffmpeg."""
import csv
import subprocess

# What the largest fragment weighs [share of the target], and who says so.
REFERENCES = {
    "pumice_impact": {"laboratory": 0.0996, "GASPHiA note": 0.0835},
    "basalt_impact": {"laboratory": 0.31, "MPM study": 0.246},
}
TITLES = {"pumice_impact": "Nylon ball into porous pumice, 2.58 km/s", "basalt_impact": "Nylon ball into basalt, 3.2 km/s"}
VIEWS = ["slice", "cutaway", "fragments"]


def gnuplot(file, title, commands):
    """Draws FILE.png from FILE.gp, which stays beside it."""
    head = [f'set terminal pngcairo size 900,600 font "DejaVu Sans,11"', f'set output "{file.with_suffix(".png")}"',
            f'set title "{title}" noenhanced', "set grid", 'set datafile separator ","']
    script = file.with_suffix(".gp")
    script.write_text("\n".join(head + commands) + "\n")
    subprocess.run(["gnuplot", str(script)], check=True)


def label(case):
    return f"{case.configuration}, {case.spacing:g} mm"


def reference_lines(scene, vertical):
    commands = []
    for k, (who, share) in enumerate(REFERENCES[scene].items()):
        ends = f"first {share}, graph 0 to first {share}, graph 1" if vertical else \
               f"graph 0, first {share} to graph 1, first {share}"
        commands += [f"set arrow from {ends} nohead dashtype {k + 2} linecolor rgb 'gray30'"]
    return commands


def draw_distributions(scene, cases, out, folder):
    """N(>= m) of every run with the first seed."""
    curves = [f"'{out / c.name / 'fragment_distribution.csv'}' skip 1 using 2:3 with steps linewidth 2 title '{label(c)}'"
              for c in cases]
    extra = []
    if scene == "basalt_impact":
        extra = ["0.6*x**-0.6 with lines dashtype 4 linecolor rgb 'gray50' title 'slope -3/5, fine fragments of the laboratory'"]
    who = ", ".join(f"{name} {100 * share:g} %" for name, share in REFERENCES[scene].items())
    gnuplot(folder / f"{scene}_distribution", TITLES[scene],
            ["set logscale xy", "set format '%g'", "set key bottom left", "set xrange [1e-5:1]", "set yrange [0.8:*]",
             f"set xlabel 'fragment mass / target mass   (dashed: largest, {who})'",
             "set ylabel 'fragments at least as heavy'", *reference_lines(scene, True), "plot " + ", ".join(curves + extra)])


def draw_histories(scene, cases, out, folder):
    """Mass of the largest fragment against time."""
    curves = [f"'{out / c.name / 'largest_fragment.csv'}' skip 1 using ($1*1e6):2 with lines linewidth 2 title '{label(c)}'"
              for c in cases]
    gnuplot(folder / f"{scene}_history", TITLES[scene],
            ["set xlabel 'time [us]'", "set ylabel 'largest fragment / target mass'", "set yrange [0:1]", "set key top right",
             *reference_lines(scene, False), "plot " + ", ".join(curves)])


def draw_resolution(scene, rows, folder):
    """Mass of the largest fragment against spacing, one point a seed."""
    points = []
    for k, configuration in enumerate(dict.fromkeys(row["configuration"] for row in rows)):
        data = folder / f"{scene}_{configuration}_resolution.csv"
        with open(data, "w", newline="") as text:
            csv.writer(text).writerows((row["spacing [mm]"], row["largest [%]"] / 100) for row in rows
                                       if row["configuration"] == configuration)
        points.append(f"'{data}' using ($1*{1 + 0.01 * k}):2 with points pointtype {7 + 2 * k} pointsize 1.4 title '{configuration}'")
    gnuplot(folder / f"{scene}_resolution", TITLES[scene],
            ["set xlabel 'particle spacing [mm]'", "set ylabel 'largest fragment / target mass'", "set xrange [0:*]",
             "set yrange [0:*]", *reference_lines(scene, False), "plot " + ", ".join(points)])


def last_image(run, view):
    with open(run / "images/data.csv", newline="") as text:
        files = [cell for row in csv.reader(text) for cell in row if cell.startswith(view + "_") or f"/{view}_" in cell]
    return run / "images" / files[-1] if files else None


def draw_pictures(scene, cases, out, folder):
    """The last pictures of the finest runs that drew any, a row a configuration, with few enough colours to be small."""
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
    for scene in dict.fromkeys(case.scene for case in done):
        first = [case for case in done if case.scene == scene and case.seed == 1]
        if first:
            draw_distributions(scene, first, out, folder)
            draw_histories(scene, first, out, folder)
            draw_pictures(scene, first, out, folder)
        draw_resolution(scene, [row for row in rows if row["scene"] == scene], folder)
